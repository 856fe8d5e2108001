"""Every fault: switched on, seen on the wire or in the model, switched off."""

from __future__ import annotations

import json

import pytest

from octoprint_rrfmodel.simulator.faults import FAULTS, ON_REPLY, UnknownFault, parse_fault

ASK = 'M409 K"state.currentTool"'
ANSWER = '{"key":"state.currentTool","flags":"","result":-1}\n\nok\n'
UNDER_VOLTAGE = "Warning: VIN under-voltage event (11.0V)"

WIRE = {
    "lost_ok": ("lost_ok", "M110", ""),
    "lost_ok of a model": ("lost_ok", ASK, ANSWER[: -len("ok\n")]),
    "lost_ok of temperatures": ("lost_ok", "M105", "T0:21.3 /0.0 B:21.3 /0.0\n"),
    "extra_ok": ("extra_ok", "M110", "ok\nok\n"),
    "glued_before": ("glued_before", "M110", UNDER_VOLTAGE + "ok\n"),
    "glued_before JSON": ("glued_before", ASK, UNDER_VOLTAGE + ANSWER),
    "glued_after": ("glued_after", ASK, ANSWER.replace("\n", UNDER_VOLTAGE + "\n", 1)),
    "err_no_buffers": ("err_no_buffers", ASK, '{"err":-1}\n\nok\n'),
    "err_no_buffers above a size": ("err_no_buffers:>20", ASK, '{"err":-1}\n\nok\n'),
    "err_no_buffers below a size": ("err_no_buffers:>200", ASK, ANSWER),
    "truncated": ("truncated", ASK, '{"key":"state.currentTool\n\nok\n'),
    "truncated leaves the rest alone": ("truncated", "M110", "ok\n"),
    "garbage": ("garbage", "M110", "\x17\udc9c#@k2\udcf0 qT:\udcc1\x7f{[\x02\nok\n"),
    "no_reply": ("no_reply", ASK, ""),
    "error_reply": ("error_reply:1", "M110", "Error: Pop(): stack underflow\nok\n"),
    "debug_text": (
        "debug_text",
        "M110",
        "Delta probe: 0.012 steps 4411 hypercuboid 0\nok\n",
    ),
    "nan": (
        "nan",
        'M409 K"heat.heaters[0]" F"f"',
        '{"key":"heat.heaters[0]","flags":"f","result":{"active":0,"avgPwm":0,"current":nan,'
        '"standby":0,"state":"off"}}\n\nok\n',
    ),
    "nan is no number of a heater": (
        "nan",
        'M409 K"tools[0].heaters" F"v"',
        '{"key":"tools[0].heaters","flags":"v","result":[1],"next":0}\n\nok\n',
    ),
    "nan is no motor's current": (
        "nan",
        'M409 K"move.extruders[0].current" F"v"',
        '{"key":"move.extruders[0].current","flags":"v","result":800}\n\nok\n',
    ),
    "exponent": (
        "exponent",
        'M409 K"heat.heaters[].current"',
        '{"key":"heat.heaters[].current","flags":"","result":[2.13e+1,2.13e+1],"next":0}\n\nok\n',
    ),
    "sbc": (
        "sbc",
        'M409 K"network.hostname" F"v"',
        '{"key":"network.hostname","result":"simulated"}\n\nok\n',
    ),
    "sbc asked to answer itself": (
        "sbc",
        'M409 K"network.hostname" F"v" R1',
        '{"key":"network.hostname","flags":"v","result":"simulated"}\n\nok\n',
    ),
    "sbc leaves other keys alone": ("sbc", ASK, ANSWER),
}


@pytest.mark.parametrize(("fault", "line", "expected"), WIRE.values(), ids=WIRE)
def test_on_the_wire(bench, fault, line, expected):
    board = bench(faults=[fault])
    assert board.send(line) == expected


@pytest.mark.parametrize(("fault", "line", "expected"), WIRE.values(), ids=WIRE)
def test_switched_off_again(bench, fault, line, expected):
    board = bench()
    before = board.send(line)
    board.board.inject(fault)
    assert board.send(line) == expected
    board.board.clear(fault.partition(":")[0])
    assert board.send(line) == before


COUNTED = [
    "extra_ok",
    "glued_before",
    "glued_after",
    "err_no_buffers",
    "truncated",
    "nul_bytes",
    "bad_utf8",
    "garbage",
    "huge_line",
    "debug_text",
    "nesting_bomb",
    "no_reply",
]


@pytest.mark.parametrize("name", COUNTED)
def test_a_count_ends_the_fault(bench, name):
    board = bench(faults=[f"{name}:2"])
    assert board.send(ASK) != ANSWER
    assert board.send(ASK) != ANSWER
    assert board.send(ASK) == ANSWER
    assert board.board.faults.names() == []


def test_every_third_ok(bench):
    board = bench(faults=["lost_ok:3"])
    assert [board.send("M110") for _ in range(6)] == ["ok\n", "ok\n", ""] * 2


def test_one_ok(bench):
    board = bench(faults=["lost_ok:once"])
    assert [board.send("M110") for _ in range(3)] == ["", "ok\n", "ok\n"]


def test_bytes_that_are_no_text(bench):
    board = bench(faults=["bad_utf8:1"]).board
    board.receive(ASK.encode() + b"\n")
    data = board.transmit()
    assert b"\xff\xc3(" in data
    with pytest.raises(UnicodeDecodeError):
        data.decode("utf-8")


def test_nul_bytes(bench):
    said = bench(faults=["nul_bytes:1"]).send(ASK)
    assert said.replace("\x00", "") == ANSWER
    assert said.count("\x00") == 2


def test_huge_line(bench):
    said = bench(faults=["huge_line"]).send("M110")
    assert said == "x" * 65536 + "\nok\n"


def test_nesting_bomb(bench):
    said = bench(faults=["nesting_bomb"]).send(ASK)
    line = said.partition("\n")[0]
    assert line.startswith('{"key":"state.currentTool","flags":"","result":[[[[')
    assert line.count("[") == line.count("]") == 20000
    with pytest.raises(RecursionError):
        json.loads(line)


def test_debug_text_in_the_middle_of_a_long_line(bench):
    said = bench(faults=["debug_text"]).send('M409 K"seqs" F"v"')
    first, second, *_ = said.split("\n")
    assert first.startswith('{"key":"seqs"')
    assert first.endswith("Delta probe: 0.012 steps 4411 hypercuboid 0")
    assert second.endswith("}")


@pytest.mark.parametrize(
    ("firmware", "answer"), [("3.3", '{"err":-1}\n\nok\n'), ("3.4", '{"err":-1}\n\nok\n')]
)
def test_few_buffers_before_35(bench, firmware, answer):
    assert bench(firmware=firmware, faults=["few_buffers"]).send(ASK) == answer


@pytest.mark.parametrize("firmware", ["3.5.1", "3.5.3", "3.6"])
def test_few_buffers_hold_the_channel_up_from_35_on(bench, firmware):
    board = bench(firmware=firmware, faults=["few_buffers"])
    assert board.send(ASK, "M110") == ""
    assert board.wait(0.9) == ""
    board.board.clear("few_buffers")
    assert board.wait(0.1) == ANSWER + "ok\n"


def test_slow(bench):
    board = bench(faults=["slow:3"])
    assert board.send("M110") == ""
    assert board.wait(2.9) == ""
    assert board.wait(0.2) == "ok\n"


def test_slow_replies_keep_their_order(bench):
    board = bench(faults=["slow:3"])
    board.send("M220")
    board.board.clear("slow")
    assert board.send("M110") == ""
    assert board.wait(3) == "Speed factor: 100.0%\nok\nok\n"


def test_stall(bench):
    board = bench(faults=["stall"])
    assert board.send("M110") == ""
    assert board.wait(100) == ""
    board.board.clear("stall")
    assert board.wait(0.1) == "ok\n"


def test_stall_for_a_time(bench):
    board = bench(faults=["stall:5"])
    assert board.send("M110") == ""
    assert board.wait(4.9) == ""
    assert board.wait(0.5) == "ok\n"


def test_reset_keeps_the_port_and_loses_what_was_to_be_said(bench):
    board = bench()
    board.wait(500)
    board.send("M117 x", "G4 S100")
    board.board.inject("reset:3")
    board.wait(2)
    assert board.board.model["state"]["upTime"] == 502
    assert board.wait(1.5) == ""
    assert board.board.sessions == 0
    assert board.ask("state.upTime") == 0
    assert board.ask("state.displayMessage") == ""


def test_disconnect(bench):
    board = bench()
    board.wait(500)
    board.board.inject("disconnect:3")
    assert not board.board.is_plugged_in
    assert board.board.sessions == 1
    assert board.send("M110") == ""
    board.wait(3.1)
    assert board.send("M110") == "ok\n"
    assert board.ask("state.upTime") == 503


def test_baud(bench):
    board = bench(faults=["baud:9600"])
    board.send('M409 K"seqs" F"v"')
    first = board.wait(0.1)
    assert len(first) == 96
    rest = board.wait(10)
    assert (first + rest).endswith("\n\nok\n")


def test_unsolicited(bench):
    board = bench(faults=["unsolicited:2"])
    assert board.wait(10).count("T0:21.3 /0.0 B:21.3 /0.0\n") == 5


EVENT = "Heater 1 fault: temperature excursion exceeded 15.0°C (target 0.0°C, sensor 21.3°C)"
HEATER_FAULT = {
    "3.3": f"Error: {EVENT}\n",
    "3.4": f"- Event notification -\n{EVENT}\n",
    "3.5.3": f"- Event notification -\n{EVENT}\n",
}


@pytest.mark.parametrize(("firmware", "text"), HEATER_FAULT.items())
def test_heater_fault(bench, firmware, text):
    board = bench(firmware=firmware)
    board.board.inject("heater_fault")
    assert board.wait(0.1) == text
    assert board.ask("heat.heaters[1].state") == "fault"
    assert (board.board.model["state"]["messageBox"] is not None) is (firmware != "3.3")
    board.send("M104 S200")
    assert board.ask("heat.heaters[1].state") == "fault"
    board.send("M562 P1")
    assert board.ask("heat.heaters[1].state") == "off"


def test_a_heater_fault_pauses_a_print_from_the_card_only(bench):
    board = bench()
    board.send('M32 "square.gcode"')
    board.until(lambda b: (b.model["job"]["layer"] or 0) >= 2)
    board.board.inject("heater_fault:0")
    assert board.wait(0.1).startswith("- Printing paused -\nHeater 0 fault")
    assert board.status == "paused"


def test_filament_error_shows_in_the_model_only(bench):
    board = bench()
    board.board.inject("filament_error")
    assert board.wait(1) == ""
    assert board.ask("sensors.filamentMonitors[0].status") == "tooLittleMovement"
    board.board.clear("filament_error")
    assert board.ask("sensors.filamentMonitors[0].status") == "ok"


def test_filament_error_of_a_print_from_the_card(bench):
    board = bench()
    board.send('M32 "square.gcode"')
    board.wait(5)
    board.board.inject("filament_error")
    assert "Filament error on extruder 0" in board.wait(0.1)
    assert board.status == "paused"


def test_driver_error(bench):
    board = bench()
    board.board.inject("driver_error:3")
    assert "Driver 3 error" in board.wait(0.1)
    assert board.ask("boards[0].drivers[].status") == [0, 0, 0, 2, 0, 0, 0]
    board.board.clear("driver_error")
    assert board.ask("boards[0].drivers[3].status") == 0


def test_vin_off(bench):
    board = bench().homed()
    board.board.inject("vin_off")
    assert board.status == "off"
    assert board.ask("move.axes[0].homed") is False
    board.board.power_cycle()
    board.wait(2)
    assert board.status == "off"
    board.board.clear("vin_off")
    assert board.status == "idle"


def test_halted(bench):
    board = bench(faults=["halted"])
    assert board.send("M110") == "Error: M110: Machine is halted\nok\n"
    board.send("M999")
    board.wait(3)
    assert board.status == "idle"
    assert board.board.faults.names() == []


@pytest.mark.parametrize(("fault", "mode"), [("message_box", 2), ("message_box:3", 3)])
def test_message_box(bench, fault, mode):
    board = bench(faults=[fault])
    assert board.ask("state.messageBox.mode", "v") == mode
    assert board.status == "busy"
    board.board.clear("message_box")
    assert board.ask("state.messageBox", "n") is None


GOOD = [
    ("slow", ("slow", "2")),
    ("slow:5", ("slow", "5")),
    ("nan", ("nan", None)),
    ("err_no_buffers:>2000", ("err_no_buffers", ">2000")),
    ("baud", ("baud", "115200")),
]


@pytest.mark.parametrize(("text", "expected"), GOOD)
def test_parse(text, expected):
    assert parse_fault(text) == expected


@pytest.mark.parametrize("text", ["none", "none:5", "slow:x", "slow:-1", "", "SLOW", "slow:1 2"])
def test_what_is_no_fault(bench, text):
    with pytest.raises(UnknownFault):
        parse_fault(text)
    with pytest.raises(UnknownFault):
        bench(faults=[text])


@pytest.mark.parametrize("name", FAULTS)
def test_every_fault_can_be_on_at_the_start_and_the_board_lives(bench, name):
    """On, two replies, off, one reply: whatever happens in between, the board goes on."""
    board = bench(faults=[name])
    board.wait(1)
    board.send("M105", ASK)
    board.wait(3)
    board.board.clear(name)
    board.wait(3)
    if name == "halted":
        return
    assert board.send("M110").endswith("ok\n")


@pytest.mark.parametrize("name", FAULTS)
def test_every_fault_has_a_summary(name):
    assert FAULTS[name].summary
    assert "\n" not in FAULTS[name].summary


def test_reply_faults_are_faults():
    assert set(ON_REPLY) <= set(FAULTS)


def test_all_at_once(bench):
    board = bench(faults=[name for name in FAULTS if name not in ("stall", "disconnect")])
    for _ in range(20):
        board.send("M105", ASK, "M408 S3")
        board.wait(1)
    for name in FAULTS:
        board.board.clear(name)
    board.wait(3)
    board.send("M999")
    board.wait(10)
    assert board.send("M110").endswith("ok\n")
