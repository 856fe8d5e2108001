"""``M408`` replies kept together: letters, boxes, forms that follow each other, odd values."""

import copy

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.wire.m408 import M408Model
from octoprint_rrfmodel.rrf.wire.m408_table import CONFIG_FIELDS, LEGACY, STATUS_FIELDS
from tests.support.examples import some

from ..strategies import ANY_JSON, VALUES

# letter, state for S2 and above, state for S0 and S1
LETTERS = [
    ("C", "starting", "starting"),
    ("F", "updating", "updating"),
    ("H", "halted", "halted"),
    ("O", "off", "off"),
    ("D", "pausing", "pausing"),
    ("R", "resuming", "resuming"),
    ("S", "paused", "halted"),
    ("A", "cancelling", "paused"),
    ("M", "simulating", "simulating"),
    ("P", "processing", "processing"),
    ("T", "changingTool", "changingTool"),
    ("B", "busy", "busy"),
    ("I", "idle", "idle"),
    ("X", "X", "X"),
    ("", "", ""),
]


def taken(*replies):
    model = M408Model()
    result = {}
    for reply in replies:
        result = model.take(reply)
    return result


def legacy(**members):
    return {"status": "I", "heaters": [21.5, 20.0], **members}


def status(**members):
    return {"status": "I", **members}


@pytest.mark.parametrize(("letter", "state", "legacy_state"), LETTERS)
def test_letter_means_another_state_in_s0_and_s1(letter, state, legacy_state):
    assert taken(status(status=letter))["state"]["status"] == state
    assert taken(legacy(status=letter))["state"]["status"] == legacy_state


@pytest.mark.parametrize("letter", [None, 5, [], {}])
def test_letter_that_is_none_is_harmless(letter):
    reading = {"temps": {"current": [1.0]}}
    assert taken(status(status=letter, **reading))["heat"]["heaters"] == [{"current": 1.0}]
    assert taken(legacy(status=letter))["heat"]["heaters"][0]["current"] == 21.5


@pytest.mark.parametrize(
    ("number", "state"),
    enumerate(["off", "standby", "active", "fault", "tuning", "offline", "unknown"]),
)
def test_number_of_a_heaters_state(number, state):
    assert taken(legacy(hstat=[number]))["heat"]["heaters"][0]["state"] == state
    temps = {"state": [0, number]}
    assert taken(status(temps=temps))["heat"]["heaters"][1]["state"] == state


@pytest.mark.parametrize(
    ("text", "values"),
    [("1000", [1000]), ("0", [0]), ("1000 (12)", [1000, 12]), ("-5", [-5])],
)
def test_probe_text_is_one_value_or_two(text, values):
    assert taken(legacy(probe=text))["sensors"]["probes"] == [{"value": values}]


@pytest.mark.parametrize("text", ["none", "", 1000, None, [1]])
def test_probe_that_is_not_understood_stays_readable(text):
    model = taken(legacy(probe=text))
    assert model["state"]["status"] == "idle"


@pytest.mark.parametrize(
    ("rpm", "expected"), [(1200, [1200]), ([1200], [1200]), ([1200, -1], [1200, -1]), (0, [0])]
)
def test_fan_speed_is_a_number_or_a_list(rpm, expected):
    params = {"fanPercent": [0, 0][: len(expected)]}
    model = taken(status(sensors={"fanRPM": rpm}, params=params))
    assert [fan["rpm"] for fan in model["fans"]] == expected


def test_fan_that_is_not_there_has_no_place():
    model = taken(status(params={"fanPercent": [50, -1, 100, -1, -1]}))
    assert model["fans"] == [{"requestedValue": 0.5}, None, {"requestedValue": 1.0}]
    assert "fans" not in taken(legacy(fanPercent=[0.0, -1, -1], fanRPM=[-1, -1]))


@pytest.mark.parametrize(("number", "power"), [(-1, None), (0, False), (1, True)])
def test_power_is_null_where_it_can_not_be_switched(number, power):
    assert taken(status(params={"atxPower": number}))["state"]["atxPower"] is power


def test_what_has_no_place_stays_readable():
    model = taken(
        status(strange={"x": [1, {"y": None}]}, params={"atxPower": 1, "other": 5}),
        {"axisMins": [0.0], "unheard": "of"},
        legacy(further=[1]),
    )
    assert model["m408"]["strange"] == {"x": [1, {"y": None}]}
    assert model["m408"]["params"] == {"other": 5}
    assert model["m408"]["unheard"] == "of"
    assert model["m408"]["further"] == [1]
    assert "status" not in model["m408"]


def test_drives_that_may_be_no_axes_stay_readable():
    config = {"axisMins": [0, 0, 0], "currents": [1200, 1200, 1500, 0, 800]}
    model = taken(config)
    assert [axis["current"] for axis in model["move"]["axes"]] == [1200, 1200, 1500]
    assert model["m408"]["currents"] == config["currents"]


def test_axis_names_tell_how_many_drives_are_axes():
    config = {"axisMins": [0, 0, 0], "currents": [1, 2, 3, 4, 5]}
    model = taken(config, status(axisNames="XYZU"))
    assert [axis["current"] for axis in model["move"]["axes"]] == [1, 2, 3, 4]


BOX = {"msg": "Press OK", "title": "Probing", "mode": 2, "seq": 1, "timeout": 0.0, "controls": 4}
AS_MODEL = {
    "message": "Press OK",
    "title": "Probing",
    "mode": 2,
    "seq": 1,
    "timeout": 0.0,
    "axisControls": 4,
}
LEGACY_BOX = {f"msgBox.{name}": value for name, value in BOX.items()}
NO_LEGACY_BOX = {"msgBox.mode": -1}

# replies one after another, and the box that is open after each
BOXES = {
    "S2 opens": [(status(output={"msgBox": BOX}), AS_MODEL)],
    "S2 closes": [(status(output={"msgBox": BOX}), AS_MODEL), (status(), None)],
    "S2 closes while a message comes": [
        (status(output={"msgBox": BOX}), AS_MODEL),
        (status(output={"message": "done"}), None),
    ],
    "S2 opens another one": [
        (status(output={"msgBox": BOX}), AS_MODEL),
        (status(output={"msgBox": {"mode": 1, "seq": 2}}), {"mode": 1, "seq": 2}),
    ],
    "S0 opens and closes": [
        (legacy(**LEGACY_BOX), AS_MODEL),
        (legacy(**NO_LEGACY_BOX), None),
    ],
    "S0 has none": [(legacy(**NO_LEGACY_BOX), None)],
    "S0 opens, S2 closes": [(legacy(**LEGACY_BOX), AS_MODEL), (status(), None)],
    "S2 opens, S5 comes": [
        (status(output={"msgBox": BOX}), AS_MODEL),
        ({"axisMins": [0]}, AS_MODEL),
    ],
    "S2 opens, S0 knows another one": [
        (status(output={"msgBox": BOX}), AS_MODEL),
        (legacy(**LEGACY_BOX), AS_MODEL),
        (status(), None),
    ],
}


@pytest.mark.parametrize("steps", BOXES.values(), ids=BOXES)
def test_message_box_opens_and_closes(steps):
    model = M408Model()
    for reply, box in steps:
        assert model.take(copy.deepcopy(reply))["state"]["messageBox"] == box


def test_beep_and_message_are_there_while_they_last():
    beep = {"beepDuration": 100, "beepFrequency": 800}
    model = M408Model()
    state = model.take(status(output={**beep, "message": "a"}))["state"]
    assert (state["beep"], state["displayMessage"]) == ({"duration": 100, "frequency": 800}, "a")
    state = model.take(status(output={"message": "b"}))["state"]
    assert state["displayMessage"] == "b"
    assert state.get("beep") is None
    state = model.take(status())["state"]
    assert not state.get("displayMessage")


@pytest.mark.parametrize("heaters", [[-1], [5], [1.0], [None], ["1"], 1, None, [[1]]], ids=repr)
def test_tool_with_a_heater_that_is_none_is_harmless(heaters):
    temps = {"current": [21.0, 22.0], "tools": {"active": [[200.0]]}}
    model = taken(status(temps=temps, tools=[{"number": 0, "heaters": heaters}]))
    assert model["heat"]["heaters"] == [{"current": 21.0}, {"current": 22.0}]


def test_targets_of_tools_are_those_of_their_heaters():
    model = taken(
        status(
            temps={
                "current": [21.0, 22.0, 23.0],
                "tools": {"active": [[200.0, 210.0]], "standby": [[150.0, 160.0]]},
            },
            tools=[{"number": 0, "heaters": [2, 1]}],
        )
    )
    targets = [(heater.get("active"), heater.get("standby")) for heater in model["heat"]["heaters"]]
    assert targets == [(None, None), (210.0, 160.0), (200.0, 150.0)]


def test_heater_of_several_tools_has_the_target_of_the_current_one():
    model = M408Model().take(
        {
            "status": "I",
            "currentTool": 0,
            "temps": {"state": [0, 2], "tools": {"active": [[210], [50]], "standby": [[90], [40]]}},
            "tools": [{"number": 0, "heaters": [1]}, {"number": 1, "heaters": [1]}],
        }
    )
    heater = model["heat"]["heaters"][1]
    assert (heater["active"], heater["standby"]) == (210, 90)


def test_machine_without_tools_has_a_list_of_none():
    model = M408Model()
    assert "tools" not in model.take({"status": "I"})
    assert model.take({"status": "I", "tools": []})["tools"] == []
    assert model.take({"status": "B"})["tools"] == []


def test_forms_that_lack_a_member_keep_what_another_said():
    model = taken(
        status(axisNames="XY", tools=[{"number": 0, "name": "a"}]),
        {"axisMins": [0.0, 0.0]},
        status(coords={"xyz": [1.0, 2.0]}),
    )
    assert model["tools"][0]["name"] == "a"
    assert model["move"]["axes"][1] == {"letter": "Y", "userPosition": 2.0, "min": 0.0}


def test_list_that_gets_shorter_is_shorter():
    model = taken(status(temps={"current": [1.0, 2.0]}), status(temps={"current": [1.0]}))
    assert model["heat"]["heaters"] == [{"current": 1.0}]


def test_no_slot_is_taken_for_a_heater_that_is_none():
    bed = {"current": 0.0, "active": 0.0, "state": 0, "heater": -1}
    model = taken(status(temps={"current": [1.0], "bed": bed}))
    assert model["heat"]["heaters"] == [{"current": 1.0}]
    assert taken(status(temps={"bed": {"current": 20.0}}))["state"]["status"] == "idle"


@pytest.mark.parametrize("heater", [10**9, 2.5, "1", None, [], True, -(10**9)])
def test_absurd_heater_number_is_harmless(heater):
    model = taken(status(temps={"current": [1.0], "bed": {"current": 5.0, "heater": heater}}))
    assert model["state"]["status"] == "idle"
    assert len(model["heat"]["heaters"]) <= 2


def test_what_was_taken_is_not_changed():
    first = status(temps={"current": [1.0], "tools": {"active": [[5.0]]}}, tools=[{"heaters": [0]}])
    kept = copy.deepcopy(first)
    model = M408Model()
    result = model.take(first)
    snapshot = copy.deepcopy(result)
    model.take(status(temps={"current": [2.0], "tools": {"active": [[6.0]]}}))
    assert (first, result) == (kept, snapshot)


def members_of(rows):
    """Return the top-level names, and the names below, that rows speak of."""
    return sorted({part for row in rows for part in row.field.replace("[]", "").split(".")})


NAMES = sorted(
    {name for rows in (LEGACY, STATUS_FIELDS, CONFIG_FIELDS) for name in members_of(rows)}
)
TREES = st.recursive(
    VALUES | ANY_JSON,
    lambda children: (
        st.lists(children, max_size=3)
        | st.dictionaries(st.sampled_from(NAMES), children, max_size=4)
    ),
    max_leaves=10,
)


@settings(max_examples=some(60))
@given(st.lists(st.dictionaries(st.sampled_from(NAMES), TREES, max_size=6), max_size=3))
def test_no_value_of_whatever_kind_stops_it(replies):
    model = M408Model()
    for reply in replies:
        model.take(reply)
    result = model.take(status(temps={"current": [20.5]}, time=5))
    assert result["state"]["status"] == "idle"
    assert result["heat"]["heaters"][0]["current"] == 20.5


FIELDS = [
    (form, row.field)
    for form, rows in (("heaters", LEGACY), ("status", STATUS_FIELDS), ("axisMins", CONFIG_FIELDS))
    for row in rows
]
ODD = [
    None,
    True,
    -1,
    2.5,
    10**400,
    "",
    "x",
    [],
    [None],
    [[]],
    ["x"],
    {},
    {"a": 1},
    [{}],
    [{"a": 1}],
]


@pytest.mark.parametrize(("form", "field"), FIELDS)
def test_member_of_an_odd_kind_is_harmless(form, field):
    path = field.replace("[]", "").partition("[")[0]
    for odd in ODD:
        reply = {form: [] if form != "status" else "I"}
        if form == "heaters":
            reply[path] = odd
        else:
            *parents, last = path.split(".")
            place = reply
            for name in parents:
                place = place.setdefault(name, {})
            place[last] = odd
        model = M408Model()
        model.take(reply)
        assert model.take(status())["state"]["status"] == "idle"


PRINTED = {"filePosition": 500, "printDuration": 12, "timesLeft": {"file": 30}, "currentLayer": 3}


@pytest.mark.parametrize("letter, stays", [("P", True), ("S", True), ("B", True), ("I", False)])
def test_members_of_a_job_end_with_it(letter, stays):
    model = taken(status(status="P", **PRINTED), status(status=letter))
    job = model.get("job", {})
    assert (job.get("filePosition"), job.get("duration")) == ((500, 12) if stays else (None, None))
    assert (job.get("timesLeft", {}).get("file") == 30) is stays
