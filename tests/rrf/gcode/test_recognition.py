"""Operations in a host's G-code, row by row, for machines and firmware that differ."""

import pytest

from octoprint_rrfmodel.rrf.gcode.operations import Lines, Refused
from octoprint_rrfmodel.rrf.gcode.recognition import ROWS, Memory, is_on, row_for, translate
from octoprint_rrfmodel.rrf.views.machine import Machine
from tests.support.places import ROOT

from .machines import machine, tool


def go(operation, command, on, memory=None):
    gcode = command.split()[0] if command[0] != "T" else "T"
    return translate(row_for(operation, gcode), command, on, memory or Memory())


ONE = machine(tools=[tool(0)], current=0)
CHANGER = machine(tools=[None, tool(1), None, tool(3, [2]), tool(7, [3]), tool(10, [4])])
ON_THREE = machine(tools=[tool(1), tool(3, [2], [1, 2])], current=3)
BARE = machine(tools=[], bedHeaters=[-1], chamberHeaters=[])
OLD = machine("2.05.1", tools=[tool(0, standby=[140])], current=0)
OLD_CHANGER = machine("2.05.1", tools=[tool(1), tool(3, [2])], current=1)
UNKNOWN = Machine({})

TABLE = [
    # row, operation, command, machine, what goes out
    ("jog", "jog", "G0 X10 Y-5 Z0.02 F200", ONE, "M120 G21 G90 G1 X10 Y-5 Z0.02 F200 M121"),
    ("jog", "jog", "G0 X10", ONE, "M120 G21 G90 G1 X10 M121"),
    ("jog", "jog", "G0 X1", machine(homed=False), Refused("not_homed", "X")),
    (
        "jog",
        "jog",
        "G0 X1",
        machine(homed=False, is_current=False),
        "M120 G21 G90 G1 X1 M121",
    ),
    ("jog", "jog", "G0 X1", UNKNOWN, "M120 G21 G90 G1 X1 M121"),
    ("jog_mode", "jog", "G91", ONE, None),
    ("jog_mode", "jog", "G90", ONE, None),
    ("home", "home", "G28 X0 Y0", ONE, "G28 X Y"),
    ("home_mode", "home", "G91", ONE, None),
    ("home_mode", "home", "G90", ONE, None),
    ("extrude", "extrude", "G1 E5 F300", ONE, "M120 M83 G1 E5 F300 M121"),
    ("extrude", "extrude", "G1 E-2.5 F300", ONE, "M120 M83 G1 E-2.5 F300 M121"),
    ("extrude", "extrude", "G1 E5 F300", CHANGER, Refused("no_tool_selected")),
    ("extrude", "extrude", "G1 E5 F300", BARE, Refused("no_tool_selected")),
    (
        "extrude",
        "extrude",
        "G1 E5 F300",
        machine(tools=[tool(0)], current=0, warm=False),
        Refused("too_cold", "0"),
    ),
    ("extrude", "extrude", "G1 E5 F300", UNKNOWN, "M120 M83 G1 E5 F300 M121"),
    ("extrude_mode", "extrude", "G91", ONE, None),
    ("extrude_mode", "extrude", "M83", ONE, None),
    ("extrude_mode", "extrude", "M82", ONE, None),
    ("extrude_mode", "extrude", "G90", ONE, None),
    ("tool_select", "change_tool", "T10", CHANGER, "T10"),
    ("tool_select", "change_tool", "T2", CHANGER, Refused("no_such_tool", "2")),
    ("tool_select", "change_tool", "T0", BARE, Refused("no_such_tool", "0")),
    ("tool_select", "change_tool", "T2", UNKNOWN, "T2"),
    ("tool_target", "set_temperature", "M104 S205", ONE, "M568 P0 S205 A2"),
    ("tool_target", "set_temperature", "M104 T3 S205.5", CHANGER, "M568 P3 S205.5 A2"),
    ("tool_target", "set_temperature", "M104 S205", CHANGER, "M568 P1 S205 A2"),
    ("tool_target", "set_temperature", "M104 S205", ON_THREE, "M568 P3 S205 A2"),
    ("tool_target", "set_temperature", "M104 T3 S0", CHANGER, "M568 P3 S0 A0"),
    ("tool_target", "set_temperature", "M104 T0 S9", CHANGER, Refused("no_such_tool", "0")),
    ("tool_target", "set_temperature", "M104 S205", BARE, Refused("no_such_tool", "")),
    (
        "tool_target",
        "set_temperature",
        "M104 S205",
        machine(tools=[tool(0, [1, 2], standby=[0, 0])], current=0),
        "M568 P0 S205:205 A2",
    ),
    ("tool_target", "set_temperature", "M104 S205", OLD, ["M104 T0 S205", "G10 P0 R140"]),
    ("tool_target", "set_temperature", "M104 S0", OLD, "G10 P0 S-273.15 R-273.15"),
    ("tool_target", "set_temperature", "M104 T3 S205", OLD_CHANGER, "M104 T3 S205"),
    (
        "tool_target",
        "set_temperature",
        "M104 T2 S0",
        machine("2.05.1", tools=[tool(0, [1]), tool(1, [2]), tool(2, [1, 2])], current=0),
        "G10 P2 S0:-273.15 R0:-273.15",
    ),
    ("tool_target", "set_temperature", "M104 S205", machine("3.3", [tool(0)]), "M568 P0 S205 A2"),
    ("tool_target", "set_temperature", "M104 T1 S9", UNKNOWN, "M104 S9 T1"),
    ("bed_target", "set_temperature", "M140 S60", ONE, "M140 P1 S60"),
    ("bed_target", "set_temperature", "M140 S0", ONE, "M140 P1 S{-273.15}"),
    ("bed_target", "set_temperature", "M140 S0", OLD, "M120 M140 P1 S-273.15 M121"),
    ("bed_target", "set_temperature", "M140 S60", BARE, Refused("no_bed")),
    ("chamber_target", "set_temperature", "M141 S50", ONE, "M141 P0 S50"),
    ("chamber_target", "set_temperature", "M141 S0", ONE, "M141 P0 S{-273.15}"),
    ("chamber_target", "set_temperature", "M141 S50", BARE, Refused("no_chamber")),
    ("flow_rate", "flow_rate", "M221 S95", ONE, "M221 D0 S95"),
    ("flow_rate", "flow_rate", "M221 S95", ON_THREE, ["M221 D1 S95", "M221 D2 S95"]),
    ("flow_rate", "flow_rate", "M221 S95", CHANGER, Refused("no_tool_selected")),
]


@pytest.mark.parametrize(
    "row, operation, command, on, wanted",
    TABLE,
    ids=[f"{number}-{case[0]}-{case[2]}" for number, case in enumerate(TABLE)],
)
def test_command_of_an_operation(row, operation, command, on, wanted):
    gcode = command.split()[0] if command[0] != "T" else "T"
    assert row_for(operation, gcode).name == row
    outcome = go(operation, command, on)
    if isinstance(wanted, Refused):
        assert outcome == wanted
    else:
        lines = [] if wanted is None else [wanted] if isinstance(wanted, str) else wanted
        assert outcome.lines == tuple(lines)


def test_every_row_has_a_case():
    assert {case[0] for case in TABLE} == {row.name for row in ROWS}


def test_a_jog_goes_as_its_mode_says():
    memory = Memory()
    assert go("jog", "G91", ONE, memory) == Lines()
    assert go("jog", "G0 X1", ONE, memory).lines == ("M120 G21 G91 G1 X1 M121",)
    assert go("jog", "G90", ONE, memory) == Lines()
    assert go("jog", "G0 X1", ONE, memory).lines == ("M120 G21 G90 G1 X1 M121",)


@pytest.mark.parametrize(
    "command, heater_name, target",
    [
        ("M104 T3 S205", "tool3", 205),
        ("M104 T3 S0", "tool3", 0),
        ("M140 S60", "bed", 60),
        ("M140 S0", "bed", 0),
        ("M141 S0", "chamber", 0),
    ],
)
def test_a_target_is_told_where_the_host_can_not_read_it(command, heater_name, target):
    outcome = go("set_temperature", command, CHANGER)
    assert (outcome.heater, outcome.target) == (heater_name, target)


@pytest.mark.parametrize(
    "operation, gcode",
    [("jog", "M104"), ("feed_rate", "M220"), ("commands", "G0"), ("", "G0"), ("home", "G92")],
)
def test_what_is_in_no_row_goes_out_as_it_is(operation, gcode):
    assert row_for(operation, gcode) is None


@pytest.mark.parametrize(
    "text, version",
    [
        ("3.5.3", (3, 5, 3)),
        ("3.6.0-beta.1+2", (3, 6, 0)),
        ("2.05.1", (2, 5, 1)),
        ("3.3", (3, 3, 0)),
        ("", (0, 0, 0)),
    ],
)
def test_version_is_read_from_its_text(text, version):
    assert machine(text).version == version


def test_every_row_is_documented():
    text = (ROOT / "docs" / "operations.md").read_text(encoding="utf-8")
    table = text.partition("\n## ")[0]
    rows = [line.split("|")[1].strip(" `") for line in table.splitlines() if line.startswith("| `")]
    assert rows == [row.name for row in ROWS]


@pytest.mark.parametrize("row", [row for row in ROWS if row.only_with], ids=lambda row: row.name)
def test_mode_only_vanishes_with_the_command_that_it_is_for(row):
    needed = next(other for other in ROWS if other.name == row.only_with)
    assert needed.operation == row.operation
    assert is_on(row, lambda name: True)
    assert not is_on(row, lambda name: name != row.name)
    assert not is_on(row, lambda name: name != row.only_with)
    assert is_on(needed, lambda name: name != row.name)
