"""Extruders, heaters, temperature sensors and fans."""

import pytest

from octoprint_rrfmodel.rrf.klipper import Kept, names
from octoprint_rrfmodel.rrf.wire.m408 import M408Model

from . import HOST, Machine, changed, get, model_of, whole, world


def heater(current=20.5, state="off", **members):
    return {"current": current, "state": state, "active": 60.0, "standby": 40.0, **members}


def heated(*heaters, tools=(), **members):
    return {
        "heat": {"heaters": list(heaters), "coldExtrudeTemperature": 160.0, **members},
        "tools": [
            None if heaters is None else {"number": index, "heaters": list(heaters)}
            for index, heaters in enumerate(tools)
        ],
        "state": {"status": "idle"},
    }


def of_kind(at, kind):
    return [name for name in names(at) if name.startswith(kind)]


EXTRUDERS = [
    pytest.param([(0,)], ["extruder"], id="tool 0"),
    pytest.param([None, (0,)], ["extruder1"], id="tool 1 alone"),
    pytest.param([(0,), (1,)], ["extruder", "extruder1"], id="two tools"),
    pytest.param([(), (1,)], ["extruder1"], id="tool 0 without a heater"),
    pytest.param([(-1,), (1,)], ["extruder1"], id="heater -1"),
    pytest.param([(5,), (1,)], ["extruder1"], id="heater that isn't there"),
    pytest.param([(0, 1)], ["extruder"], id="two heaters"),
    pytest.param([], [], id="no tools"),
]


@pytest.mark.parametrize(("tools", "extruders"), EXTRUDERS)
def test_extruder_for_each_tool_with_a_heater(tools, extruders):
    assert of_kind(world(heated(heater(), heater(), tools=tools)), "extruder") == extruders


@pytest.mark.parametrize("number", [-1, True, "1", None, 1.0, 2**70])
def test_tool_with_an_odd_number_is_none(number):
    model = heated(heater(), tools=[(0,)])
    model["tools"][0]["number"] = number
    assert of_kind(world(model), "extruder") == []


def test_extruders_have_the_tools_numbers():
    at = world(changed(model_of("toolchanger"), **{"state.currentTool": 7}))
    assert of_kind(at, "extruder") == ["extruder1", "extruder3", "extruder7", "extruder10"]
    assert get(at, "toolhead", "extruder") == "extruder7"
    assert whole(at, "extruder") == {}


def test_no_extruders_on_a_router():
    at = world(model_of("cnc"))
    assert of_kind(at, "extruder") == of_kind(at, "heater_") == of_kind(at, "fan") == []
    assert get(at, "heaters", "available_heaters") == []


@pytest.mark.parametrize(
    ("state", "target"),
    [
        ("active", 60.0),
        ("tuning", 60.0),
        ("standby", 40.0),
        ("off", 0.0),
        ("fault", 0.0),
        ("offline", 0.0),
        ("something new", 0.0),
        (None, 0.0),
    ],
)
def test_target_is_the_one_of_the_heaters_state(state, target):
    model = heated(heater(state=state), tools=[(0,)], bedHeaters=[0], chamberHeaters=[0])
    for name in ("extruder", "heater_bed", "heater_generic chamber"):
        assert get(world(model), name, "target") == target


HEATER_FIELDS = [
    ("temperature", {"current": 21.5}, 21.5),
    ("temperature", {"current": 21.5, "state": "offline"}, None),
    ("temperature", {"current": 2000.0, "state": "fault"}, 2000.0),
    ("temperature", {"current": None}, None),
    ("temperature", {"current": float("nan")}, None),
    ("target", {"state": "active", "active": None}, 0.0),
    ("target", {"state": "active", "active": -273.15}, 0.0),
    ("target", {"state": "active", "active": -10.0}, -10.0),
    ("power", {"avgPwm": 0.35}, 0.35),
    ("power", {}, None),
]


@pytest.mark.parametrize(("field", "members", "value"), HEATER_FIELDS)
def test_field_of_a_heater(field, members, value):
    model = heated({**heater(), **members}, tools=[(0,)], bedHeaters=[0], chamberHeaters=[0])
    for name in ("extruder", "heater_bed", "heater_generic chamber"):
        assert get(world(model), name, field) == value


@pytest.mark.parametrize(
    ("drive", "advance"),
    [
        ({"pressureAdvance": 0.045}, 0.045),
        ({"pressureAdvance": 0}, 0.0),
        ({"pressAdv": {"k0": 0.05}}, 0.05),
        ({"pressAdv": {"k": 0.06}}, 0.06),
        ({"pressAdv": {"k0": None, "k": 0.06}}, 0.06),
        ({"pressAdv": 1}, 0.0),
        ({}, 0.0),
        (None, 0.0),
    ],
)
def test_pressure_advance_is_that_of_the_tools_first_drive(drive, advance):
    model = heated(heater(), tools=[(0,)])
    model["tools"][0]["extruders"] = [1]
    model["move"] = {"extruders": [{"pressureAdvance": 0.9}, drive]}
    assert get(world(model), "extruder", "pressure_advance") == advance


def test_pressure_advance_without_a_drive():
    model = heated(heater(), tools=[(0,)])
    model["move"] = {"extruders": [{"pressureAdvance": 0.9}]}
    assert get(world(model), "extruder", "pressure_advance") == 0.0


@pytest.mark.parametrize(
    ("current", "limit", "can"),
    [
        (159.9, 160.0, False),
        (160.0, 160.0, True),
        (20.0, 0, True),
        (None, 160.0, None),
        (200.0, None, None),
    ],
)
def test_can_extrude(current, limit, can):
    model = heated(heater(current), tools=[(0,)], coldExtrudeTemperature=limit)
    assert get(world(model), "extruder", "can_extrude") is can


def test_fixed_fields_of_an_extruder():
    extruder = whole(world(heated(heater(), tools=[(0,)])), "extruder")
    assert extruder["smooth_time"] == 0.0
    assert extruder["motion_queue"] is None


@pytest.mark.parametrize(
    ("slots", "temperature"),
    [
        ([0], 10.0),
        ([-1, 1], 20.0),
        ([1, 0], 20.0),
        ([-1], None),
        ([], None),
        (None, None),
        ([5], None),
    ],
)
def test_first_slot_with_a_heater_is_the_bed_and_the_chamber(slots, temperature):
    model = heated(heater(10.0), heater(20.0), bedHeaters=slots, chamberHeaters=slots)
    at = world(model)
    for name in ("heater_bed", "heater_generic chamber"):
        assert (name in names(at)) is (temperature is not None)
        assert whole(at, name).get("temperature") == temperature


def test_further_heaters_of_a_tool_are_generic():
    model = heated(heater(1.0), heater(2.0), heater(3.0), tools=[None, (0, 2, 7)])
    at = world(model)
    assert of_kind(at, "heater_generic") == ["heater_generic tool1_h1"]
    assert get(at, "heater_generic tool1_h1", "temperature") == 3.0


def analog(model, *sensors):
    return {**model, "sensors": {"analog": list(sensors)}}


def sensor(value, name="", **members):
    return {"lastReading": value, "name": name, **members}


READINGS = [
    pytest.param(sensor(30.5), 30.5, id="3.4"),
    pytest.param(sensor(30.5, state="ok"), 30.5, id="ok"),
    pytest.param(sensor(30.5, state=None), 30.5, id="state unknown"),
    pytest.param(sensor(30.5, state="openCircuit"), None, id="open circuit"),
    pytest.param(sensor(2000.0), None, id="2000"),
    pytest.param(sensor(2000), None, id="2000 without decimals"),
    pytest.param(sensor(-273.15), None, id="absolute zero"),
    pytest.param(sensor(-20.5), -20.5, id="frost"),
    pytest.param(sensor(None), None, id="null"),
]


@pytest.mark.parametrize(("shown", "temperature"), READINGS)
def test_temperature_of_a_sensor(shown, temperature):
    at = world(analog({}, shown))
    assert whole(at, "temperature_sensor sensor0") == {
        "temperature": temperature,
        "measured_min_temp": temperature,
        "measured_max_temp": temperature,
    }


def test_sensors_that_no_heater_uses_have_their_names():
    model = analog(
        heated(heater(sensor=1), None),
        sensor(1.5, "Chamber"),
        sensor(2.5, "used"),
        None,
        sensor(3.5),
        sensor(4.5, "Chamber"),
        sensor(5.5, "  "),
        sensor(6.5, 7),
    )
    at = world(model)
    shown = {name: get(at, name, "temperature") for name in of_kind(at, "temperature_sensor")}
    assert shown == {
        "temperature_sensor Chamber": 1.5,
        "temperature_sensor sensor3": 3.5,
        "temperature_sensor sensor4": 4.5,
        "temperature_sensor sensor5": 5.5,
        "temperature_sensor sensor6": 6.5,
    }


def test_boards_measure_too():
    model = {
        "boards": [
            {"mcuTemp": {"current": 40.5, "min": 20.5, "max": 41.5}},
            {"canAddress": 20, "mcuTemp": {"current": 2000.0}},
            {"canAddress": 21, "mcuTemp": None},
            {"canAddress": 22},
        ]
    }
    at = world(model)
    assert of_kind(at, "temperature_sensor") == [
        "temperature_sensor mcu_0",
        "temperature_sensor mcu_20",
    ]
    assert whole(at, "temperature_sensor mcu_0") == {
        "temperature": 40.5,
        "measured_min_temp": 20.5,
        "measured_max_temp": 41.5,
    }
    assert set(whole(at, "temperature_sensor mcu_20").values()) == {None}


def test_extremes_are_kept_since_the_connection():
    kept = Kept()
    for now, value in enumerate([30.0, 28.0, 2000.0, -273.15, 33.0, None, 31.0]):
        kept.observe(analog({}, sensor(value, "a")), HOST, float(now))
    at = world(analog({}, sensor(31.0, "a"), sensor(5.0, "b")), kept=kept.snapshot)
    assert whole(at, "temperature_sensor a") == {
        "temperature": 31.0,
        "measured_min_temp": 28.0,
        "measured_max_temp": 33.0,
    }
    assert get(at, "temperature_sensor b", "measured_max_temp") == 5.0
    kept.forget()
    kept.observe(analog({}, sensor(31.0, "a")), HOST, 100.0)
    assert kept.snapshot.extremes == {"a": (31.0, 31.0)}


def fan(speed=0.5, **members):
    return {"requestedValue": speed, "actualValue": 0.25, "rpm": -1, "name": "", **members}


def fans(*fans, tool_fans=None, current=0):
    tools = [] if tool_fans is None else [{"number": 0, "fans": tool_fans}]
    return {"fans": list(fans), "tools": tools, "state": {"currentTool": current}}


PART_FANS = [
    pytest.param(fans(fan(0.1), fan(0.2), tool_fans=[1]), 0.2, id="the tool's"),
    pytest.param(fans(fan(0.1), fan(0.2), tool_fans=[1], current=-1), 0.1, id="no tool"),
    pytest.param(fans(fan(0.1), fan(0.2), tool_fans=[]), 0.1, id="tool without fans"),
    pytest.param(fans(fan(0.1), None, tool_fans=[1]), 0.1, id="the tool's is null"),
    pytest.param(fans(fan(-1)), 0.0, id="-1"),
    pytest.param(fans(fan(None)), 0.0, id="null"),
    pytest.param(fans(fan(1.5)), 1.0, id="too much"),
]


@pytest.mark.parametrize(("model", "speed"), PART_FANS)
def test_fan_is_the_part_fan(model, speed):
    assert get(world(model), "fan", "speed") == speed


@pytest.mark.parametrize("model", [{}, fans(), fans(None), fans(None, fan())])
def test_no_fan_without_a_part_fan(model):
    assert "fan" not in names(world(model))


@pytest.mark.parametrize(("rpm", "shown"), [(-1, None), (0, 0), (4500, 4500), (None, None)])
def test_rpm(rpm, shown):
    at = world(fans(fan(rpm=rpm), fan(rpm=rpm)))
    assert get(at, "fan", "rpm") == get(at, "fan_generic fan1", "rpm") == shown


def ruled(**thermostatic):
    return {"lowTemperature": 45.0, "highTemperature": 50.0, **thermostatic}


def test_other_fans_by_kind():
    model = analog(
        fans(
            fan(0.1),
            fan(0.2, name="Aux"),
            fan(0.3, name="Hotend", thermostatic=ruled(sensors=[0])),
            fan(0.4, thermostatic=ruled(heaters=[1])),
            fan(0.6, name="Case", thermostatic=ruled(sensors=[2])),
            fan(0.7, name="Aux", thermostatic=ruled(sensors=[])),
            None,
        ),
        sensor(50.0, type="thermistor"),
        sensor(60.0, type="thermistor"),
        sensor(40.0, type="mcutemp"),
    )
    at = world(model)
    kinds = {
        kind: of_kind(at, kind)
        for kind in ("fan_generic", "heater_fan", "controller_fan", "temperature_fan")
    }
    assert kinds == {
        "fan_generic": ["fan_generic Aux", "fan_generic fan5"],
        "heater_fan": ["heater_fan Hotend", "heater_fan fan3"],
        "controller_fan": ["controller_fan Case"],
        "temperature_fan": [
            "temperature_fan Hotend",
            "temperature_fan fan3",
            "temperature_fan Case",
        ],
    }
    assert whole(at, "fan_generic Aux") == {"speed": 0.2, "rpm": None}
    # nobody asks for the speed of a thermostatic one
    assert whole(at, "heater_fan Hotend") == {"speed": 0.25, "rpm": None}
    assert whole(at, "controller_fan Case") == {"speed": 0.25, "rpm": None}


TEMPERATURE_FANS = [
    (ruled(sensors=[0, 1]), {"speed": 0.25, "temperature": 60.0, "target": 45.0}),
    (ruled(heaters=[0]), {"speed": 0.25, "temperature": 50.0, "target": 45.0}),
    (ruled(sensors=[2]), {"speed": 0.25, "temperature": None, "target": 45.0}),
    (ruled(sensors=[2, 0]), {"speed": 0.25, "temperature": 50.0, "target": 45.0}),
    (ruled(sensors=[9]), {"speed": 0.25, "temperature": None, "target": 45.0}),
    ({"sensors": [0]}, {"speed": 0.25, "temperature": 50.0, "target": None}),
    (ruled(sensors=[]), {}),
    (None, {}),
]


@pytest.mark.parametrize(("thermostatic", "shown"), TEMPERATURE_FANS)
def test_temperature_fan(thermostatic, shown):
    model = analog(fans(fan(thermostatic=thermostatic)), sensor(50.0), sensor(60.0), sensor(2000.0))
    assert whole(world(model), "temperature_fan fan0") == shown


@pytest.mark.parametrize("value", [None, "x", -1])
def test_speed_of_a_temperature_fan_that_is_not_known(value):
    model = analog(fans(fan(actualValue=value, thermostatic=ruled(sensors=[0]))), sensor(50.0))
    assert get(world(model), "temperature_fan fan0", "speed") == 0.0


def test_heaters_lists_all():
    at = world(model_of("idex"))
    heaters = ["extruder", "extruder1", "extruder2", "heater_bed", "heater_generic tool2_h1"]
    assert whole(at, "heaters") == {
        "available_heaters": heaters,
        "available_sensors": [*heaters, "temperature_sensor mcu_0"],
        "available_monitors": [],
    }


def test_heaters_lists_what_is_served():
    at = world(model_of("corexy"))
    listed = get(at, "heaters", "available_sensors")
    assert set(listed) <= set(names(at))
    assert {"heater_generic chamber", "temperature_sensor mcu", "temperature_fan Hotend"} <= set(
        listed
    )


def test_targets_are_followed():
    machine = Machine("cartesian")
    machine.send("T0", "M140 S60", "M568 P0 S200 R150 A2")
    machine.wait(20)
    assert machine.get("heater_bed", "target") == 60.0
    assert machine.get("extruder", "target") == 200.0
    assert machine.get("toolhead", "extruder") == "extruder"
    assert machine.get("extruder", "power") > 0
    assert machine.get("extruder", "temperature") > 25
    machine.send("M568 P0 A1")
    machine.wait(3)
    assert machine.get("extruder", "target") == 150.0


S0 = {
    "status": "I",
    "heaters": [60.1, 205.3, 23.4],
    "active": [60.0, 205.0, 0.0],
    "standby": [0.0, 150.0, 0.0],
    "hstat": [2, 1, 0],
    "efactor": [95.0, 105.0],
    "tool": 1,
}


def test_m408_s0_tells_no_tools_and_each_free_heater_is_an_extruder():
    at = world(M408Model().take(S0))
    assert of_kind(at, "extruder") == ["extruder", "extruder1"]
    assert whole(at, "extruder")["target"] == 150.0
    assert whole(at, "extruder1")["temperature"] == 23.4
    assert get(at, "heater_bed", "target") == 60.0
    assert get(at, "toolhead", "extruder") == "extruder1"
    assert get(at, "gcode_move", "extrude_factor") == 1.05


def test_m408_s3_tells_the_tools_numbers():
    at = world(model_of("toolchanger", "2.05"))
    assert of_kind(at, "extruder") == ["extruder1", "extruder3", "extruder7", "extruder10"]


def test_m408_tells_which_fans_a_temperature_rules():
    at = world(model_of("cartesian", "2.05"))
    assert of_kind(at, "heater_fan") == ["heater_fan Hotend"]
    assert of_kind(at, "fan_generic") == []
