"""What the firmware has been seen doing that isn't in the recordings, or only in part."""

from __future__ import annotations

import pytest

STUCK = ("3.5.1", "3.5.3", "3.6")
WORKING = ("3.3", "3.4", "3.6.1", "3.7")
ASK = 'M98 P"0:/macros/Ask first"'


@pytest.mark.parametrize("firmware", STUCK)
def test_a_box_in_a_macro_from_usb_is_never_left(bench, firmware):
    board = bench(firmware=firmware)
    assert board.send(ASK).startswith("- Question -\n")
    assert board.send("M105") == "T0:21.3 /0.0 B:21.3 /0.0\n"
    assert board.send("M292 P0") == ""
    assert board.send('M409 K"state.status"').endswith('"result":"busy"}\n\n')
    assert board.send('M118 S"still"', "G4 S1") == "still\n"
    assert "ok" not in board.wait(60)
    board.board.reset()
    assert board.send("M105").startswith("ok ")


@pytest.mark.parametrize("firmware", WORKING)
def test_a_box_in_a_macro_from_usb_is_answered(bench, firmware):
    board = bench(firmware=firmware)
    board.send(ASK)
    # like all that is read while a macro runs: the ok comes at its end
    assert board.send("M292 P0") == ""
    assert board.until(lambda b: b.channels["USB"].is_idle).endswith("ok\n")
    assert all(axis["homed"] for axis in board.board.model["move"]["axes"])


def test_a_box_typed_on_usb_leaves_a_level_of_the_stack(bench):
    board = bench()
    assert board.send('M291 P"a" S2').endswith("Send M292 to continue\nok\n")
    assert board.ask("inputs[3].stackDepth") == 1
    assert board.ask("state.status") == "busy"
    assert board.ask("inputs[3].state") == "awaitingAcknowledgement"


def test_a_line_that_is_too_long(bench):
    long = "x" * 300
    board = bench()
    assert board.send(f"M117 {long}") == "Error: GCode command too long\nok\n"
    assert board.send(f"M105 ;{long}").startswith("ok T0:")
    assert board.send(f'M105 M118 S"{long}"') == "Error: GCode command too long\n"


def test_a_second_declaration_has_no_ok(bench):
    board = bench()
    assert board.send("global fresh=1") == "ok\n"
    assert "ok" not in board.send("global fresh=2")


@pytest.mark.parametrize("line", ["if true", "while true", "abort"])
def test_conditions_are_bad_commands_on_usb(bench, line):
    assert bench().send(line) == f"Error: Bad command: {line}\nok\n"


def test_an_upload_takes_every_line(bench):
    board = bench()
    board.send("M28 a.gcode")
    assert board.send("M290 S0.1", 'M291 P"x" S2', "M2900", "M105") == ""
    assert board.send("M29") == "Done saving file.\nok\n"
    assert board.board.card.lines("0:/gcodes/a.gcode") == [
        "M290 S0.1",
        'M291 P"x" S2',
        "M2900",
        "M105",
    ]


def test_m25_interrupts_a_wait_for_heaters(bench):
    board = bench()
    board.board.card.write("0:/gcodes/wait.gcode", "M190 S60\nM117 behind\n")
    board.send('M32 "wait.gcode"')
    board.wait(5)
    assert board.done("M25", most=10).endswith("Printing paused at X0.0 Y0.0 Z0.0\nok\n")
    assert board.board.job.position == 0
    board.done("M24")
    board.until(lambda b: b.model["state"]["displayMessage"] == "behind")


def test_a_pause_drops_the_moves_that_have_not_begun(bench):
    board = bench().homed()
    lines = [f"G1 X{index % 2 * 50} F3000" for index in range(1, 40)]
    board.board.card.write("0:/gcodes/moves.gcode", "\n".join(lines) + "\n")
    board.send('M32 "moves.gcode"')
    board.wait(2.2)
    board.done("M25", most=10)
    done = board.board.job.line_number
    assert 2 <= done <= 4
    board.done("M24")
    board.until(lambda b: not b.job.is_printing)
    assert board.board.model["move"]["axes"][0]["machinePosition"] == 50


def test_a_failing_line_cancels_the_print(bench):
    board = bench()
    board.board.card.write("0:/gcodes/bad.gcode", "M117 before\nM104 Sx\nM117 behind\n")
    assert board.send('M32 "bad.gcode"') == (
        "File opened\nFile selected\nok\n"
        "Done printing file\n"
        "Cancelled printing file 0:/gcodes/bad.gcode, print time was 0h 0m\n"
        "Error: in GCode file line 2 column 7: M104: expected number after 'S'\n"
    )
    assert board.ask("state.displayMessage") == "before"
    assert board.ask("job.lastDuration") == 0


def test_a_macro_takes_the_place_of_its_line(bench):
    assert bench().send('M98 P"0:/macros/Say hello" M105') == "Hello\nok\n"


@pytest.mark.parametrize("line", ["G28", "G29", "G30", "G32"])
def test_homing_and_probing_are_silent(bench, line):
    board = bench().homed()
    board.send("M105", line)
    assert board.wait(1.5) == ""
    said = board.until(lambda b: b.channels["USB"].is_idle)
    assert "T0:" not in said


def test_what_is_not_read_is_lost(bench):
    board = bench(faults=["unread"])
    board.board.receive(b"M105\nM115\n")
    board.time += 10
    assert board.wait(0) == ""
    assert board.send("M105").startswith("ok ")
    board.board.receive(b"M105\n")
    assert board.wait(1).startswith("ok ")


def test_a_resumed_print_goes_back_to_where_it_was(bench):
    board = bench().homed()
    board.board.card.write("0:/gcodes/up.gcode", "G1 X20 Z1 F3000\nG4 S5\n")
    board.send('M32 "up.gcode"')
    board.wait(3)
    board.done("M25")
    assert board.board.model["move"]["axes"][2]["machinePosition"] == 6
    assert board.done("M24").endswith("Printing resumed\nok\n")
    assert board.board.model["move"]["axes"][2]["machinePosition"] == 1
