"""What the printer's state forbids: 409, row by row of the public contract."""

import pytest

from octoprint_rrfmodel.rrf.gcode.commands import COMMANDS, Situation
from octoprint_rrfmodel.rrf.views.machine import Machine

from ..commanded import FREE, go, on, refused
from . import setup_cases
from .test_commands_lines import BOX, box

VALID = {
    "refresh": {},
    "tool_temperatures": {"tool": 0, "active": 200},
    "tool_state": {"tool": 0, "state": "active"},
    "select_tool": {"tool": 0},
    "bed": {"active": 60},
    "chamber": {"state": "active"},
    "reset_heater_fault": {"heater": 1},
    "fan": {"fan": 0, "speed": 1},
    "home": {},
    "jog": {"axes": {"X": 1}},
    "extrude": {"amounts": 1, "speed": 300},
    "babystep": {"amount": 0.1},
    "speed_factor": {"percent": 100},
    "extrusion_factor": {"extruder": 0, "percent": 100},
    "spindle": {"spindle": 0, "rpm": 1000},
    "tool_offsets": {"tool": 0, "offsets": {"X": 1}},
    "workplace": {"workplace": 2},
    "set_zero": {"axes": "X", "workplace": 2},
    "message_box": {"action": "ok"},
    "macro": {"path": "a.g"},
    "object": {"index": 0, "action": "cancel"},
    "job": {"action": "start", "path": "a.gcode"},
    "filament": {"action": "load", "name": "PLA"},
    "mesh": {"action": "probe"},
    "power": {"on": False},
    "emergency_stop": {},
    "recover": {},
    **setup_cases.VALID,
}

STREAMS = FREE._replace(octoprint_prints=True)
STREAM_PAUSED = STREAMS._replace(octoprint_is_paused=True)

NOT_WHILE_PRINTING = {
    "home",
    "jog",
    "extrude",
    "select_tool",
    "macro",
    "filament",
    "mesh",
    "job",
    "power",
    "recover",
    "spindle",
    "tool_offsets",
    "workplace",
    "set_zero",
    *setup_cases.NOT_WHILE_PRINTING,
}
WHILE_PAUSED = {
    "spindle",
    "tool_offsets",
    "workplace",
    "set_zero",
    "jog",
    "extrude",
    "select_tool",
    "filament",
    "recover",
    *setup_cases.WHILE_PAUSED,
}


def always_ready(**members):
    """Return a machine on which each command of ``VALID`` goes."""
    ready = {
        **box(2),
        "job.build": {"objects": [{}]},
        "heat.chamberHeaters": [0],
        "state.machineMode": "CNC",
        "spindles[0].state": "stopped",
    }
    return on(**{**ready, **members})


def codes(machine, situation):
    """Return the code of each valid command that is refused with 409."""
    found = {}
    for name, parameters in VALID.items():
        outcome = go(name, machine, situation, **parameters)
        if not isinstance(outcome, list):
            assert outcome.status == 409, (name, outcome)
            found[name] = outcome.code
    return found


def test_every_command_is_here():
    assert set(VALID) == {command.name for command in COMMANDS}
    assert codes(always_ready(), FREE) == {}


ALL_BUT = set(VALID) - {"refresh", "recover"}


@pytest.mark.parametrize(
    "machine, situation, code",
    [
        pytest.param({}, FREE._replace(is_connected=False), "not_connected", id="not connected"),
        pytest.param({}, FREE._replace(is_rrf=False), "not_rrf", id="not RRF"),
        pytest.param({}, FREE, "no_model", id="no model"),
        pytest.param({"state": {"status": "halted"}}, FREE, "halted", id="halted"),
    ],
)
def test_without_a_machine_hardly_anything_goes(machine, situation, code):
    # whatever is known of the machine, it can be stopped
    goes = {"emergency_stop"} if code in ("no_model", "halted") else set()
    assert codes(Machine(machine), situation) == dict.fromkeys(ALL_BUT - goes, code)


def test_a_connection_that_is_gone_counts_first():
    gone = Situation(False, False, False, False, False)
    assert codes(Machine({}), gone) == dict.fromkeys(ALL_BUT, "not_connected")


PRINTS = [
    pytest.param({}, STREAMS, id="streamed"),
    *(
        pytest.param({"state.status": status}, FREE, id=status)
        for status in ("processing", "simulating", "pausing", "resuming", "cancelling")
    ),
]


@pytest.mark.parametrize("members, situation", PRINTS)
def test_while_something_is_printed(members, situation):
    found = codes(always_ready(**members), situation)
    assert set(found) == NOT_WHILE_PRINTING
    assert set(found.values()) <= {"printing", "printing_or_paused", "streamed"}


@pytest.mark.parametrize(
    "members, situation",
    [
        pytest.param({}, STREAM_PAUSED, id="streamed"),
        pytest.param({"state.status": "paused"}, FREE, id="paused"),
    ],
)
def test_while_a_print_is_paused(members, situation):
    found = codes(always_ready(**members), situation)
    assert set(found) == NOT_WHILE_PRINTING - WHILE_PAUSED


@pytest.mark.parametrize("situation", [STREAMS, STREAM_PAUSED], ids=["going on", "paused"])
@pytest.mark.parametrize("action", ["start", "simulate", "pause", "resume", "cancel"])
def test_a_streamed_print_has_an_interface_of_its_own(situation, action):
    parameters = {"path": "a.gcode"} if action in ("start", "simulate") else {}
    assert refused("job", on(), situation, action=action, **parameters) == (409, "streamed")


def test_power_goes_on_at_any_time():
    assert go("power", on(), STREAMS, on=True) == ["M80"]


TABLE = [
    # name, parameters, members, situation, code
    ("jog", {"axes": {"X": 1, "Y": 1}}, {"move.axes[1].homed": False}, FREE, "not_homed"),
    ("extrude", {"amounts": 1, "speed": 60}, {"state.currentTool": -1}, FREE, "no_tool_selected"),
    ("extrude", {"amounts": 1, "speed": 60}, {"heat.heaters[1].current": 150}, FREE, "too_cold"),
    ("extrude", {"amounts": -1, "speed": 60}, {"heat.heaters[1].current": 80}, FREE, "too_cold"),
    (
        "filament",
        {"action": "unload"},
        {"state.currentTool": -1},
        FREE,
        "no_tool_selected",
    ),
    (
        "filament",
        {"action": "load", "name": "PLA"},
        {"tools[0].filamentExtruder": -1},
        FREE,
        "no_filament_drive",
    ),
    ("message_box", {"action": "ok"}, {}, FREE, "no_box"),
    ("message_box", {"action": "ok"}, {"state.messageBox": {**BOX, "mode": -1}}, FREE, "no_box"),
    ("message_box", {"action": "ok", "seq": 6}, box(2), FREE, "other_box"),
    (
        "message_box",
        {"action": "ok"},
        box(2),
        FREE._replace(answers_boxes=False),
        "unanswerable",
    ),
    ("message_box", {"action": "ok"}, {}, FREE._replace(answers_boxes=False), "unanswerable"),
    (
        "message_box",
        {"action": "ok"},
        box(2),
        FREE._replace(box_is_answered=True),
        "box_answered",
    ),
    ("object", {"index": 0, "action": "cancel"}, {}, FREE, "no_objects"),
    ("job", {"action": "pause"}, {}, FREE, "no_job"),
    ("job", {"action": "pause"}, {"state.status": "paused"}, FREE, "no_job"),
    ("job", {"action": "resume"}, {}, FREE, "not_paused"),
    ("job", {"action": "resume"}, {"state.status": "processing"}, FREE, "not_paused"),
    ("job", {"action": "cancel"}, {}, FREE, "no_job"),
    (
        "spindle",
        {"spindle": 0, "rpm": 100},
        {"spindles[0].state": "stopped"},
        FREE,
        "not_cnc",
    ),
    ("power", {"on": True}, {"state.atxPower": None}, FREE, "no_power_control"),
    (
        "restore_point",
        {"point": 0, "action": "go"},
        {"move.axes[2].homed": False},
        FREE,
        "not_homed",
    ),
    (
        "motor_current",
        {"extruder": 0, "milliamps": 800},
        {"move.extruders": [{}, {}]},
        FREE,
        "currents_unknown",
    ),
    (
        "chamber",
        {"state": "active"},
        {"heat.chamberHeaters": [0], "heat.heaters[0].active": None},
        FREE,
        "no_target",
    ),
]


@pytest.mark.parametrize(
    "name, parameters, members, situation, code",
    TABLE,
    ids=[f"{index}-{case[0]}-{case[4]}" for index, case in enumerate(TABLE)],
)
def test_forbidden(name, parameters, members, situation, code):
    assert refused(name, on(**members), situation, **parameters) == (409, code)


@pytest.mark.parametrize(
    "name, parameters, firmware, code",
    [
        ("tool_state", {"tool": 0, "state": "active"}, "2.05", "tool_state_firmware"),
        ("tool_state", {"tool": 0, "state": "standby"}, "2.05", "tool_state_firmware"),
        ("object", {"index": 0, "action": "cancel"}, "2.05", "objects_firmware"),
        ("heater_monitor", {"heater": 1, "limit": 280}, "2.05", "needs_firmware"),
        ("variable", {"name": "retries", "value": 4}, "2.05", "needs_firmware"),
        ("input_shaping", {"type": "mzv"}, "3.3", "needs_firmware"),
        ("led", setup_cases.VALID["led"], "3.4", "needs_firmware"),
    ],
)
def test_what_a_firmware_has_not_got(name, parameters, firmware, code):
    assert refused(name, on(firmware=firmware), **parameters) == (409, code)


def test_axes_may_be_moved_where_the_machine_allows_it():
    members = {"move.axes[0].homed": False, "move.noMovesBeforeHoming": False}
    assert go("jog", on(**members), axes={"X": 1}) == ["M120 G21 G91 G1 X1 M121"]


def test_a_tool_that_is_too_cold_to_extrude_may_be_warm_enough_to_retract():
    warm = on(**{"heat.heaters[1].current": 120.0})
    assert go("extrude", warm, amounts=-1, speed=60) == ["M120 M83 G1 E-1 F60 M121"]


@pytest.mark.parametrize("firmware", ["2.05", "3.3"])
def test_old_boards_have_power_control_unasked(firmware):
    members = {"state.atxPower": None} if firmware == "3.3" else {}
    assert go("power", on(firmware=firmware, **members), on=True) == ["M80"]
