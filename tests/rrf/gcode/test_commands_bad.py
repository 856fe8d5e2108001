"""What is malformed, or out of the range that the model gives: 400, and 404."""

import pytest

from octoprint_rrfmodel.rrf.gcode.commands import COMMANDS, Refusal

from ..commanded import go, on, refused
from . import setup_cases
from .test_commands_lines import box

IDEX = {"state.currentTool": 2}

TABLE = [
    # name, parameters, kind of machine, members, code
    ("nothing", {}, "cartesian", {}, "unknown_command"),
    ("power", {"on": True, "off": False}, "cartesian", {}, "unknown_parameter"),
    ("recover", {"now": True}, "cartesian", {}, "unknown_parameter"),
    ("emergency_stop", {"now": True}, "cartesian", {}, "unknown_parameter"),
    ("power", {}, "cartesian", {}, "missing_parameter"),
    ("power", {"on": None}, "cartesian", {}, "missing_parameter"),
    ("power", {"on": 1}, "cartesian", {}, "not_a_truth_value"),
    ("power", {"on": "true"}, "cartesian", {}, "not_a_truth_value"),
    # refresh
    ("refresh", {"key": 5}, "cartesian", {}, "not_a_text"),
    ("refresh", {"key": ""}, "cartesian", {}, "wrong_length"),
    ("refresh", {"key": "x" * 101}, "cartesian", {}, "wrong_length"),
    ("refresh", {"key": "heat\n"}, "cartesian", {}, "unsendable"),
    # tools
    ("tool_temperatures", {"tool": 9, "active": 200}, "cartesian", {}, "no_such_tool"),
    ("tool_temperatures", {"tool": 2, "active": 200}, "toolchanger", {}, "no_such_tool"),
    ("tool_temperatures", {"tool": 0, "active": 200}, "cnc", {}, "no_such_tool"),
    ("tool_temperatures", {"tool": -1, "active": 200}, "cartesian", {}, "no_such_tool"),
    ("tool_temperatures", {"tool": True, "active": 200}, "cartesian", {}, "not_whole"),
    ("tool_temperatures", {"tool": 0.0, "active": 200}, "cartesian", {}, "not_whole"),
    ("tool_temperatures", {"tool": "0", "active": 200}, "cartesian", {}, "not_whole"),
    ("tool_temperatures", {"tool": 10**30, "active": 200}, "cartesian", {}, "not_whole"),
    ("tool_temperatures", {"tool": 0}, "cartesian", {}, "nothing_to_do"),
    ("tool_temperatures", {"tool": 0, "active": 290}, "cartesian", {}, "temperature"),
    ("tool_temperatures", {"tool": 0, "active": -273.1}, "cartesian", {}, "temperature"),
    (
        "tool_temperatures",
        {"tool": 0, "standby": 4},
        "cartesian",
        {"heat.heaters[1].min": 5.0},
        "temperature",
    ),
    ("tool_temperatures", {"tool": 2, "active": [200, 300]}, "idex", {}, "temperature"),
    ("tool_temperatures", {"tool": 0, "standby": 1e300}, "cartesian", {}, "out_of_range"),
    ("tool_temperatures", {"tool": 0, "active": float("nan")}, "cartesian", {}, "out_of_range"),
    ("tool_temperatures", {"tool": 0, "active": float("inf")}, "cartesian", {}, "out_of_range"),
    ("tool_temperatures", {"tool": 0, "active": "200"}, "cartesian", {}, "not_a_number"),
    ("tool_temperatures", {"tool": 0, "active": True}, "cartesian", {}, "not_a_number"),
    ("tool_temperatures", {"tool": 0, "active": []}, "cartesian", {}, "not_a_number"),
    ("tool_temperatures", {"tool": 0, "active": [[1]]}, "cartesian", {}, "not_a_number"),
    ("tool_temperatures", {"tool": 0, "active": [200, 200]}, "cartesian", {}, "wrong_count"),
    ("tool_temperatures", {"tool": 2, "active": [200]}, "idex", {}, "wrong_count"),
    (
        "tool_temperatures",
        {"tool": 0, "active": 200},
        "cartesian",
        {"tools[0].heaters": []},
        "no_heater",
    ),
    ("tool_state", {"tool": 4, "state": "off"}, "cartesian", {}, "no_such_tool"),
    ("tool_state", {"tool": 0, "state": "on"}, "cartesian", {}, "wrong_word"),
    ("tool_state", {"tool": 0, "state": 2}, "cartesian", {}, "wrong_word"),
    ("tool_state", {"tool": 0, "state": ["off"]}, "cartesian", {}, "wrong_word"),
    ("tool_state", {"tool": 0, "state": "off"}, "cartesian", {"tools[0].heaters": []}, "no_heater"),
    ("select_tool", {"tool": 2}, "toolchanger", {}, "no_such_tool"),
    ("select_tool", {"tool": -2}, "toolchanger", {}, "no_such_tool"),
    # beds and chambers
    ("bed", {"index": 1, "active": 60}, "cartesian", {}, "no_such_bed"),
    ("bed", {"index": 0, "active": 60}, "cnc", {}, "no_such_bed"),
    ("bed", {"active": 60}, "cnc", {}, "no_such_bed"),
    ("bed", {"active": 125}, "cartesian", {}, "temperature"),
    ("bed", {"standby": 999}, "cartesian", {}, "temperature"),
    ("bed", {"active": [60]}, "cartesian", {}, "not_a_number"),
    ("bed", {}, "cartesian", {}, "nothing_to_do"),
    ("bed", {"state": "fault"}, "cartesian", {}, "wrong_word"),
    ("chamber", {"active": 30}, "cartesian", {}, "no_such_chamber"),
    ("chamber", {"active": 80.5}, "corexy", {}, "temperature"),
    ("chamber", {"state": "standby"}, "corexy", {}, "wrong_word"),
    ("reset_heater_fault", {"heater": 2}, "cartesian", {}, "no_such_heater"),
    ("reset_heater_fault", {"heater": 1}, "cartesian", {"heat.heaters[1]": None}, "no_such_heater"),
    ("reset_heater_fault", {"heater": -1}, "cartesian", {}, "no_such_heater"),
    # fans
    ("fan", {"fan": 7, "speed": 1}, "cartesian", {}, "no_such_fan"),
    ("fan", {"fan": 0, "speed": 1}, "cartesian", {"fans[0]": None}, "no_such_fan"),
    ("fan", {"fan": 0, "speed": 1}, "cnc", {}, "no_such_fan"),
    ("fan", {"fan": 0, "speed": 1.01}, "cartesian", {}, "out_of_range"),
    ("fan", {"fan": 0, "speed": -0.1}, "cartesian", {}, "out_of_range"),
    ("fan", {"fan": 0}, "cartesian", {}, "missing_parameter"),
    # axes
    ("home", {"axes": ["W"]}, "cartesian", {}, "no_such_axis"),
    ("home", {"axes": "x"}, "cartesian", {}, "no_such_axis"),
    ("home", {"axes": ["XY"]}, "cartesian", {}, "no_such_axis"),
    ("home", {"axes": "X\n"}, "cartesian", {}, "no_such_axis"),
    ("home", {"axes": 5}, "cartesian", {}, "not_letters"),
    ("home", {"axes": {"X": 1}}, "cartesian", {}, "not_letters"),
    ("home", {"axes": ["d"]}, "manyaxes", {}, "no_such_axis"),
    ("jog", {"axes": {}}, "cartesian", {}, "not_moves"),
    ("jog", {"axes": [1]}, "cartesian", {}, "not_moves"),
    ("jog", {"axes": {"E": 1}}, "cartesian", {}, "no_such_axis"),
    ("jog", {"axes": {"X": True}}, "cartesian", {}, "not_a_number"),
    ("jog", {"axes": {"X": 10_001}}, "cartesian", {}, "out_of_range"),
    ("jog", {"axes": {"X": 1}, "speed": 0}, "cartesian", {}, "out_of_range"),
    ("jog", {"axes": {"X": 1}, "speed": -600}, "cartesian", {}, "out_of_range"),
    ("jog", {"axes": {"X": 1}, "absolute": 1}, "cartesian", {}, "not_a_truth_value"),
    ("jog", {"axes": {"X": 236}, "absolute": True}, "cartesian", {}, "outside"),
    ("jog", {"axes": {"Z": -1}, "absolute": True}, "cartesian", {}, "outside"),
    (
        "jog",
        {"axes": {"X": 200}, "absolute": True},
        "cartesian",
        # a workplace that begins at 100 mm
        {"move.axes[0].machinePosition": 150.0, "move.axes[0].userPosition": 50.0},
        "outside",
    ),
    ("extrude", {"amounts": 5}, "cartesian", {}, "missing_parameter"),
    ("extrude", {"amounts": "5", "speed": 300}, "cartesian", {}, "not_a_number"),
    ("extrude", {"amounts": 10_001, "speed": 300}, "cartesian", {}, "out_of_range"),
    ("extrude", {"amounts": [1], "speed": 300}, "idex", IDEX, "wrong_count"),
    ("extrude", {"amounts": [1, 2], "speed": 300}, "cartesian", {}, "wrong_count"),
    ("babystep", {"amount": 1.001}, "cartesian", {}, "out_of_range"),
    ("babystep", {"amount": 10.5, "absolute": True}, "cartesian", {}, "out_of_range"),
    ("babystep", {"amount": 0.1, "axis": "z"}, "cartesian", {}, "no_such_axis"),
    ("babystep", {"axis": "Z"}, "cartesian", {}, "missing_parameter"),
    # factors
    ("speed_factor", {"percent": 0}, "cartesian", {}, "out_of_range"),
    ("speed_factor", {"percent": 1001}, "cartesian", {}, "out_of_range"),
    ("extrusion_factor", {"extruder": 1, "percent": 95}, "cartesian", {}, "no_such_extruder"),
    ("extrusion_factor", {"extruder": 0, "percent": 0}, "cartesian", {}, "out_of_range"),
    # spindles and tools
    ("spindle", {"spindle": 0, "rpm": 59}, "cnc", {}, "out_of_range"),
    ("spindle", {"spindle": 0, "rpm": 24_001}, "cnc", {}, "out_of_range"),
    ("spindle", {"spindle": 0, "rpm": -1}, "cnc", {}, "out_of_range"),
    ("spindle", {"spindle": 0, "rpm": "60"}, "cnc", {}, "not_a_number"),
    ("spindle", {"spindle": 0}, "cnc", {}, "missing_parameter"),
    # the others are unconfigured
    ("spindle", {"spindle": 1, "rpm": 100}, "cnc", {}, "no_such_spindle"),
    ("spindle", {"spindle": 0, "rpm": 100}, "cartesian", {}, "no_such_spindle"),
    ("spindle", {"spindle": 0, "rpm": 100, "direction": "back"}, "cnc", {}, "wrong_word"),
    (
        "spindle",
        {"spindle": 0, "rpm": 100, "direction": "reverse"},
        "cnc",
        {"spindles[0].canReverse": False},
        "cannot_reverse",
    ),
    ("tool_offsets", {"tool": 1, "offsets": {"X": 1}}, "cartesian", {}, "no_such_tool"),
    ("tool_offsets", {"tool": 0, "offsets": {"U": 1}}, "cartesian", {}, "no_such_axis"),
    ("tool_offsets", {"tool": 0, "offsets": {}}, "cartesian", {}, "not_moves"),
    ("tool_offsets", {"tool": 0, "offsets": {"X": 10_001}}, "cartesian", {}, "out_of_range"),
    ("tool_offsets", {"tool": 0, "offsets": {"X": "1"}}, "cartesian", {}, "not_a_number"),
    ("workplace", {"workplace": 0}, "cnc", {}, "out_of_range"),
    ("workplace", {"workplace": 10}, "cnc", {}, "out_of_range"),
    ("workplace", {"workplace": 1.0}, "cnc", {}, "not_whole"),
    ("workplace", {}, "cnc", {}, "missing_parameter"),
    ("set_zero", {"axes": "U", "workplace": 1}, "cnc", {}, "no_such_axis"),
    ("set_zero", {"axes": "X"}, "cnc", {"move.workplaceNumber": None}, "missing_parameter"),
    # message boxes
    ("message_box", {"action": "close"}, "cartesian", box(2), "wrong_word"),
    ("message_box", {"action": "ok", "seq": -1}, "cartesian", box(2), "out_of_range"),
    ("message_box", {"action": "ok", "seq": 1.0}, "cartesian", box(2), "not_whole"),
    ("message_box", {"action": "ok", "value": 1}, "cartesian", box(2), "box_takes_no_value"),
    (
        "message_box",
        {"action": "cancel", "value": 1},
        "cartesian",
        box(5, cancelButton=True),
        "box_takes_no_value",
    ),
    ("message_box", {"action": "cancel"}, "cartesian", box(2), "not_cancellable"),
    ("message_box", {"action": "cancel"}, "cartesian", box(7), "not_cancellable"),
    *(
        ("message_box", {"action": "ok"}, "cartesian", box(mode), "box_wants_value")
        for mode in (4, 5, 6, 7)
    ),
    *(
        ("message_box", {"action": "ok", "value": value}, "cartesian", members, code)
        for members, value, code in [
            (box(4, choices=["a", "b"]), 2, "out_of_range"),
            (box(4, choices=["a", "b"]), -1, "out_of_range"),
            (box(4, choices=["a", "b"]), 1.0, "not_whole"),
            (box(4, choices=["a", "b"]), "a", "not_whole"),
            (box(4, choices=["a", "b"]), True, "neither"),
            (box(5, min=0, max=10), 11, "out_of_range"),
            (box(5, min=0, max=10), -1, "out_of_range"),
            (box(5, min=None, max=None), 2**31, "out_of_range"),
            (box(5, min=0, max=10), 5.5, "not_whole"),
            (box(5, min=0, max=10), [5], "neither"),
            (box(6, min=0, max=1), 1.1, "out_of_range"),
            (box(6, min=None, max=None), float("nan"), "out_of_range"),
            (box(6, min=None, max=None), 10**40, "out_of_range"),
            (box(6, min=0, max=1), "0.5", "not_a_number"),
            (box(7, min=2, max=4), "a", "box_length"),
            (box(7, min=2, max=4), "abcde", "box_length"),
            (box(7, min=1, max=10), 5, "not_a_text"),
            (box(7, min=1, max=10), "a\nb", "unsendable"),
            (box(7, min=1, max=1000), "a" * 240, "line_too_long"),
        ]
    ),
    # files
    *(
        ("macro", {"path": path}, "cartesian", {}, code)
        for path, code in [
            ("", "wrong_length"),
            ("x" * 121, "wrong_length"),
            ("ø" * 61, "wrong_length"),
            ("0:/macros/", "not_a_file"),
            ("  ", "not_a_file"),
            ("a\nM112", "unsendable"),
            ("a\rM112", "unsendable"),
            ("a\x00", "unsendable"),
            ("a\x85", "unsendable"),
            ("a\u2028", "unsendable"),
            ("a\ud800", "unsendable"),
            ("a;b", "unsendable"),
            (5, "not_a_text"),
            (["a"], "not_a_text"),
        ]
    ),
    ("object", {"index": 40, "action": "cancel"}, "cartesian", {}, "out_of_range"),
    ("object", {"index": -1, "action": "cancel"}, "cartesian", {}, "out_of_range"),
    (
        "object",
        {"index": 2, "action": "cancel"},
        "cartesian",
        {"job.build": {"objects": [{}, {}]}},
        "no_such_object",
    ),
    ("object", {"index": 0, "action": "pause"}, "cartesian", {}, "wrong_word"),
    ("job", {"action": "restart"}, "cartesian", {}, "wrong_word"),
    ("job", {"action": "start"}, "cartesian", {}, "missing_parameter"),
    ("job", {"action": "simulate"}, "cartesian", {}, "missing_parameter"),
    ("job", {"action": "pause", "path": "a.gcode"}, "cartesian", {}, "needless"),
    ("job", {"action": "start", "path": "a" * 115}, "cartesian", {}, "wrong_length"),
    ("job", {"action": "start", "path": 'a"\n'}, "cartesian", {}, "unsendable"),
    ("filament", {"action": "load"}, "cartesian", {}, "missing_parameter"),
    ("filament", {"action": "load", "name": ""}, "cartesian", {}, "wrong_length"),
    ("filament", {"action": "load", "name": "x" * 32}, "cartesian", {}, "wrong_length"),
    ("filament", {"action": "load", "name": "PLA,PETG"}, "cartesian", {}, "filament_name"),
    ("filament", {"action": "load", "name": "../sys"}, "cartesian", {}, "filament_name"),
    ("filament", {"action": "change", "name": "PLA"}, "cartesian", {}, "wrong_word"),
    ("mesh", {"action": "save"}, "cartesian", {}, "wrong_word"),
    *setup_cases.BAD,
]


@pytest.mark.parametrize(
    "name, parameters, kind, members, code",
    TABLE,
    ids=[f"{index}-{case[0]}-{case[4]}" for index, case in enumerate(TABLE)],
)
def test_refused(name, parameters, kind, members, code):
    assert refused(name, on(kind, **members), **parameters) == (400, code)


def test_every_command_with_parameters_has_a_case():
    assert {case[0] for case in TABLE} >= {command.name for command in COMMANDS}


def test_a_key_that_does_not_exist():
    assert refused("refresh", on(), key="heating[0]") == (404, "no_such_key")


def test_old_firmware_has_one_limit_for_all_heaters():
    machine = on(firmware="2.05")
    assert refused("tool_temperatures", machine, tool=0, active=290) == (400, "temperature")
    assert go("bed", machine, active=200) == ["M140 P0 S200"]


def test_old_firmware_reads_shorter_lines():
    path = "0:/macros/" + "'\"" * 50
    assert go("macro", on(), path=path)[0].startswith('M98 P"0:/')
    assert refused("macro", on(firmware="3.3"), path=path) == (400, "line_too_long")


def test_malformed_is_told_before_the_state():
    halted = on(**{"state.status": "halted"})
    assert refused("fan", halted, fan=9, speed=1) == (400, "no_such_fan")
    assert refused("tool_temperatures", halted, tool=0, active=999) == (400, "temperature")


def test_values_tell_the_limit():
    outcome = go("tool_temperatures", on(), tool=0, active=400)
    assert outcome == Refusal(
        400, "temperature", {"parameter": "active", "low": "-273", "high": "290"}
    )
    outcome = go("select_tool", on("toolchanger"), tool=2)
    assert outcome.values == {"value": "2", "known": "1, 3, 7, 10"}


def test_what_was_sent_is_told_shortly():
    outcome = go("home", on(), axes=["<b>\n\ud800" + "x" * 500])
    assert outcome.values["value"] == "<b>??" + "x" * 35


@pytest.mark.parametrize(
    "members",
    [
        {"move.limitAxes": False},
        {"move.axes[0].homed": False, "move.noMovesBeforeHoming": False},
        {"move.axes[0].max": None},
    ],
    ids=["no limits", "not homed", "unknown"],
)
def test_a_place_is_checked_only_where_there_are_limits(members):
    lines = go("jog", on(**members), axes={"X": 999}, absolute=True)
    assert lines == ["M120 G21 G90 G1 X999 M121"]
