"""What the printer profile should say, from the models of the simulated machines."""

import pytest

from octoprint_rrfmodel.rrf.views.profile import profile_values
from octoprint_rrfmodel.simulator.board import Board


def values_of(machine):
    return profile_values(Board(machine=machine).data)


def axes(x, y, z, **more):
    limits = zip("XYZ", (x, y, z))
    return [{"letter": letter, "min": low, "max": high, **more} for letter, (low, high) in limits]


def test_toolchanger():
    values = values_of("toolchanger")
    assert values["volume.formFactor"] == "rectangular"
    assert values["volume.origin"] == "lowerleft"
    assert (values["volume.width"], values["volume.depth"]) == (330, 240)
    assert values["volume.height"] == 300
    assert values["volume.custom_box"] is False
    # tools 1, 3, 7 and 10
    assert values["extruder.count"] == 11
    assert values["extruder.sharedNozzle"] is False
    assert values["heatedBed"] is True
    assert values["heatedChamber"] is False
    assert values["axes.x.speed"] > values["axes.z.speed"] > 0


def test_delta_is_round_and_centred():
    values = values_of("delta")
    assert values["volume.formFactor"] == "circular"
    assert values["volume.origin"] == "center"
    assert values["volume.width"] == values["volume.depth"] > 0


def test_heated_chamber():
    assert values_of("corexy")["heatedChamber"] is True


def test_machine_without_tools_says_nothing_of_extruders():
    values = values_of("cnc")
    assert "extruder.count" not in values
    assert values["heatedBed"] is False


def test_axes_below_the_origin_make_a_box():
    model = {"move": {"axes": axes((-5, 200), (-10, 180), (0, 150))}}
    values = profile_values(model)
    assert (values["volume.width"], values["volume.depth"]) == (200, 180)
    assert values["volume.custom_box"] == {
        "x_min": -5,
        "x_max": 200,
        "y_min": -10,
        "y_max": 180,
        "z_min": 0,
        "z_max": 150,
    }


def test_origin_in_the_middle():
    values = profile_values({"move": {"axes": axes((-100, 100), (-90, 90), (0, 150))}})
    assert values["volume.origin"] == "center"
    assert (values["volume.width"], values["volume.depth"]) == (200, 180)


def test_one_nozzle_for_several_tools():
    tools = [{"number": 0, "heaters": [1]}, {"number": 1, "heaters": [1]}]
    assert profile_values({"tools": tools})["extruder.sharedNozzle"] is True


@pytest.mark.parametrize(
    "model",
    [{}, {"move": None}, {"move": {"axes": [None, {"letter": 3}]}}, {"tools": "x"}, {"heat": 1}],
)
def test_what_is_not_known_is_left_out(model):
    assert "volume.width" not in profile_values(model)
    assert "extruder.count" not in profile_values(model)


@pytest.mark.parametrize("name", ["delta", "linearDelta", "Rotary delta", "Hangprinter"])
def test_round_machines(name):
    move = {"axes": axes((-85, 85), (-85, 85), (-0.5, 200)), "kinematics": {"name": name}}
    values = profile_values({"move": move})
    assert (values["volume.formFactor"], values["volume.width"]) == ("circular", 170)
    assert values["volume.custom_box"]["z_min"] == -0.5


def test_a_router_goes_down_from_zero():
    values = profile_values({"move": {"axes": axes((0, 600), (0, 400), (-120, 0))}})
    assert values["volume.height"] == 120
    # the box is never smaller than size and origin make it: OctoPrint widens it without a word
    box = values["volume.custom_box"]
    assert (box["z_min"], box["z_max"]) == (-120, 120)


def test_box_around_an_origin_beside_the_middle():
    values = profile_values({"move": {"axes": axes((-100.5, 100), (-90, 90), (-1, 150))}})
    box = values["volume.custom_box"]
    assert values["volume.width"] == 200.5
    assert (box["x_min"], box["x_max"], box["z_min"]) == (-100.5, 100.25, -1)


@pytest.mark.parametrize("long", "XYZ")
def test_a_volume_that_a_host_refuses_is_left_out(long):
    limits = [(0, 10_000 if letter == long else 300) for letter in "XYZ"]
    assert profile_values({"move": {"axes": axes(*limits, speed=6000)}}) == {
        f"axes.{letter}.speed": 6000 for letter in "xyz"
    }


def test_more_extruders_than_a_host_takes_are_left_out():
    assert "extruder.count" not in profile_values({"tools": [{"number": 120, "heaters": []}]})
