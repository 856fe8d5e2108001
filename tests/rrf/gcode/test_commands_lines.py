"""What goes out for each command, by firmware."""

import pytest

from octoprint_rrfmodel.rrf.gcode.commands import COMMANDS, translate
from octoprint_rrfmodel.rrf.gcode.operations import Lines
from octoprint_rrfmodel.rrf.views.machine import Machine
from octoprint_rrfmodel.rrf.views.told_box import FIRST_NUMBER
from tests.support.places import ROOT

from ..commanded import FREE, VERSIONS, go, on
from . import setup_cases

OLD = ("2.05",)
FROM_33 = VERSIONS[1:]
FROM_35 = VERSIONS[3:]
TO_34 = VERSIONS[:3]
CHANGER = "toolchanger"

BOX = {"axisControls": 0, "cancelButton": False, "message": "m", "timeout": 0, "title": "t"}


def box(mode, **members):
    return {"state.messageBox": {**BOX, "mode": mode, "seq": 7, **members}}


PRINTING = {"state.status": "processing"}
OBJECTS = {"job.build": {"objects": [{"name": "a"}, {"name": "b"}]}}
CNC = {"state.machineMode": "CNC"}
LOADED = {"move.extruders[0].filament": "PLA"}

TABLE = [
    # name, parameters, kind of machine, versions, members, lines
    ("refresh", {}, "cartesian", VERSIONS, {}, []),
    ("refresh", {"key": "move.axes[0].homed"}, "cartesian", VERSIONS, {}, []),
    ("recover", {}, "cartesian", VERSIONS, {}, []),
    ("emergency_stop", {}, "cartesian", VERSIONS, {}, ["M112"]),
    ("emergency_stop", {}, "cartesian", VERSIONS, PRINTING, ["M112"]),
    ("tool_temperatures", {"tool": 0, "active": 205}, "cartesian", OLD, {}, ["G10 P0 S205"]),
    ("tool_temperatures", {"tool": 0, "active": 205}, "cartesian", FROM_33, {}, ["M568 P0 S205"]),
    (
        "tool_temperatures",
        {"tool": 10, "active": 205.5, "standby": 0},
        CHANGER,
        FROM_33,
        {},
        ["M568 P10 S205.5 R0"],
    ),
    ("tool_temperatures", {"tool": 2, "active": 200}, "idex", FROM_33, {}, ["M568 P2 S200:200"]),
    (
        "tool_temperatures",
        {"tool": 2, "active": [200, 210], "standby": [90, 95.5]},
        "idex",
        FROM_33,
        {},
        ["M568 P2 S200:210 R90:95.5"],
    ),
    ("tool_state", {"tool": 0, "state": "off"}, "cartesian", FROM_33, {}, ["M568 P0 A0"]),
    ("tool_state", {"tool": 0, "state": "standby"}, "cartesian", FROM_33, {}, ["M568 P0 A1"]),
    ("tool_state", {"tool": 0, "state": "active"}, "cartesian", FROM_33, {}, ["M568 P0 A2"]),
    (
        "tool_state",
        {"tool": 0, "state": "off"},
        "cartesian",
        OLD,
        {},
        ["G10 P0 S-273.15 R-273.15"],
    ),
    ("select_tool", {"tool": 10}, CHANGER, VERSIONS, {}, ["T10"]),
    ("select_tool", {"tool": -1}, CHANGER, VERSIONS, {}, ["T-1"]),
    ("bed", {"active": 60}, "cartesian", VERSIONS, {}, ["M140 P0 S60"]),
    ("bed", {"index": 1, "standby": 40.5}, "idex", FROM_33, {}, ["M140 P1 R40.5"]),
    (
        "bed",
        {"active": 60, "standby": 40, "state": "standby"},
        "cartesian",
        VERSIONS,
        {},
        ["M140 P0 S60 R40", "M144 P0"],
    ),
    ("bed", {"index": 1, "state": "active"}, "idex", FROM_33, {}, ["M144 P1 S1"]),
    ("bed", {"state": "off"}, "cartesian", OLD, {}, ["M120 M140 P0 S-273.15 M121"]),
    ("bed", {"state": "off"}, "cartesian", FROM_33, {}, ["M140 P0 S{-273.15}"]),
    ("chamber", {"active": 50}, "corexy", FROM_33, {}, ["M141 P0 S50"]),
    (
        "chamber",
        {"active": 50, "standby": 30, "state": "active"},
        "corexy",
        FROM_33,
        {},
        ["M141 P0 S50 R30"],
    ),
    (
        "chamber",
        {"standby": 30, "state": "active"},
        "corexy",
        FROM_33,
        {"heat.heaters[2].active": 45.5},
        ["M141 P0 R30", "M141 P0 S45.5"],
    ),
    ("chamber", {"state": "off"}, "corexy", FROM_33, {}, ["M141 P0 S{-273.15}"]),
    ("reset_heater_fault", {"heater": 1}, "cartesian", VERSIONS, {}, ["M562 P1"]),
    ("fan", {"fan": 0, "speed": 0.5}, "cartesian", VERSIONS, {}, ["M106 P0 S0.5"]),
    ("fan", {"fan": 1, "speed": 1}, "cartesian", VERSIONS, {}, ["M106 P1 S1"]),
    ("fan", {"fan": 1, "speed": 0}, "cartesian", VERSIONS, {}, ["M106 P1 S0"]),
    ("home", {}, "cartesian", VERSIONS, {}, ["G28"]),
    ("home", {"axes": []}, "cartesian", VERSIONS, {}, ["G28"]),
    ("home", {"axes": ["X", "Y", "X"]}, "cartesian", VERSIONS, {}, ["G28 X Y"]),
    ("home", {"axes": "ZX"}, "cartesian", VERSIONS, {}, ["G28 Z X"]),
    ("home", {"axes": ["A", "a"]}, "manyaxes", FROM_33, {}, ["G28 A 'a"]),
    (
        "jog",
        {"axes": {"X": 10, "Y": -0.5}, "speed": 6000},
        "cartesian",
        VERSIONS,
        {},
        ["M120 G21 G91 G1 X10 Y-0.5 F6000 M121"],
    ),
    (
        "jog",
        {"axes": {"Z": 5}, "absolute": True},
        "cartesian",
        VERSIONS,
        {},
        ["M120 G21 G90 G1 Z5 M121"],
    ),
    ("jog", {"axes": {"b": 1e-5}}, "manyaxes", FROM_33, {}, ["M120 G21 G91 G1 'b0.00001 M121"]),
    (
        "extrude",
        {"amounts": 5, "speed": 300},
        "cartesian",
        VERSIONS,
        {},
        ["M120 M83 G1 E5 F300 M121"],
    ),
    (
        "extrude",
        {"amounts": [1, -2.5], "speed": 300},
        "idex",
        FROM_33,
        {"state.currentTool": 2},
        ["M120 M83 G1 E1:-2.5 F300 M121"],
    ),
    ("babystep", {"amount": 0.02}, "cartesian", VERSIONS, {}, ["M290 Z0.02"]),
    ("babystep", {"axis": "c", "amount": -1}, "manyaxes", FROM_33, {}, ["M290 'c-1"]),
    (
        "babystep",
        {"amount": 1.5, "absolute": True},
        "cartesian",
        VERSIONS,
        {},
        ["M290 R0 Z1.5"],
    ),
    ("speed_factor", {"percent": 110}, "cartesian", VERSIONS, {}, ["M220 S110"]),
    (
        "extrusion_factor",
        {"extruder": 3, "percent": 95.5},
        CHANGER,
        VERSIONS,
        {},
        ["M221 D3 S95.5"],
    ),
    ("spindle", {"spindle": 0, "rpm": 12000.4}, "cnc", VERSIONS, CNC, ["M3 P0 S12000"]),
    (
        "spindle",
        {"spindle": 0, "rpm": 60, "direction": "reverse"},
        "cnc",
        FROM_33,
        {},
        ["M4 P0 S60"],
    ),
    ("spindle", {"spindle": 0, "rpm": 0}, "cnc", VERSIONS, CNC, ["M5 P0"]),
    (
        "spindle",
        {"spindle": 1, "rpm": 500},
        "cnc",
        FROM_33,
        {"spindles[1]": {"state": "stopped", "canReverse": False}},
        ["M3 P1 S500"],
    ),
    (
        "tool_offsets",
        {"tool": 10, "offsets": {"X": 0.25, "Z": -3}},
        CHANGER,
        VERSIONS,
        {},
        ["G10 P10 X0.25 Z-3"],
    ),
    ("tool_offsets", {"tool": 0, "offsets": {"a": 1}}, "manyaxes", FROM_33, {}, ["G10 P0 'a1"]),
    ("workplace", {"workplace": 1}, "cnc", VERSIONS, {}, ["G54"]),
    ("workplace", {"workplace": 6}, "cnc", VERSIONS, {}, ["G59"]),
    ("workplace", {"workplace": 9}, "cnc", VERSIONS, {}, ["G59.3"]),
    ("set_zero", {"axes": "XZ", "workplace": 2}, "cnc", VERSIONS, {}, ["G10 L20 P2 X0 Z0"]),
    ("set_zero", {"axes": ["a"], "workplace": 9}, "manyaxes", FROM_33, {}, ["G10 L20 P9 'a0"]),
    (
        "set_zero",
        {},
        "cnc",
        FROM_33,
        {"move.workplaceNumber": 4},
        ["G10 L20 P5 X0 Y0 Z0"],
    ),
    ("message_box", {"action": "ok"}, "cartesian", TO_34, box(2), ["M292 P0"]),
    ("message_box", {"action": "cancel", "seq": 7}, "cartesian", TO_34, box(3), ["M292 P1"]),
    ("message_box", {"action": "ok"}, "cartesian", FROM_35, box(1), ["M292 P0 S7"]),
    ("message_box", {"action": "ok", "seq": 7}, "cartesian", FROM_35, box(3), ["M292 P0 S7"]),
    ("message_box", {"action": "cancel"}, "cartesian", FROM_35, box(3), ["M292 P1 S7"]),
    ("message_box", {"action": "ok"}, "cartesian", FROM_35, box(2, seq=FIRST_NUMBER), ["M292 P0"]),
    (
        "message_box",
        {"action": "cancel"},
        "cartesian",
        FROM_35,
        box(4, choices=["a"], cancelButton=True),
        ["M292 P1 S7"],
    ),
    (
        "message_box",
        {"action": "ok", "value": 1},
        "cartesian",
        FROM_35,
        box(4, choices=["a", "b"]),
        ["M292 P0 R{1} S7"],
    ),
    (
        "message_box",
        {"action": "ok", "value": -3},
        "cartesian",
        FROM_35,
        box(5, min=-3, max=4),
        ["M292 P0 R{-3} S7"],
    ),
    (
        "message_box",
        {"action": "ok", "value": 2.5},
        "cartesian",
        FROM_35,
        box(6, min=None, max=2.5),
        ["M292 P0 R{2.5} S7"],
    ),
    (
        "message_box",
        {"action": "ok", "value": 'it\'s "ø"'},
        "cartesian",
        FROM_35,
        box(7, min=1, max=8),
        ['M292 P0 R{"it\'\'s ""ø"""} S7'],
    ),
    (
        "macro",
        {"path": "0:/macros/Say hello"},
        "cartesian",
        VERSIONS,
        {},
        ['M98 P"0:/macros/Say hello"'],
    ),
    (
        "macro",
        {"path": 'Prüf\'s "{x}".g'},
        "cartesian",
        VERSIONS,
        {},
        ['M98 P"Prüf\'\'s ""{x}"".g"'],
    ),
    ("object", {"index": 1, "action": "cancel"}, "cartesian", FROM_33, OBJECTS, ["M486 P1"]),
    ("object", {"index": 0, "action": "resume"}, "cartesian", FROM_33, OBJECTS, ["M486 U0"]),
    (
        "job",
        {"action": "start", "path": "Spare parts/clip.gcode"},
        "cartesian",
        VERSIONS,
        {},
        ['M32 "0:/gcodes/Spare parts/clip.gcode"'],
    ),
    ("job", {"action": "start", "path": "0:/x.g"}, "cartesian", VERSIONS, {}, ['M32 "0:/x.g"']),
    (
        "job",
        {"action": "simulate", "path": "/gcodes/a.gcode"},
        "cartesian",
        VERSIONS,
        {},
        ['M37 P"0:/gcodes/a.gcode"'],
    ),
    ("job", {"action": "pause"}, "cartesian", VERSIONS, PRINTING, ["M25"]),
    ("job", {"action": "resume"}, "cartesian", VERSIONS, {"state.status": "paused"}, ["M24"]),
    ("job", {"action": "cancel"}, "cartesian", VERSIONS, PRINTING, ["M25", "M0"]),
    ("job", {"action": "cancel"}, "cartesian", VERSIONS, {"state.status": "paused"}, ["M0"]),
    (
        "job",
        {"action": "cancel"},
        "cartesian",
        VERSIONS,
        {"state.status": "simulating"},
        ["M25", "M0"],
    ),
    (
        "filament",
        {"action": "load", "name": "PLA"},
        "cartesian",
        FROM_33,
        {},
        ['M701 S"PLA"', "M703"],
    ),
    (
        "filament",
        {"action": "load", "name": "PET G"},
        "cartesian",
        FROM_33,
        LOADED,
        ["M702", 'M701 S"PET G"', "M703"],
    ),
    # M408 tells of a filament too late
    (
        "filament",
        {"action": "load", "name": "PETG"},
        "cartesian",
        OLD,
        {},
        ["M702", 'M701 S"PETG"', "M703"],
    ),
    ("filament", {"action": "unload"}, "cartesian", VERSIONS, {}, ["M702"]),
    ("filament", {"action": "unload", "name": "PLA"}, "cartesian", FROM_33, LOADED, ["M702"]),
    ("mesh", {"action": "load"}, "cartesian", VERSIONS, {}, ["G29 S1"]),
    ("mesh", {"action": "clear"}, "cartesian", VERSIONS, {}, ["G29 S2"]),
    ("mesh", {"action": "probe"}, "cartesian", VERSIONS, {}, ["G29"]),
    ("mesh", {"action": "calibrate"}, "cartesian", VERSIONS, {}, ["G32"]),
    ("power", {"on": True}, "cartesian", VERSIONS, {}, ["M80"]),
    ("power", {"on": False}, "cartesian", VERSIONS, {}, ["M81"]),
    *setup_cases.LINES,
]


@pytest.mark.parametrize(
    "name, parameters, kind, firmware, members, lines",
    [
        pytest.param(
            name, parameters, kind, version, members, lines, id=f"{index}-{name}-{version}"
        )
        for index, (name, parameters, kind, versions, members, lines) in enumerate(TABLE)
        for version in versions
    ],
)
def test_lines(name, parameters, kind, firmware, members, lines):
    assert go(name, on(kind, firmware, **members), **parameters) == lines


def test_every_command_has_a_case():
    assert {case[0] for case in TABLE} == {command.name for command in COMMANDS}


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.name)
def test_every_command_has_a_case_for_every_firmware(command):
    covered = {version for case in TABLE if case[0] == command.name for version in case[3]}
    # M486 came with 3.1; 2.05 told of no chamber here
    missing = {"object": {"2.05"}, "chamber": {"2.05"}, **setup_cases.MISSING}.get(
        command.name, set()
    )
    assert covered == set(VERSIONS) - missing
    assert command.source


def test_left_out_is_as_null():
    machine = on()
    assert go("jog", machine, axes={"X": 1}, speed=None, absolute=None) == go(
        "jog", machine, axes={"X": 1}
    )


def test_what_nobody_knows_forbids_nothing():
    """Firmware that tells next to nothing: the numbers that some firmware could have pass."""
    machine = Machine({"state": {"status": "idle"}, "boards": [{"firmwareVersion": "2.05"}]})
    for name, parameters, lines in [
        ("tool_temperatures", {"tool": 3, "active": [200, 201]}, ["G10 P3 S200:201"]),
        ("tool_state", {"tool": 3, "state": "off"}, ["G10 P3 S-273.15 R-273.15"]),
        ("bed", {"index": 1, "active": 60}, ["M140 P1 S60"]),
        ("fan", {"fan": 5, "speed": 1}, ["M106 P5 S1"]),
        ("home", {"axes": "XU"}, ["G28 X U"]),
        ("extrude", {"amounts": [1, 2], "speed": 60}, ["M120 M83 G1 E1:2 F60 M121"]),
        ("select_tool", {"tool": 4}, ["T4"]),
    ]:
        assert translate(name, parameters, machine, FREE) == Lines(tuple(lines)), name


def test_news_that_are_old_leave_it_to_the_firmware():
    members = {"state.currentTool": -1, "state.status": "idle"}
    machine = on(is_current=False, **members)
    assert go("extrude", machine, amounts=1, speed=60) == ["M120 M83 G1 E1 F60 M121"]
    assert go("job", machine, action="cancel") == ["M25", "M0"]
    assert go("job", machine, action="resume") == ["M24"]
    unhomed = on(is_current=False, **{"move.axes[0].homed": False})
    assert go("jog", unhomed, axes={"X": 1}) == ["M120 G21 G91 G1 X1 M121"]
    assert go("jog", unhomed, axes={"X": 999}, absolute=True) == ["M120 G21 G90 G1 X999 M121"]
    assert go("filament", machine, action="unload") == ["M702"]
    assert go("filament", machine, action="load", name="A") == ["M702", 'M701 S"A"', "M703"]


def test_every_command_is_documented():
    text = (ROOT / "docs" / "commands.md").read_text(encoding="utf-8")
    first = [line.split("|")[1].strip() for line in text.splitlines() if line.startswith("| `")]
    names = [cell.strip("`") for cell in first if cell.startswith("`")]
    known = [command.name for command in COMMANDS]
    without_lines = {"refresh", "recover"}
    assert names == [*known, *(name for name in known if name not in without_lines)]


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.name)
def test_every_parameter_is_documented(command):
    text = (ROOT / "docs" / "commands.md").read_text(encoding="utf-8")
    (row, *_) = (line for line in text.splitlines() if line.startswith(f"| `{command.name}` |"))
    # a chamber is as a bed
    for parameter in command.parameters if command.name != "chamber" else ():
        assert f"`{parameter.name}`" in row
