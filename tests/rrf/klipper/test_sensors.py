"""Filament monitors, outputs, endstops, probes, macros and global variables."""

import pytest

from octoprint_rrfmodel.rrf.klipper import names

from . import HOST, Machine, changed, get, model_of, whole, world


def of_kind(at, kind):
    return [name for name in names(at) if name.startswith(kind)]


def monitored(*monitors, extruders=1):
    return {
        "sensors": {"filamentMonitors": list(monitors)},
        "move": {"extruders": [{}] * extruders},
    }


@pytest.mark.parametrize(
    ("status", "detected"),
    [
        ("ok", True),
        ("noFilament", False),
        ("tooLittleMovement", True),
        ("tooMuchMovement", True),
        ("noDataReceived", True),
        ("sensorError", True),
        ("noMonitor", True),
        ("something new", None),
        (None, None),
        (["ok"], None),
    ],
)
def test_only_missing_filament_is_reported(status, detected):
    at = world(monitored({"status": status, "enableMode": 1, "type": "laser"}))
    for kind in ("filament_switch_sensor", "filament_motion_sensor"):
        assert whole(at, f"{kind} extruder0") == {"filament_detected": detected, "enabled": True}


@pytest.mark.parametrize(
    ("members", "enabled"),
    [
        ({"enableMode": 0}, False),
        ({"enableMode": 1}, True),
        ({"enableMode": 2}, True),
        ({"enableMode": 0, "enabled": True}, False),
        ({"enabled": True}, True),
        ({"enabled": False}, False),
        ({"enableMode": None}, False),
        ({"enableMode": "on"}, False),
        ({}, False),
    ],
)
def test_enabled(members, enabled):
    at = world(monitored({"status": "ok", **members}))
    assert get(at, "filament_switch_sensor extruder0", "enabled") is enabled


def test_monitors_are_named_after_their_extruders():
    model = monitored({"type": "simple"}, None, {"type": "rotatingMagnet"}, {"type": "pulsed"})
    assert of_kind(world(model), "filament_") == [
        "filament_switch_sensor extruder0",
        "filament_switch_sensor monitor2",
        "filament_switch_sensor monitor3",
        "filament_motion_sensor monitor2",
    ]
    model["move"]["extruders"] = [{}] * 4
    assert "filament_switch_sensor extruder3" in names(world(model))


@pytest.mark.parametrize("firmware", ["3.3", "3.4", "3.5.3", "3.6", "3.7"])
def test_simulated_monitor_is_enabled(firmware):
    at = world(model_of("cartesian", firmware))
    assert get(at, "filament_switch_sensor extruder0", "enabled") is True


@pytest.mark.parametrize(
    ("output", "value"),
    [({"pwm": 0.5}, 0.5), ({"pwm": 1, "freq": 500}, 1), ({"pwm": None}, 0.0), ({"freq": 1}, 0.0)],
)
def test_output_pin(output, value):
    at = world({"state": {"gpOut": [None, output]}})
    assert of_kind(at, "output_pin") == ["output_pin gpOut1"]
    assert whole(at, "output_pin gpOut1") == {"value": value}


def test_endstops_in_axis_order():
    model = {
        "move": {"axes": [{"letter": letter} for letter in "XYZUAa"]},
        "sensors": {
            "endstops": [
                {"triggered": True},
                {"triggered": False},
                None,
                {"triggered": None},
                {"triggered": True},
                {"triggered": False},
            ]
        },
    }
    shown = get(world(model), "query_endstops", "last_query")
    assert list(shown.items()) == [("x", 1), ("y", 0), ("a", 1), ("'a", 0)]
    assert all(type(value) is int for value in shown.values())


@pytest.mark.parametrize("endstops", [[], [None, None], None])
def test_no_endstops(endstops):
    assert "query_endstops" not in names(world({"sensors": {"endstops": endstops}}))


PROBE = {"type": 8, "threshold": 500, "value": [0], "lastStopHeight": 1.25, "measuredHeight": 9.0}


@pytest.mark.parametrize(
    ("members", "last_query", "last_z_result"),
    [
        ({}, False, 1.25),
        ({"value": [500]}, True, 1.25),
        ({"value": [1000, 12]}, True, 1.25),
        ({"value": []}, None, 1.25),
        ({"value": None, "lastStopHeight": None}, None, None),
        ({"threshold": None}, None, 1.25),
    ],
)
def test_probe(members, last_query, last_z_result):
    at = world({"sensors": {"probes": [{**PROBE, **members}]}})
    assert whole(at, "probe") == {
        "name": "probe",
        "last_query": last_query,
        "last_z_result": last_z_result,
    }


@pytest.mark.parametrize("probes", [[], None, [None], [{**PROBE, "type": 0}], [{"value": [1000]}]])
def test_no_probe(probes):
    assert "probe" not in names(world({"sensors": {"probes": probes}}))


@pytest.mark.parametrize("firmware", ["2.05", "3.3", "3.6", "3.7"])
def test_simulated_probes(firmware):
    assert "probe" in names(world(model_of("cartesian", firmware)))
    assert "probe" not in names(world(model_of("cnc", firmware)))


def test_no_manual_probing():
    assert whole(world(), "manual_probe") == {"is_active": False}


MACROS = HOST._replace(
    macros=("0:/macros/Park.g", "clean nozzle.g", "sub/level.G", "plain", "globals.g", ".g", "")
)


OF_PRINTS = ["gcode_macro PAUSE", "gcode_macro RESUME", "gcode_macro CANCEL_PRINT"]


def test_macros_are_named_so_that_they_can_be_sent():
    at = world({}, MACROS)
    assert of_kind(at, "gcode_macro") == [
        *OF_PRINTS,
        "gcode_macro Park",
        "gcode_macro clean_nozzle",
        "gcode_macro sub_level",
        "gcode_macro plain",
        "gcode_macro globals_",
    ]
    assert whole(at, "gcode_macro clean_nozzle") == {}
    assert get(at, "gcode_macro clean_nozzle", "anything") is None


def test_macros_that_need_no_button_say_so():
    at = world(model_of("toolchanger"), MACROS)
    config = get(at, "configfile", "config")
    hidden = {name for name, section in config.items() if "rename_existing" in section}
    assert hidden == {*OF_PRINTS, *(f"gcode_macro T{tool}" for tool in (1, 3, 7, 10))}
    assert config["gcode_macro PAUSE"] == {"gcode": "PAUSE", "rename_existing": "BASE_PAUSE"}
    assert config["gcode_macro Park"] == {"gcode": 'M98 P"0:/macros/Park.g"'}


def test_tools_where_there_is_a_choice():
    model = changed(model_of("toolchanger"), state__currentTool=3)
    assert get(world(model), "gcode_macro T3", "active") is True
    assert get(world(model), "gcode_macro T1", "active") is False
    assert "gcode_macro T0" not in names(world(model_of("cartesian")))


def test_global_variables_are_fields():
    variables = {"a": 1, "b": [1, {"c": None}], "d": float("inf"), "e": "x"}
    at = world({"global": variables}, MACROS)
    assert of_kind(at, "gcode_macro")[-1] == "gcode_macro globals"
    assert whole(at, "gcode_macro globals") == {**variables, "d": None}
    assert get(at, "gcode_macro globals", "b") == [1, {"c": None}]
    assert get(at, "gcode_macro globals", "z") is None


def test_no_global_variables_are_an_object_too():
    assert whole(world({"global": {}}), "gcode_macro globals") == {}
    assert "gcode_macro globals" in names(world({"global": {}}))
    assert "gcode_macro globals" not in names(world({"global": None}))


def test_variables_are_followed():
    machine = Machine("toolchanger")
    machine.send("global wanted = 5")
    machine.wait(5)
    assert machine.get("gcode_macro globals", "wanted") == 5


@pytest.mark.parametrize("percent", [0, 50, 100])
def test_outputs_are_followed(percent):
    machine = Machine("cartesian")
    machine.send(f"M42 P0 S{percent / 100}")
    machine.wait(3)
    assert machine.get("output_pin gpOut0", "value") == percent / 100
