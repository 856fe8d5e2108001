"""``configfile``: sections by which clients find heaters and sensors."""

import pytest

from octoprint_rrfmodel.rrf.klipper import names

from . import HOST, MODELS, changed, get, model_of, whole, world


@pytest.mark.parametrize(("machine", "firmware"), MODELS)
def test_each_object_has_its_section(machine, firmware):
    at = world(model_of(machine, firmware), HOST._replace(macros=["Park.g"]))
    configfile = whole(at, "configfile")
    for sections in (configfile["config"], configfile["settings"]):
        assert list(sections) == ["printer", *names(at)]
        assert "gcode_macro Park" in sections


@pytest.mark.parametrize(("machine", "firmware"), MODELS)
def test_config_is_settings_as_text(machine, firmware):
    configfile = whole(world(model_of(machine, firmware)), "configfile")
    for section, settings in configfile["settings"].items():
        config = configfile["config"][section]
        assert set(config) == set(settings)
        for name, value in settings.items():
            assert isinstance(config[name], str)
            assert config[name] == value if isinstance(value, str) else float(config[name]) == value


MODEL = {
    "move": {
        "kinematics": {"name": "coreXY"},
        "axes": [
            {"letter": "X", "speed": 18000.0, "acceleration": 3000.0},
            {"letter": "Y", "speed": 15000.5, "acceleration": 3500.0},
        ],
        "printingAcceleration": 20000.0,
    },
    "heat": {
        "heaters": [{"min": -273.1, "max": 120.0}, {"min": 5, "max": 290}, {"current": 20.0}],
        "bedHeaters": [0],
        "chamberHeaters": [2],
        "coldExtrudeTemperature": 160,
    },
    "tools": [None, {"number": 1, "heaters": [1]}],
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
        {"min_temp": 5, "max_temp": 290, "min_extrude_temp": 160},
        {"min_temp": "5", "max_temp": "290", "min_extrude_temp": "160"},
    ),
    (
        "heater_bed",
        {"min_temp": -273.1, "max_temp": 120.0},
        {"min_temp": "-273.1", "max_temp": "120"},
    ),
    ("heater_generic chamber", {}, {}),
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
    assert configfile["settings"]["printer"] == {}
    assert configfile["settings"]["virtual_sdcard"] == {"path": "0:/gcodes/"}
    assert configfile["save_config_pending"] is False
    assert configfile["save_config_pending_items"] == {}
    assert configfile["warnings"] == []


def test_nothing_that_is_not_a_number_gets_into_it():
    model = changed(MODEL, **{"heat.heaters[0].max": float("nan"), "heat.heaters[0].min": "x"})
    assert get(world(model), "configfile", "config")["heater_bed"] == {}
