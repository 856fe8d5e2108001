"""The model's temperatures under the names of a temperature report."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.views.temperatures import temperatures
from tests.support.examples import some

from ..strategies import ANY_JSON


def heater(current=20.5, state="off", active=60.0, standby=40.0, sensor=-1):
    return {
        "current": current,
        "state": state,
        "active": active,
        "standby": standby,
        "sensor": sensor,
    }


def heated(*heaters, beds=(), chambers=(), tools=(), analog=()):
    return {
        "heat": {
            "heaters": list(heaters),
            "bedHeaters": list(beds),
            "chamberHeaters": list(chambers),
        },
        "tools": [
            None if numbers is None else {"number": index, "heaters": list(numbers)}
            for index, numbers in enumerate(tools)
        ],
        "sensors": {"analog": list(analog)},
    }


@pytest.mark.parametrize(
    ("state", "active", "standby", "target"),
    [
        ("active", 60.0, 40.0, 60.0),
        ("active", 0, 40.0, 0),
        ("standby", 60.0, 40.0, 40.0),
        ("tuning", 60.0, 40.0, 60.0),
        ("off", 60.0, 40.0, 0.0),
        ("fault", 60.0, 40.0, 0.0),
        ("offline", 60.0, 40.0, 0.0),
        ("something new", 60.0, 40.0, 0.0),
        (None, 60.0, 40.0, 0.0),
        ("active", -273.1, 40.0, 0.0),
        ("standby", 60.0, None, 0.0),
        ("active", "60", 40.0, 0.0),
    ],
)
def test_target_is_the_one_of_the_heaters_state(state, active, standby, target):
    model = heated(heater(21.5, state, active, standby), beds=[0])
    assert temperatures(model).bed == (21.5, target)


def test_tools_have_their_own_numbers():
    model = heated(heater(1), heater(2), heater(3), tools=[(2,), None, (1,)])
    assert temperatures(model).tools == {0: (3, 0.0), 2: (2, 0.0)}


def test_number_is_the_tools_and_not_its_place():
    model = heated(heater(1), tools=[(0,)])
    model["tools"][0]["number"] = 10
    assert set(temperatures(model).tools) == {10}


@pytest.mark.parametrize("heaters", [(), (-1,), (5,), (None,)])
def test_tool_without_a_heater_is_missing(heaters):
    assert temperatures(heated(heater(), tools=[heaters])).tools == {}


def test_further_heaters_of_a_tool_are_named():
    shown = temperatures(heated(heater(1), heater(2, "active", 9.0), tools=[(0, 1)]))
    assert shown.tools == {0: (1, 0.0)}
    assert shown.others == {"Tool 0 heater 1": (2, 9.0)}


@pytest.mark.parametrize(
    ("slots", "first", "others"),
    [
        ([0], 10, {}),
        ([-1], None, {}),
        ([], None, {}),
        ([0, 1], 10, {"1": 20}),
        ([-1, 1], 20, {}),
        ([0, -1, 1], 10, {"2": 20}),
        ([None, 5, 1], 20, {}),
    ],
)
def test_first_slot_with_a_heater_counts_and_further_ones_are_named(slots, first, others):
    heaters = (heater(10), heater(20))
    beds = temperatures(heated(*heaters, beds=slots))
    chambers = temperatures(heated(*heaters, chambers=slots))
    assert beds.bed == chambers.chamber == (None if first is None else (first, 0.0))
    assert beds.chamber is chambers.bed is None
    assert beds.others == {f"B{slot}": (value, 0.0) for slot, value in others.items()}
    assert chambers.others == {f"C{slot}": (value, 0.0) for slot, value in others.items()}


SENSORS = [
    ({"lastReading": 30.5, "name": "MCU"}, {"MCU": (30.5, None)}),
    ({"lastReading": 30.5, "name": ""}, {"Sensor 0": (30.5, None)}),
    # the name isn't live: a host that is told another one first would keep both
    ({"lastReading": 30.5}, {}),
    ({"lastReading": -273.15, "name": "a"}, {}),
    ({"lastReading": 2000.0, "name": "a"}, {}),
    ({"lastReading": None, "name": "a"}, {}),
    ({"lastReading": -20.0, "name": "Ab"}, {"Ab": (-20.0, None)}),
    (None, {}),
    ({"lastReading": 5.5, "name": "B"}, {"Sensor B": (5.5, None)}),
    ({"lastReading": 5.5, "name": "T0"}, {"Sensor T0": (5.5, None)}),
    ({"lastReading": 5.5, "name": "C1"}, {"Sensor C1": (5.5, None)}),
    ({"lastReading": 5.5, "name": "Bed air"}, {"Bed air": (5.5, None)}),
    ({"lastReading": 5.5, "name": "mcu"}, {"mcu": (5.5, None)}),
    ({"lastReading": 5.5, "name": "heated bed"}, {"heated bed": (5.5, None)}),
    ({"lastReading": 5.5, "name": "kühlung"}, {"kühlung": (5.5, None)}),
    # OctoPrint's own members
    *(
        ({"lastReading": 5.5, "name": name}, {f"Sensor {name}": (5.5, None)})
        for name in ("time", "bed", "Bed", "chamber", "tool0", "tool17", "b", "c", "__proto__")
    ),
    # no temperatures
    ({"lastReading": 38.0, "name": "Box", "type": "dhthumidity"}, {}),
    ({"lastReading": 1013.0, "name": "Air", "type": "bme-pressure"}, {}),
]


@pytest.mark.parametrize(("sensor", "shown"), SENSORS)
def test_row_23_sensor_that_no_heater_uses_is_shown(sensor, shown):
    assert temperatures(heated(analog=[sensor])).others == shown


def sensor(reading):
    return {"lastReading": reading, "name": ""}


def test_sensor_of_a_heater_is_not_shown_twice():
    model = heated(heater(sensor=1), None, analog=[sensor(1.5), sensor(2.5)])
    assert temperatures(model).others == {"Sensor 0": (1.5, None)}


def test_same_names_are_told_apart():
    model = heated(analog=[{"lastReading": 1.5, "name": "Ab"}] * 3)
    assert list(temperatures(model).others) == ["Ab", "Ab 2", "Ab 3"]


def test_no_model_has_no_temperatures():
    assert temperatures({}) == ({}, None, None, {})


NAMES = st.sampled_from(
    [
        "heat",
        "heaters",
        "bedHeaters",
        "chamberHeaters",
        "tools",
        "number",
        "sensors",
        "analog",
        "lastReading",
        "name",
        "current",
        "state",
        "active",
        "standby",
        "sensor",
    ]
)
MODELS = st.recursive(
    ANY_JSON | st.integers(-1, 3),
    lambda children: st.lists(children, max_size=3) | st.dictionaries(NAMES, children, max_size=5),
    max_leaves=15,
)


@settings(max_examples=some(100))
@given(st.dictionaries(NAMES, MODELS, max_size=4))
def test_odd_values_are_harmless(model):
    shown = temperatures(model)
    assert isinstance(shown.tools, dict)


@pytest.mark.parametrize("odd", [None, [], {}, "x", True, -1, 1.5, [[]], [{}]], ids=repr)
@pytest.mark.parametrize("member", ["current", "state", "active", "standby", "sensor"])
def test_odd_member_of_a_heater_is_harmless(member, odd):
    model = heated({**heater(state="active"), member: odd}, beds=[0], tools=[(0,)])
    model["sensors"]["analog"] = [{"lastReading": 1.5, "name": odd}]
    shown = temperatures(model)
    assert set(shown.tools) <= {0}
    assert len(shown.others) <= 1
