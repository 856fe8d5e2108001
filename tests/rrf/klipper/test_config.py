"""``configfile``: sections by which clients find heaters and sensors."""

import pytest

from octoprint_rrfmodel.rrf.klipper import names

from . import HOST, MODELS, changed, get, model_of, whole, world


@pytest.mark.parametrize(("machine", "firmware"), MODELS)
def test_each_object_has_its_section(machine, firmware):
    at = world(model_of(machine, firmware), HOST._replace(macros=["Park.g"]))
    configfile = whole(at, "configfile")
    assert list(configfile["config"]) == ["printer", *names(at)]
    # as Klipper has them: clients look for the names of objects in lower case
    assert list(configfile["settings"]) == [name.lower() for name in configfile["config"]]
    assert {"gcode_macro Park"} < set(configfile["config"])


def test_of_two_that_differ_in_case_the_first_has_the_settings():
    sensors = [{"type": "thermistor", "name": name} for name in ("A", "a")]
    configfile = whole(world({"sensors": {"analog": sensors}}), "configfile")
    assert {"temperature_sensor A", "temperature_sensor a"} < set(configfile["config"])
    assert "temperature_sensor a" in configfile["settings"]


HEATER = ("min_temp", "max_temp", "max_power", "control", "heater_pin", "sensor_type")

WHOLE_SECTIONS = {
    "printer": ("kinematics", "max_velocity", "max_accel"),
    "extruder": (
        *HEATER,
        *("min_extrude_temp", "filament_diameter"),
        *("max_extrude_only_distance", "max_extrude_only_velocity", "max_extrude_only_accel"),
    ),
    "heater_bed": HEATER,
    "heater_generic": HEATER,
    "fan": ("pin",),
    "fan_generic": ("pin",),
    "heater_fan": ("pin", "heater"),
    "controller_fan": ("pin",),
    "temperature_fan": ("pin",),
    "output_pin": ("pwm",),
    "gcode_macro": ("gcode",),
}
"""Options that Klipper always has, and clients read without a look whether they are there."""


@pytest.mark.parametrize(("machine", "firmware"), MODELS)
def test_sections_are_whole(machine, firmware):
    at = world(model_of(machine, firmware), HOST._replace(macros=["Park.g"]))
    for section, options in get(at, "configfile", "settings").items():
        kind = section.partition(" ")[0].rstrip("0123456789")
        assert set(WHOLE_SECTIONS.get(kind, ())) <= set(options), section
        assert None not in options.values()


def as_number(written):
    """Return whether a text stands for a number, a truth value or a list."""
    return not written or written in ("True", "False") or float(written) is not None


@pytest.mark.parametrize(("machine", "firmware"), MODELS)
def test_config_is_settings_as_text(machine, firmware):
    configfile = whole(world(model_of(machine, firmware)), "configfile")
    for section, config in configfile["config"].items():
        settings = configfile["settings"][section.lower()]
        assert set(config) == set(settings)
        for name, value in settings.items():
            assert isinstance(config[name], str)
            assert config[name] == value if isinstance(value, str) else as_number(config[name])


MODEL = {
    "move": {
        "kinematics": {"name": "coreXY"},
        "axes": [
            {"letter": "X", "speed": 18000.0, "acceleration": 3000.0},
            {"letter": "Y", "speed": 15000.5, "acceleration": 3500.0},
        ],
        "printingAcceleration": 20000.0,
        "extruders": [{"speed": 3600.0, "acceleration": 800.0, "filamentDiameter": 2.85}],
    },
    "heat": {
        "heaters": [
            {"min": -273.1, "max": 120.0, "model": {"pid": {"used": False}, "maxPwm": 0.5}},
            {"min": 5, "max": 285, "sensor": 0},
            {"current": 20.0},
        ],
        "bedHeaters": [0],
        "chamberHeaters": [2],
        "coldExtrudeTemperature": 160,
    },
    "sensors": {"analog": [{"type": "thermistor"}]},
    "tools": [None, {"number": 1, "heaters": [1], "extruders": [0]}],
    "directories": {"gCodes": "0:/jobs/"},
}

SECTIONS = [
    (
        "printer",
        {"kinematics": "corexy", "max_velocity": 15000.5 / 60, "max_accel": 3000.0},
        {"kinematics": "corexy", "max_velocity": "250.00833", "max_accel": "3000"},
    ),
    (
        "extruder1",
        {
            **{"min_temp": 5, "max_temp": 285, "max_power": 1.0, "control": "pid"},
            **{"heater_pin": "", "sensor_type": "thermistor", "min_extrude_temp": 160},
            "filament_diameter": 2.85,
            **{"max_extrude_only_distance": 1000.0, "max_extrude_only_velocity": 60.0},
            "max_extrude_only_accel": 800.0,
        },
        {
            **{"min_temp": "5", "max_temp": "285", "max_power": "1", "control": "pid"},
            **{"heater_pin": "", "sensor_type": "thermistor", "min_extrude_temp": "160"},
            "filament_diameter": "2.85",
            **{"max_extrude_only_distance": "1000", "max_extrude_only_velocity": "60"},
            "max_extrude_only_accel": "800",
        },
    ),
    (
        "heater_bed",
        {
            **{"min_temp": -273.1, "max_temp": 120.0, "max_power": 0.5, "control": "watermark"},
            **{"heater_pin": "", "sensor_type": ""},
        },
        {
            **{"min_temp": "-273.1", "max_temp": "120", "max_power": "0.5"},
            **{"control": "watermark", "heater_pin": "", "sensor_type": ""},
        },
    ),
    (
        "heater_generic chamber",
        {
            **{"min_temp": 0.0, "max_temp": 125.0, "max_power": 1.0, "control": "pid"},
            **{"heater_pin": "", "sensor_type": ""},
        },
        {
            **{"min_temp": "0", "max_temp": "125", "max_power": "1", "control": "pid"},
            **{"heater_pin": "", "sensor_type": ""},
        },
    ),
    ("virtual_sdcard", {"path": "0:/jobs/"}, {"path": "0:/jobs/"}),
    ("bed_mesh", {}, {}),
]


@pytest.mark.parametrize(("section", "settings", "config"), SECTIONS)
def test_section(section, settings, config):
    configfile = whole(world(MODEL), "configfile")
    assert configfile["settings"][section] == settings
    assert configfile["config"][section] == config


def test_nothing_known():
    configfile = whole(world(), "configfile")
    # a board that can't be asked has the firmware's defaults
    assert configfile["settings"]["printer"] == {
        **{"kinematics": "none", "max_velocity": 100.0, "max_accel": 500.0}
    }
    assert configfile["settings"]["virtual_sdcard"] == {"path": "0:/gcodes/"}
    assert configfile["save_config_pending"] is False
    assert configfile["save_config_pending_items"] == {}
    assert configfile["warnings"] == []


def test_nothing_that_is_not_a_number_gets_into_it():
    model = changed(MODEL, **{"heat.heaters[0].max": float("nan"), "heat.heaters[0].min": "x"})
    section = get(world(model), "configfile", "config")["heater_bed"]
    assert section["max_temp"] == "125" and section["min_temp"] == "0"


def test_how_fast_z_may_move():
    axes = [*MODEL["move"]["axes"], {"letter": "Z", "speed": 600.0, "acceleration": 20.0}]
    printer = get(world({"move": {"axes": axes}}), "configfile", "settings")["printer"]
    assert (printer["max_z_velocity"], printer["max_z_accel"]) == (10.0, 20.0)


def test_a_list_and_a_truth_value_are_written_as_klipper_does():
    fans = [{}, {"name": "Hotend", "thermostatic": {"sensors": [0]}}]
    model = {"fans": fans, "sensors": {"analog": [{"type": "thermistor"}]}}
    model["state"] = {"gpOut": [{"pwm": 0.5}]}
    config = get(world(model), "configfile", "config")
    assert config["heater_fan Hotend"] == {"pin": "", "heater": ""}
    assert config["output_pin gpOut0"] == {"pin": "", "pwm": "True"}
