"""The exact bytes of single commands on USB."""

from __future__ import annotations

import pytest

MODULES = (
    "Debugging enabled for modules:\nDebugging disabled for modules: Platform(0) Network(1) "
    "Webserver(2) Gcodes(3) Move(4) Heat(5) Kinematics(6) InputShaping(7) Debug(8) "
    "PrintMonitor(9) Storage(10) PortControl(11) DuetExpansion(12) FilamentSensors(13) WiFi(14) "
    "Display(15) SbcInterface(16) CAN(17) Expansion(18)\n"
)

UNSUPPORTED = "Command is not supported\nok\n"

BYTES = {
    "hello": ("N0 M110 N0*125", "ok\n"),
    "M105 without a tool": ("M105", "ok T0:21.3 /0.0 B:21.3 /0.0\n"),
    "M409": (
        'M409 K"heat.bedHeaters" F"d99"',
        '{"key":"heat.bedHeaters","flags":"d99","result":[0,-1,-1,-1],"next":0}\n\nok\n',
    ),
    "M409 of a counter": (
        'M409 K"#fans"',
        '{"key":"#fans","flags":"","result":2}\n\nok\n',
    ),
    "M409, lower case": (
        'm409 k"state.currentTool" f"n"',
        '{"key":"state.currentTool","flags":"n","result":-1}\n\nok\n',
    ),
    "M409 with checksum": (
        'N5 M409 K"state.currentTool"*72',
        '{"key":"state.currentTool","flags":"","result":-1}\n\nok\n',
    ),
    "quotes in a key": ('M409 K"a""b"', '{"key":"a\\"b","flags":"","result":null}\n\nok\n'),
    "comment only": ("; comment", ""),
    "empty line": ("", ""),
    "blanks": ("   ", ""),
    "comment after a command": ("G90 ; absolute", "ok\n"),
    "M111 alone": (
        "M111",
        MODULES,
    ),
    "M111 with P": (
        "M111 P1",
        MODULES,
    ),
    "M111 S0": ("M111 S0", "ok\n"),
    "wrong checksum": ("N5 M105*1", ""),
    "unknown M": ("M155 S1", "Warning: M155: " + UNSUPPORTED),
    "unknown G": ("G999", "Warning: G999: " + UNSUPPORTED),
    "bad command": ("foo", "Error: Bad command: foo\nok\n"),
    "M114": (
        "M114",
        "X:0.000 Y:0.000 Z:0.000 E:0.000 E0:0.0 Count 0 0 0 Machine 0.000 0.000 0.000 "
        "Bed comp 0.000\nok\n",
    ),
    "M119": (
        "M119",
        "Endstops - X: not stopped, Y: not stopped, Z: not stopped, Z probe: not stopped\nok\n",
    ),
    "M117": ("M117 Hello", "ok\n"),
    "M118 to USB": ('M118 P1 S"x"', "x\nok\n"),
    "M118 to all": ('M118 S"x"', "x\nok\n"),
    "M220": ("M220", "Speed factor: 100.0%\nok\n"),
    "M220 too low": (
        "M220 S0",
        "Error:  at column 7: M220: value must be greater than zero\nok\n",
    ),
    "M221 D": ("M221 D0", "Extrusion factor for extruder 0: 100.0%\nok\n"),
    "M221 without a tool": ("M221 S95", "Error: M221: No tool selected\nok\n"),
    "M140 report": (
        "M140",
        "Bed heater 0 (slot 0) is currently at 21.3°C\nok\n",
    ),
    "M568 report": ("M568 P0", "Tool 0: active/standby temperature(s) 0.0/0.0\nok\n"),
    "G10 report": ("G10 P0", "Tool 0: active/standby temperature(s) 0.0/0.0\nok\n"),
    "T": ("T", "No tool is selected\nok\n"),
    "M555": ("M555", "Output mode: Marlin\nok\n"),
    "M550": ("M550", "RepRap name: Simulated printer\nok\n"),
    "M25 without a print": (
        "M25",
        "Error: M25: Cannot pause print, because no file is being printed!\nok\n",
    ),
    "M24 without a file": (
        "M24",
        "Error: M24: Cannot print, because no file is selected!\nok\n",
    ),
    "M0 without a print": (
        "M0",
        "Error: M0: Pause the print before attempting to cancel it\nok\n",
    ),
    "M27 without a print": ("M27", "Not SD printing.\nok\n"),
    "M226 from USB": (
        "M226",
        "Error: M226: use M226 and M601 only within a file being printed\nok\n",
    ),
    "M21": ("M21", "SDHC card mounted in slot 0, capacity 15.9Gb\nok\n"),
    "M22": ("M22", "SD card 0 may now be removed\nok\n"),
    "M30 of nothing": (
        "M30 nothing.gcode",
        "Error: M30: delete failed\nok\n",
    ),
    "echo": ('echo "a", 1 + 1', "a 2\nok\n"),
    "set": ("set global.retries = 4", "ok\n"),
    "set of nothing": ("set global.none = 4", "Error: set: unknown variable 'none'\nok\n"),
    "M104 of a tool that isn't": ("M104 S200 T9", "Error: M104: Invalid tool number\nok\n"),
    "too hot": ("M568 P0 S500", "Error: M568: Requested temperature out of range\nok\n"),
    "pop of nothing": ("M121", "Error: Pop(): stack underflow on USB\nok\n"),
    "text where a quoted one must be": (
        "M409 K5",
        "Error:  at column 7: M409: expected a string expression\nok\n",
    ),
    "M999": ("M999", ""),
}


@pytest.mark.parametrize(("line", "expected"), BYTES.values(), ids=BYTES)
def test_bytes_on_usb(bench, line, expected):
    assert bench().send(line) == expected


SEVERAL = {
    "one ok at the end": ("M82 M220 S110 G91", "ok\n"),
    "text on the way": (
        "M220 M221 D0",
        "Speed factor: 100.0%\nExtrusion factor for extruder 0: 100.0%\nok\n",
    ),
    "long replies have their own ok": (
        'M409 K"state.currentTool" M105',
        '{"key":"state.currentTool","flags":"","result":-1}\n\nok\nok T0:21.3 /0.0 B:21.3 /0.0\n',
    ),
    "M105 first": ("M105 M110", "T0:21.3 /0.0 B:21.3 /0.0\nok\n"),
    "an error goes on": (
        "M220 S0 M82",
        "Error:  at column 7: M220: value must be greater than zero\nok\n",
    ),
}


@pytest.mark.parametrize(("line", "expected"), SEVERAL.values(), ids=SEVERAL)
def test_several_commands_on_a_line(bench, line, expected):
    assert bench().send(line) == expected


MOVE_ERRORS = {
    ("3.5.3", "alone"): ("G1 X10", "Error: G1: insufficient axes homed\nok\n"),
    ("3.5.3", "before others"): (
        "M120 G91 G1 X10 F6000 M121",
        "Error: M121: insufficient axes homed\nok\nok\n",
    ),
    ("3.6", "before others"): (
        "G91 G1 X10 G90",
        "Error: G90: insufficient axes homed\nok\nok\n",
    ),
    ("3.4", "alone"): ("G1 X10", "Error: G0/G1: insufficient axes homed\nok\n"),
    ("3.3", "before others"): (
        "M120 G91 G1 X10 F6000 M121",
        "Error: G0/G1: insufficient axes homed\nok\nok\n",
    ),
    ("3.5.3", "the rest of the line is run"): (
        "G1 X10 M82 M83 M220",
        "Error: M82: insufficient axes homed\nSpeed factor: 100.0%\nok\n",
    ),
}


@pytest.mark.parametrize(
    ("firmware", "line", "expected"),
    [(key[0], *value) for key, value in MOVE_ERRORS.items()],
    ids=[" ".join(key) for key in MOVE_ERRORS],
)
def test_a_failing_move_has_an_ok_too_many(bench, firmware, line, expected):
    assert bench(firmware=firmware).send(line) == expected


def test_cr_and_lf_both_end_a_line(bench):
    assert bench().send("M110\r", "M110\rM110") == "ok\nok\nok\n"


def test_a_line_may_come_in_pieces(bench):
    board = bench().board
    for piece in (b"M1", b"1", b"0", b"\n"):
        assert board.transmit() == b""
        board.receive(piece)
    assert board.transmit() == b"ok\n"


@pytest.mark.parametrize(("firmware", "longest"), [("3.3", 200), ("3.4", 255), ("3.5.3", 255)])
def test_a_line_can_be_too_long(bench, firmware, longest):
    head = "M117 "
    assert bench(firmware=firmware).send(head + "x" * (longest - len(head))) == "ok\n"
    too_long = bench(firmware=firmware).send(head + "x" * (longest - len(head) + 1))
    assert too_long == "Error: GCode command too long\nok\n"


def test_a_string_reply_near_the_limit_loses_its_ok(bench):
    long = bench()
    long.send(f'M550 P"{"n" * 240}"')
    assert long.send("M550").endswith("n\no")


@pytest.mark.parametrize("mode", [1, 0])
def test_other_compatibility_modes_have_no_ok(bench, mode):
    board = bench()
    assert board.send(f"M555 P{mode}") == "\n"
    assert board.send("M220") == "Speed factor: 100.0%\n"
    assert board.send('M409 K"state.currentTool"').endswith("-1}\n\n")
    assert board.send("M555 P2") == "ok\n"


def test_other_firmwares_are_not_emulated(bench):
    assert bench().send("M555 P4") == "Emulation of Sprinter is not supported\n"


def test_line_number_is_in_the_model(bench):
    board = bench()
    board.send("N41 M105", "N42 M105")
    assert board.ask("inputs[3].lineNumber") == 42


def test_usb_can_require_checksums(bench):
    board = bench()
    board.send("M575 P0 S1")
    assert board.send("M105") == ""
    assert board.send("N1 M105*38") != ""


def test_everything_received_is_logged(bench):
    board = bench()
    board.send("M105")
    board.wait(2)
    board.send("N1 bad*1", "; comment")
    assert board.board.received() == ["M105", "N1 bad*1", "; comment"]
    assert [entry.time for entry in board.board.log] == [0.0, 2.0, 2.0]


def test_letters_that_are_not_utf8_come_back_unchanged(bench):
    board = bench().board
    board.receive(b'M118 P1 S"\xff\xfe"\n')
    assert board.transmit() == b"\xff\xfe\nok\n"
