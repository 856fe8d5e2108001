"""Whatever somebody sends: no exception, and no line that means something else than it should."""

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.gcode.commands import COMMANDS, Refusal, Situation, translate
from octoprint_rrfmodel.rrf.views.machine import Machine

from ..commanded import FREE, VERSIONS, on, with_members
from ..strategies import ANY_JSON
from .test_commands_forbidden import VALID
from .test_commands_lines import TABLE, box

NAMES = sorted({command.name for command in COMMANDS})
PARAMETERS = sorted({row.name for command in COMMANDS for row in command.parameters})

QUOTED = re.compile(r'"(?:[^"]|"")*"')
WORD = re.compile(r"'?[A-Za-z]|[-+]?[0-9]*\.?[0-9]+|[{}:]|\s+")
"""What a line consists of besides texts in quotes."""
SET = re.compile(r"set global\.[A-Za-z_]\w* = (true$|false$)?", re.ASCII)
"""What the line that sets a variable has in front of its value."""

LETTERS = st.text("XYZUABCabcde'\"{};\n\r\t\x00 /:.,%()ø\u2028", max_size=140) | st.text()
SMALL = st.integers(-2, 45) | st.floats(-300, 3000) | st.sampled_from([0, 1, 10**400, 1e308])
WORDS = st.sampled_from(
    [
        *("ok", "cancel", "resume", "start", "pause", "simulate", "load", "unload", "clear"),
        *("mzv", "measure", "set_z", "go", "save", "material"),
        *("probe", "off", "standby", "active", "X", "Z", "a", "heat", '0:/macros/it\'s "x".g'),
    ]
)
VALUES = st.one_of(
    WORDS,
    SMALL,
    LETTERS,
    st.booleans(),
    st.lists(SMALL | WORDS, max_size=4),
    st.dictionaries(WORDS | LETTERS, SMALL, max_size=4),
    ANY_JSON,
)
GIVEN = st.dictionaries(st.sampled_from(PARAMETERS), VALUES, max_size=5)

MEMBERS = [
    "boards",
    "boards[0].firmwareVersion",
    "fans",
    "fans[0]",
    "heat",
    "heat.bedHeaters",
    "heat.bedHeaters[0]",
    "heat.heaters",
    "heat.heaters[1]",
    "heat.heaters[1].max",
    "heat.heaters[1].active",
    "heat.coldExtrudeTemperature",
    "job.build",
    "boards[0]",
    "global",
    "ledStrips",
    "limits.trackedObjects",
    "move",
    "move.axes",
    "move.axes[0]",
    "move.axes[0].letter",
    "move.axes[0].max",
    "move.extruders",
    "move.extruders[0]",
    "state",
    "state.currentTool",
    "state.messageBox",
    "state.status",
    "sensors.probes",
    "state.gpOut",
    "tools",
    "tools[0]",
    "tools[0].number",
    "tools[0].heaters",
    "tools[0].extruders",
    "tools[0].filamentExtruder",
]


def spoilt(members):
    """Return a model with members that no firmware tells."""
    model = on().model
    # the deepest first: what is above may be gone afterwards
    for path in sorted(members, key=len, reverse=True):
        model = with_members(model, {path: members[path]})
    return model


MACHINES = st.one_of(
    st.builds(
        lambda kind, firmware, mode: on(
            kind, firmware, **box(mode, min=1, max=200, choices=["a", "b"], cancelButton=True)
        ),
        st.sampled_from(["cartesian", "idex", "toolchanger", "corexy"]),
        st.sampled_from(VERSIONS[1:]),
        st.integers(0, 8),
    ),
    st.dictionaries(st.sampled_from(MEMBERS), ANY_JSON | SMALL, max_size=4).map(
        lambda members: Machine(spoilt(members))
    ),
)
SITUATIONS = st.builds(Situation, *[st.booleans()] * 5) | st.just(FREE)


def assert_harmless(line):
    """The firmware reads the line as one line, and nothing in its texts as anything but text."""
    assert line.isprintable() or not re.search(r"[\x00-\x1f\x7f-\x9f\u2028\u2029]", line)
    assert ";" not in line
    assert len(line.encode("utf-8")) <= 255
    bare = SET.sub("", QUOTED.sub("", line))
    assert '"' not in bare
    assert WORD.sub("", bare) == "", bare
    assert not re.search(r"\d[eE][-+]?\d", bare)
    for text in QUOTED.findall(line):
        # an apostrophe alone would make the next letter lower case
        assert text.count("'") % 2 == 0 and "'" not in text.replace("''", "")


@given(st.sampled_from(NAMES), GIVEN, MACHINES, SITUATIONS)
def test_any_parameters(name, given_, machine, situation):
    outcome = translate(name, given_, machine, situation)
    if isinstance(outcome, Refusal):
        assert outcome.status in (400, 404, 409)
        for value in outcome.values.values():
            assert isinstance(value, str) and value.isprintable()
        return
    for line in outcome.lines:
        assert_harmless(line)


@given(st.sampled_from(NAMES), GIVEN)
def test_parameters_of_a_command_alone(name, given_):
    """As above, but only with names that the command has: more of them get through."""
    (command,) = (command for command in COMMANDS if command.name == name)
    known = {row.name for row in command.parameters}
    outcome = translate(
        name, {key: value for key, value in given_.items() if key in known}, on(), FREE
    )
    for line in getattr(outcome, "lines", ()):
        assert_harmless(line)


@given(st.text() | ANY_JSON, st.dictionaries(st.text(), ANY_JSON, max_size=3))
def test_any_name(name, given_):
    outcome = translate(name, given_, on(), FREE)
    assert isinstance(outcome, Refusal) or name in NAMES


@given(LETTERS)
def test_any_path(path):
    outcome = translate("macro", {"path": path}, on(), FREE)
    for line in getattr(outcome, "lines", ()):
        assert_harmless(line)
        assert line.startswith('M98 P"')


@given(LETTERS)
def test_any_answer(text):
    machine = on(**box(7, min=0, max=1000))
    outcome = translate("message_box", {"action": "ok", "value": text}, machine, FREE)
    for line in getattr(outcome, "lines", ()):
        assert_harmless(line)
        assert line.startswith('M292 P0 R{"') and line.endswith('"} S7')


ODD = [None, True, -1, 5, 1.5, 1e300, "x", [], {}, [None], ["x"], [[1]], [-1, 99], [{}], {"x": 1}]


@pytest.mark.parametrize("member", MEMBERS)
def test_any_model(member):
    """A model that is wrong in one place: whoever commands is told, or the firmware decides."""
    for value in ODD:
        machine = Machine(spoilt({member: value}))
        for name, parameters in VALID.items():
            outcome = translate(name, parameters, machine, FREE)
            for line in getattr(outcome, "lines", ()):
                assert_harmless(line)


def test_the_check_finds_nothing_in_lines_that_are_well():
    for *_, lines in TABLE:
        for line in lines:
            assert_harmless(line)
