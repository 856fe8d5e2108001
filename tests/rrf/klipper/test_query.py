"""Lists, queries and differences: what is there, what isn't, what has changed."""

import json
import re

import pytest

from octoprint_rrfmodel.rrf.klipper import OBJECTS, Moment, names, status, wanted_of
from tests.support.places import ROOT

from . import MODELS, changed, get, model_of, whole, world

ALWAYS = {
    "webhooks",
    "gcode_move",
    "toolhead",
    "idle_timeout",
    "configfile",
    "virtual_sdcard",
    "print_stats",
    "display_status",
    "bed_mesh",
}


def is_served(at):
    """Assert that all objects are JSON with finite numbers, and each listed one has fields."""
    listed = names(at)
    shown = status(at, dict.fromkeys(listed))
    assert list(shown) == listed
    json.dumps(shown, allow_nan=False)
    return shown


@pytest.mark.parametrize(("machine", "firmware"), MODELS)
def test_simulated_machine(machine, firmware):
    at = world(model_of(machine, firmware))
    shown = is_served(at)
    assert set(shown) >= ALWAYS
    assert len(shown) == len(set(names(at)))
    # those of macros are there for their names
    assert all(fields for name, fields in shown.items() if not name.startswith("gcode_macro "))


def test_no_model():
    shown = is_served(world())
    macros = {f"gcode_macro {name}" for name in ("PAUSE", "RESUME", "CANCEL_PRINT")}
    assert set(shown) == ALWAYS | {"gcode", "pause_resume", "heaters", "manual_probe"} | macros


MACHINES = {
    "cartesian": {"extruder", "heater_bed", "fan", "heater_fan Hotend", "temperature_fan Hotend"},
    "corexy": {"extruder", "heater_bed", "heater_generic chamber", "temperature_fan Chamber"},
    "toolchanger": {"extruder1", "extruder10", "fan_generic Tool 1", "mcu 23"},
    "delta": {"extruder", "heater_bed", "fan", "heater_fan fan1"},
    "idex": {"extruder2", "heater_generic tool2_h1", "fan_generic Right"},
    "cnc": {"query_endstops", "motion_report"},
    "manyaxes": {"extruder", "heater_bed", "fan"},
}


@pytest.mark.parametrize(("machine", "some"), MACHINES.items(), ids=MACHINES)
def test_list_of_a_machine(machine, some):
    assert some <= set(names(world(model_of(machine))))


@pytest.mark.parametrize("firmware", ["2.05", "3.3", "3.6", "3.7"])
def test_what_is_not_there_is_not_listed(firmware):
    listed = set(names(world(model_of("cnc", firmware))))
    assert not {"extruder", "heater_bed", "fan", "probe", "heater_generic chamber"} & listed


def test_unknown_objects_and_fields():
    at = world(model_of())
    assert status(
        at,
        {
            "nosuch": None,
            "extruder": ["target", "nosuch"],
            "extruder9": ["target"],
            "fan nosuch": [],
            "heater_generic chamber": ("target",),
        },
    ) == {
        "nosuch": {},
        "extruder": {"target": 0.0, "nosuch": None},
        "extruder9": {},
        "fan nosuch": {},
        "heater_generic chamber": {},
    }


@pytest.mark.parametrize("fields", [None, [], ()])
def test_no_fields_are_all_fields(fields):
    at = world(model_of())
    assert status(at, {"fan": fields}) == {"fan": {"speed": 0.0, "rpm": None}}


def test_nothing_wanted():
    assert status(world(), {}) == {}


def test_only_what_is_wanted_is_computed():
    class Watched(dict):
        def get(self, name, default=None):
            read.add(name)
            return super().get(name, default)

    read = set()
    model = Watched(model_of())
    status(world(model), {"fan": ["speed"], "gcode_move": ["speed_factor"]})
    assert read <= {"fans", "tools", "state", "move", "heat"}


def test_fields_are_the_models_own_values_no_longer():
    model = model_of()
    shown = whole(world(model), "gcode_macro globals")
    shown["speeds"].append(1)
    assert 1 not in model["global"]["speeds"]


def difference(last, now):
    return Moment(world(model_of())).difference(last, now)


DIFFERENCES = [
    pytest.param({}, {}, {}, id="nothing"),
    pytest.param({"a": {"x": 1}}, {"a": {"x": 1}}, {}, id="the same"),
    pytest.param({"a": {"x": 1, "y": 2}}, {"a": {"x": 1, "y": 3}}, {"a": {"y": 3}}, id="a field"),
    pytest.param(
        {"a": {"x": [1, 2]}}, {"a": {"x": [1, 3]}}, {"a": {"x": [1, 3]}}, id="whole, not a part"
    ),
    pytest.param({"a": {}}, {"a": {"x": None}}, {"a": {"x": None}}, id="new and null"),
    pytest.param({"a": {"x": 1}}, {"a": {}}, {"a": {"x": None}}, id="object is gone"),
    pytest.param({}, {"a": {"x": 1}}, {"a": {"x": 1}}, id="new object"),
    pytest.param({}, {"a": {}}, {}, id="new object that isn't there"),
    pytest.param({"a": {"x": 1}}, {"a": {"x": True}}, {"a": {"x": True}}, id="true is not 1"),
    pytest.param({"a": {"x": 0}}, {"a": {"x": 0.0}}, {}, id="0 is 0.0"),
    pytest.param({"b": {"x": 1}}, {"a": {"x": 1}}, {"a": {"x": 1}}, id="other objects"),
]


@pytest.mark.parametrize(("last", "now", "changes"), DIFFERENCES)
def test_difference(last, now, changes):
    assert difference(last, now) == changes


def test_difference_of_a_machine():
    wanted = {"heater_bed": None, "fan": ["speed"], "toolhead": None}
    model = model_of()
    before = status(world(model), wanted)
    assert difference(before, status(world(model), wanted)) == {}
    model = changed(model, **{"heat.heaters[0].current": 55.5})
    assert difference(before, status(world(model), wanted)) == {"heater_bed": {"temperature": 55.5}}


def test_time_that_passes_changes_nothing_of_a_machine_at_rest():
    model = model_of()
    at, later = world(model, now=1.0), world(model, now=1.5)
    wanted = dict.fromkeys(names(at))
    assert difference(status(at, wanted), status(later, wanted)) == {}


def test_what_several_want_is_one_object():
    moment = Moment(world(model_of()))
    one = moment.status({"heater_bed": None, "toolhead": ["position"]})
    other = moment.status({"heater_bed": (), "toolhead": ("position", "homed_axes"), "fan": None})
    assert one["heater_bed"] is other["heater_bed"]
    assert set(one["toolhead"]) < set(other["toolhead"])
    assert one == status(world(model_of()), {"heater_bed": None, "toolhead": ["position"]})


def test_wanted_of():
    wanted = wanted_of({"a": None, "b": [], "c": ["x", "y"], "d": ("z",)})
    assert wanted == {"a": None, "b": None, "c": ("x", "y"), "d": ("z",)}
    assert wanted_of({}) == {}


def test_a_text_stands_for_the_names_in_it():
    wanted = wanted_of({"fan": "speed", "print_stats": "{'state', 'filename'}", "toolhead": ""})
    assert wanted == {"fan": ("speed",), "print_stats": ("state", "filename"), "toolhead": None}


@pytest.mark.parametrize(
    "objects", [None, [], "a", 5, {"a": True}, {"a": 5}, {"a": [1]}, {"a": {"x": None}}, {5: None}]
)
def test_wanted_of_anything_else_is_refused_with_a_sentence(objects):
    with pytest.raises(ValueError, match=r"^[A-Z].*\.$"):
        wanted_of(objects)


def test_page_names_each_object_and_field():
    page = (ROOT / "docs" / "klipper.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`([^`\n]+)`", page))
    objects = {row.name for row in OBJECTS}
    fields = {field for row in OBJECTS for field in row.fields}
    assert objects - named == set()
    assert fields - named == set()


def test_each_row_has_a_name_of_its_own():
    rows = [row.name for row in OBJECTS]
    assert len(rows) == len(set(rows))


def test_row_is_found_by_the_name_of_its_objects():
    for machine, firmware in MODELS:
        at = world(model_of(machine, firmware))
        assert not [name for name in names(at) if get(at, name, "nosuch") is not None]


def test_what_is_named_twice_is_wanted_once():
    wanted = wanted_of({"heater_bed": ["target", "power"] * 5_500})
    assert wanted == {"heater_bed": ("target", "power")}


@pytest.mark.parametrize(
    "objects",
    [
        {f"temperature_sensor {number}": None for number in range(501)},
        {"heater_bed": [f"field{number}" for number in range(3001)]},
        {f"fan {number}": [f"field{field}" for field in range(20)] for number in range(200)},
    ],
    ids=["objects", "fields of one", "fields of all"],
)
def test_row_34_too_much_at_once_is_refused(objects):
    with pytest.raises(ValueError, match="No more than"):
        wanted_of(objects)
