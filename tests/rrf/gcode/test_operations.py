"""Operations by intent: what goes out for each, or why nothing does, by firmware."""

import pytest

from octoprint_rrfmodel.rrf.gcode import operations
from octoprint_rrfmodel.rrf.gcode.operations import Lines, Refused
from octoprint_rrfmodel.rrf.views.machine import Machine

from .machines import machine, tool

OLD = ("2.05",)
"""Without M568 and expressions."""

EXPRESSIONS = ("3.2",)
"""With expressions, without M568."""

CURRENT = ("3.3", "3.5.3", "3.6", "3.7")
SINCE_3 = EXPRESSIONS + CURRENT
BEFORE_M568 = OLD + EXPRESSIONS
ALL = OLD + SINCE_3

NOTHING_KNOWN = None
"""A model that tells the firmware alone."""

ONE = {"tools": [tool(0)], "current": 0}
COLD = {**ONE, "warm": False}
UNSELECTED = {"tools": [tool(0)]}
NO_TOOLS = {"tools": []}
MIXING = {"tools": [tool(1), tool(3, [2], [1, 2])], "current": 3}
CHANGER = {"tools": [None, tool(1), None, tool(3, [2])], "current": 1}
WITH_STANDBY = {"tools": [tool(0, standby=[140])], "current": 0}
TWO_HEATERS = {"tools": [tool(0, [1, 2], standby=[90, 95.5])], "current": 0}
SHARED = {"tools": [tool(0, [1]), tool(2, [1, 2])], "current": 0}
HEATERLESS = {"tools": [tool(0, [])], "current": 0}
UNHOMED = {**ONE, "homed": False}
UNHOMED_BEFORE = {**UNHOMED, "is_current": False}
HEATED = {**ONE, "bedHeaters": [-1, 0], "chamberHeaters": [5]}
UNHEATED = {**ONE, "bedHeaters": [-1], "chamberHeaters": []}


def one(line, heater="", target=0.0):
    return Lines((line,), heater, target)


CASES = [
    # intent, values, firmware, machine, what goes out
    (
        "jog",
        ({"X": 10, "Y": -0.5}, True, 6000),
        ALL,
        ONE,
        one("M120 G21 G91 G1 X10 Y-0.5 F6000 M121"),
    ),
    ("jog", ({"Z": 5}, False, None), ALL, ONE, one("M120 G21 G90 G1 Z5 M121")),
    ("jog", ({"A": 1, "a": 2}, True), ALL, ONE, one("M120 G21 G91 G1 A1 'a2 M121")),
    ("jog", ({"X": 1}, True), ALL, NOTHING_KNOWN, one("M120 G21 G91 G1 X1 M121")),
    ("jog", ({"Y": 1, "X": 1}, True), ALL, UNHOMED, Refused("not_homed", "YX")),
    ("jog", ({"X": 1}, True), ALL, UNHOMED_BEFORE, one("M120 G21 G91 G1 X1 M121")),
    ("home", (), ALL, ONE, one("G28")),
    ("home", ("XY",), ALL, UNHOMED, one("G28 X Y")),
    ("home", (["Z", "a"],), ALL, ONE, one("G28 Z 'a")),
    ("extrude", (5, 300), ALL, ONE, one("M120 M83 G1 E5 F300 M121")),
    ("extrude", (-2.5,), ALL, ONE, one("M120 M83 G1 E-2.5 M121")),
    ("extrude", (5, 300), ALL, NOTHING_KNOWN, one("M120 M83 G1 E5 F300 M121")),
    ("extrude", (5, 300), ALL, UNSELECTED, Refused("no_tool_selected")),
    ("extrude", (5, 300), ALL, NO_TOOLS, Refused("no_tool_selected")),
    ("extrude", (5, 300), ALL, COLD, Refused("too_cold", "0")),
    ("extrude", (-5, 300), ALL, COLD, Refused("too_cold", "0")),
    ("extrude", (5, 300), ALL, {**COLD, "is_current": False}, one("M120 M83 G1 E5 F300 M121")),
    (
        "extrude",
        (5, 300),
        ALL,
        {**UNSELECTED, "is_current": False},
        one("M120 M83 G1 E5 F300 M121"),
    ),
    # which tool it will be only the firmware knows
    ("heat_tool", (None, 205), ALL, {**CHANGER, "is_current": False}, one("M104 S205")),
    ("extrusion_factor", (95,), ALL, {**CHANGER, "is_current": False}, one("M221 S95")),
    ("extrusion_factor", (95,), ALL, {**UNSELECTED, "is_current": False}, one("M221 S95")),
    ("select", (3,), ALL, CHANGER, one("T3")),
    ("select", (3,), ALL, NOTHING_KNOWN, one("T3")),
    ("select", (2,), ALL, CHANGER, Refused("no_such_tool", "2")),
    ("select", (0,), ALL, NO_TOOLS, Refused("no_such_tool", "0")),
    ("heat_tool", (0, 205), CURRENT, ONE, one("M568 P0 S205 A2", "tool0", 205)),
    ("heat_tool", (None, 205.5), CURRENT, MIXING, one("M568 P3 S205.5 A2", "tool3", 205.5)),
    ("heat_tool", (None, 205), CURRENT, UNSELECTED, one("M568 P0 S205 A2", "tool0", 205)),
    ("heat_tool", (3, 0), CURRENT, CHANGER, one("M568 P3 S0 A0", "tool3")),
    ("heat_tool", (0, 205), CURRENT, TWO_HEATERS, one("M568 P0 S205:205 A2", "tool0", 205)),
    ("heat_tool", (0, 205), CURRENT, HEATERLESS, one("M568 P0 S205 A2", "tool0", 205)),
    ("heat_tool", (0, 0), CURRENT, SHARED, one("M568 P0 S0 A0", "tool0")),
    (
        "heat_tool",
        (0, 205),
        BEFORE_M568,
        WITH_STANDBY,
        Lines(("M104 T0 S205", "G10 P0 R140"), "tool0", 205),
    ),
    (
        "heat_tool",
        (None, 205),
        BEFORE_M568,
        TWO_HEATERS,
        Lines(("M104 T0 S205", "G10 P0 R90:95.5"), "tool0", 205),
    ),
    ("heat_tool", (3, 205), BEFORE_M568, CHANGER, one("M104 T3 S205", "tool3", 205)),
    ("heat_tool", (0, 0), BEFORE_M568, ONE, one("G10 P0 S-273.15 R-273.15", "tool0")),
    ("heat_tool", (2, 0), BEFORE_M568, SHARED, one("G10 P2 S0:-273.15 R0:-273.15", "tool2")),
    ("heat_tool", (1, 9), ALL, NOTHING_KNOWN, one("M104 S9 T1")),
    ("heat_tool", (None, 9), ALL, NOTHING_KNOWN, one("M104 S9")),
    ("heat_tool", (0, 205), ALL, CHANGER, Refused("no_such_tool", "0")),
    ("heat_tool", (None, 205), ALL, NO_TOOLS, Refused("no_such_tool")),
    ("heat_slot", ("bed", 60), ALL, HEATED, one("M140 P1 S60", "bed", 60)),
    ("heat_slot", ("bed", 0), SINCE_3, HEATED, one("M140 P1 S{-273.15}", "bed")),
    ("heat_slot", ("bed", 0), OLD, HEATED, one("M120 M140 P1 S-273.15 M121", "bed")),
    ("heat_slot", ("bed", 60), ALL, UNHEATED, Refused("no_bed")),
    ("heat_slot", ("chamber", 45.5), ALL, HEATED, one("M141 P0 S45.5", "chamber", 45.5)),
    ("heat_slot", ("chamber", 0), SINCE_3, HEATED, one("M141 P0 S{-273.15}", "chamber")),
    ("heat_slot", ("chamber", 0), OLD, HEATED, one("M120 M141 P0 S-273.15 M121", "chamber")),
    ("heat_slot", ("chamber", 50), ALL, UNHEATED, Refused("no_chamber")),
    ("speed_factor", (110,), ALL, NOTHING_KNOWN, one("M220 S110")),
    ("extrusion_factor", (95.5,), ALL, ONE, one("M221 D0 S95.5")),
    ("extrusion_factor", (95,), ALL, MIXING, Lines(("M221 D1 S95", "M221 D2 S95"))),
    ("extrusion_factor", (95,), ALL, UNSELECTED, Refused("no_tool_selected")),
    ("extrusion_factor", (95,), ALL, NOTHING_KNOWN, Refused("no_tool_selected")),
]

INTENTS = {
    "jog",
    "home",
    "extrude",
    "select",
    "heat_tool",
    "heat_slot",
    "speed_factor",
    "extrusion_factor",
}


def on(version, members):
    if members is None:
        return Machine({"boards": [{"firmwareVersion": version}]})
    return machine(version, **members)


@pytest.mark.parametrize(
    "intent, values, version, members, wanted",
    [
        pytest.param(
            intent, values, version, members, wanted, id=f"{number}-{intent}-{version}-{values}"
        )
        for number, (intent, values, versions, members, wanted) in enumerate(CASES)
        for version in versions
    ],
)
def test_intent(intent, values, version, members, wanted):
    outcome = getattr(operations, intent)(on(version, members), *values)
    assert type(outcome) is type(wanted)
    assert outcome == wanted


def test_every_intent_has_a_case_for_each_firmware():
    tested = {(case[0], version) for case in CASES for version in case[2]}
    assert tested == {(intent, version) for intent in INTENTS for version in ALL}


def test_every_intent_is_known_here():
    public = {
        name
        for name, value in vars(operations).items()
        if getattr(value, "__module__", "") == operations.__name__
        and not isinstance(value, type)
        and callable(value)
        and not name.startswith("_")
    }
    assert public == INTENTS
