"""Commands that hold USB up, what comes out meanwhile, and what doesn't."""

from __future__ import annotations

import gc

import pytest

from octoprint_rrfmodel.simulator.interpreter.table import Row

BLOCKING = {
    "G28": "G28",
    "G29": "G29",
    "G30": "G30",
    "G32": "G32",
    "G4": "G4 S5",
    "M400": "M400",
    "T": "T0",
    "M109": "M109 S60",
    "M116": "M116",
    "M190": "M190 S40",
    "M98": 'M98 P"0:/macros/Slow"',
}


@pytest.mark.parametrize("line", BLOCKING.values(), ids=BLOCKING)
def test_usb_waits_for_the_end_of_a_blocking_command(bench, line):
    board = bench().homed()
    board.board.card.write("0:/macros/Slow", "G4 S3\n")
    board.send("M140 S45", "M106 P0 S0")
    board.send("G1 X100 F600")
    assert board.send(line, "M220") == ""
    said = board.until(lambda b: b.channels["USB"].is_idle)
    assert said.endswith("ok\nSpeed factor: 100.0%\nok\n")


IMMEDIATE = {
    "G1": "G1 X1 F600",
    "M104": "M104 S200",
    "M140": "M140 S60",
    "M106": "M106 S1",
    "M568": "M568 P0 S200 A2",
    "M220": "M220 S90",
    "M409": 'M409 K"seqs.move"',
    "M105": "M105",
    "M291 S2": 'M291 P"a" R"b" S2',
    "M117": "M117 x",
}


@pytest.mark.parametrize("line", IMMEDIATE.values(), ids=IMMEDIATE)
def test_other_commands_answer_at_once(bench, line):
    board = bench().homed()
    board.send("G1 X100 F600")
    said = board.send(line)
    assert said.endswith("ok\n") or said.startswith("ok ")


def test_m409_waits_behind_a_blocking_command(bench):
    board = bench()
    assert board.send("G4 S10", 'M409 K"seqs.move"', 'M409 K"seqs.heat"') == ""
    assert board.wait(5) == ""
    assert board.wait(6).count('"result"') == 2


REPORTS = {
    ("3.3", "M105"): 10,
    ("3.3", "M409"): 10,
    ("3.3", None): 10,
    ("3.4", "M409"): 10,
    ("3.5.1", "M409"): 10,
    ("3.5.1", None): 10,
    ("3.5.3", "M105"): 5,
    ("3.5.3", "M409"): 0,
    ("3.5.3", "M408"): 0,
    ("3.5.3", None): 0,
    ("3.6", "M105"): 5,
    ("3.6", "M409"): 0,
}


@pytest.mark.parametrize(
    ("firmware", "request_", "count"),
    [(*key, count) for key, count in REPORTS.items()],
    ids=[f"{firmware} after {request}" for firmware, request in REPORTS],
)
def test_temperatures_while_blocked_follow_the_last_request(bench, firmware, request_, count):
    board = bench(firmware=firmware)
    if request_ is not None:
        board.send({"M409": 'M409 K"seqs"', "M408": "M408 S0"}.get(request_, request_))
    board.send("G4 S10.5")
    said = board.wait(10.4)
    assert said == "T0:21.3 /0.0 B:21.3 /0.0\n" * count
    assert board.wait(0.6) == "ok\n"


def test_the_last_request_counts(bench):
    board = bench()
    board.send('M409 K"seqs"', "M105", "G4 S5")
    assert board.wait(4.9).count("B:") == 2


def test_m408_with_another_type_is_no_status_request(bench):
    board = bench()
    board.send("M105", "M408 S3", "G4 S5")
    assert board.wait(4.9).count("B:") == 2


def test_other_channels_go_on(bench):
    board = bench()
    board.send("G4 S100")
    assert board.board.execute("M220") == "Speed factor: 100.0%\n"
    board.board.execute("M117 Hello")
    assert board.board.model["state"]["displayMessage"] == "Hello"
    assert board.board.model["inputs"][3]["state"] == "waiting"
    assert board.board.model["inputs"][0]["state"] == "idle"


def test_http_replies_have_no_ok(bench):
    board = bench().board
    assert board.execute("M110") == "\n"
    assert board.execute("M105") == "T0:21.3 /0.0 B:21.3 /0.0\n"
    assert board.execute('M409 K"state.thisInput" F"v"') == (
        '{"key":"state.thisInput","flags":"v","result":0}\n\n'
    )


def test_a_reply_on_http_bumps_its_counter(bench):
    board = bench()
    board.board.execute("M220")
    assert board.ask("seqs.reply") == 1


def test_a_waiting_command_on_http_answers_later(bench):
    board = bench()
    assert board.board.execute("G4 S2\nM220") == ""
    board.wait(3)
    assert board.board.execute("M82") == "\nSpeed factor: 100.0%\n\n"


@pytest.mark.parametrize("name", ["USB", "nonsense"])
def test_only_other_channels_can_execute(bench, name):
    with pytest.raises(ValueError, match="no channel"):
        bench().board.execute("M105", name)


def test_waiting_for_heat_reads_idle(bench):
    board = bench()
    board.done("T0")
    board.send("M109 S200")
    board.wait(5)
    assert board.status == "idle"


def test_moving_reads_busy(bench):
    board = bench().homed()
    board.send("G1 X100 F600")
    board.wait(1)
    assert board.status == "busy"
    board.wait(20)
    assert board.status == "idle"


ALLOWED_WHEN_HALTED = ["M105", "M112", "M115", "M122", "M408 S0", 'M409 K"state.status"']


@pytest.mark.parametrize("line", ALLOWED_WHEN_HALTED)
def test_what_a_halted_board_accepts(bench, line):
    board = bench()
    board.send("M112")
    assert "Machine is halted" not in board.send(line)


@pytest.mark.parametrize("line", ["G28", "M104 S0", "M110 N0", "T0", "G1 X1", 'echo "a"'])
def test_what_it_does_not(bench, line):
    board = bench()
    assert board.send("M112") == "Emergency Stop! Reset the controller to continue.\nok\n"
    assert board.status == "halted"
    assert board.send(line) == f"Error: {line.split()[0]}: Machine is halted\nok\n"


def test_emergency_stop_is_in_band(bench):
    """M112 from USB isn't seen while USB waits; from elsewhere it is."""
    board = bench()
    board.send("M104 S200", "G4 S60", "M112")
    board.wait(5)
    assert board.status == "idle"
    board.board.execute("M112")
    assert board.status == "halted"
    said = board.wait(0.1)
    assert said.count("Emergency Stop!") == 2
    assert board.board.model["heat"]["heaters"][1]["state"] == "off"


def test_m108_ends_waits_from_another_channel(bench):
    board = bench()
    board.done("T0")
    board.send("M109 S200")
    board.wait(2)
    board.board.execute("M108")
    assert board.wait(0.1).endswith("ok\n")


def test_m108_on_usb_comes_too_late(bench):
    board = bench()
    board.done("T0")
    board.send("M109 S200", "M108")
    board.wait(2)
    assert board.board.channels["USB"].is_blocked


def test_m999_restarts_without_a_reply(bench):
    board = bench()
    board.wait(100)
    board.send("M568 P0 S200")
    assert board.send("M999") == ""
    assert board.board.is_plugged_in
    board.wait(1.1)
    assert not board.board.is_plugged_in
    assert board.send("M115") == ""
    board.wait(1.1)
    assert board.send("M115") != ""
    assert board.ask("state.upTime") < 3
    assert board.ask("tools[0].active") == [0]


def test_a_blocking_macro_answers_once(bench):
    board = bench()
    board.board.card.write("0:/macros/Chatty", 'M118 P1 S"one"\nM220\nG4 S1\nM221 D0\n')
    assert board.send('M98 P"0:/macros/Chatty"') == "one\nSpeed factor: 100.0%\n"
    assert board.wait(1.1) == "Extrusion factor for extruder 0: 100.0%\nok\n"


def test_a_missing_macro(bench):
    assert bench().send('M98 P"none.g"') == "Warning: Macro file none.g not found\nok\n"


def test_an_unknown_code_may_be_a_macro(bench):
    board = bench()
    board.board.card.write("0:/sys/M155.g", 'M118 P1 S"mine"\n')
    assert board.send("M155 S1") == "mine\nok\n"


def test_ok_comes_late_while_the_queue_is_full(bench):
    """One move under way, two behind it, one in front of the queue (seen in firmware)."""
    board = bench().homed()
    board.send("G1 X10 F600")
    board.wait(1.1)
    lines = [f"G1 X{20 if index % 2 else 120} F600" for index in range(10)]
    assert board.send(*lines).count("ok\n") == 4
    assert board.wait(11.1).count("ok\n") == 1


def test_the_queue_takes_two_seconds_of_short_moves(bench):
    board = bench().homed()
    lines = [f"G1 X{index % 2} F600" for index in range(1, 41)]
    assert 20 < board.send(*lines).count("ok\n") < 24


def test_receive_buffer_fills_while_usb_waits(bench):
    board = bench()
    board.send("G4 S10")
    assert board.board.has_room
    board.send(*["M117 " + "x" * 100] * 5)
    assert not board.board.has_room
    board.wait(11)
    assert board.board.has_room


def test_a_reset_ends_what_was_under_way(bench):
    board = bench()
    board.send("G28")
    board.wait(3)
    assert board.status == "busy"
    board.board.reset()
    # a command that is only forgotten would end when it is collected, in the board of afterwards
    gc.collect()
    assert board.status == "idle"
    assert board.send("M110") == "ok\n"


def test_a_group_of_gcodes_registers_itself(bench):
    class Greetings:
        def rows(self):
            return {"M9001": Row(self._greet), "M9002": Row(self._greet, since=(3, 6))}

        def _greet(self, channel, command):
            return f"hello {channel.name} {command.integer('S')}"

    board = bench()
    assert board.send("M9001 S3") == "Warning: M9001: Command is not supported\nok\n"
    board.board.gcodes.register(Greetings())
    assert board.send("M9001 S3") == "hello USB 3\nok\n"
    assert board.send("M9002 S3") == "Warning: M9002: Command is not supported\nok\n"
