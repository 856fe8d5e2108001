"""Line numbers, checksums, and the characters around a reply."""

from __future__ import annotations

import pytest

from octoprint_rrfmodel.simulator.text.serial_line import (
    Kind,
    Line,
    Reply,
    crc16,
    framed,
    parse_line,
    xor,
)


def summed(text):
    return f"{text}*{xor(text.encode())}"


def crc(text):
    return f"{text}*{crc16(text.encode()):05d}"


ACCEPTED = {
    "plain": ("M105", Line("M105", None)),
    "number without checksum": ("N12 M105", Line("M105", 12)),
    "XOR": ("N0 M110 N0*125", Line("M110 N0", 0)),
    "CRC": (crc("N7 M105"), Line("M105", 7)),
    "lower-case n": (summed("n3 M105"), Line("M105", 3)),
    "blank before the star": (summed("N3 M105 "), Line("M105 ", 3)),
    "star in quotes": ('N4 M117 "a*b"', Line('M117 "a*b"', 4)),
    "star in quotes and a checksum": (summed('N4 M117 "a*b"'), Line('M117 "a*b"', 4)),
    "star in braces": ("N5 G1 X{2*3}", Line("G1 X{2*3}", 5)),
    "checksum without number isn't one": ("M105*1", Line("M105*1", None)),
    "empty": ("", Line("", None)),
    "N that is no number": ("Nothing", Line("othing", 0)),
}


@pytest.mark.parametrize(("text", "expected"), ACCEPTED.values(), ids=ACCEPTED)
def test_line_is_accepted(text, expected):
    assert parse_line(text) == expected


DROPPED = {
    "wrong XOR": "N1 M105*1",
    "wrong CRC": "N1 M105*12345",
    "four digits": "N1 M105*0099",
    "no digits": "N1 M105*",
    "letters": "N1 M105*abc",
}


@pytest.mark.parametrize("text", DROPPED.values(), ids=DROPPED)
def test_line_is_dropped_without_a_word(text):
    assert parse_line(text) is None


def test_crc_is_unknown_before_34():
    assert parse_line(crc("N7 M105"), has_crc=False) is None


@pytest.mark.parametrize("text", ["M105", "N1 M105"])
def test_a_required_checksum_must_be_there(text):
    assert parse_line(text, required=True) is None
    assert parse_line(summed("N1 M105"), required=True) == Line("M105", 1)


@pytest.mark.parametrize(("data", "expected"), [(b"", 0), (b"123456789", 0x31C3)])
def test_crc16(data, expected):
    assert crc16(data) == expected


MARLIN = {
    "empty reply": (Reply(), True, False, "ok\n"),
    "text": (Reply("Speed factor: 100.0%"), True, False, "Speed factor: 100.0%\nok\n"),
    "temperatures": (Reply("T:1 /0", Kind.TEMPERATURES), True, False, "ok T:1 /0\n"),
    "upload": (Reply("Writing to file: a", Kind.UPLOAD), True, False, "ok\nWriting to file: a\n"),
    "not last, empty": (Reply(), False, False, ""),
    "not last, text": (Reply("x"), False, False, "x\n"),
    "not last, temperatures": (Reply("T:1 /0", Kind.TEMPERATURES), False, False, "T:1 /0\n"),
    "in a macro": (Reply("x"), True, True, "x\n"),
    "long": (Reply("{}\n", Kind.LONG), True, False, "{}\n\nok\n"),
    "long, not last": (Reply("{}\n", Kind.LONG), False, False, "{}\n\nok\n"),
    "long in a macro": (Reply("{}\n", Kind.LONG), True, True, "{}\n\n"),
    "file list": (
        Reply("a.g\n", Kind.FILE_LIST),
        True,
        False,
        "Begin file list\na.g\nEnd file list\nok\n",
    ),
    "nothing at all": (Reply("", Kind.NONE), True, False, ""),
    "ok falls off a long text": (Reply("x" * 253), True, False, "x" * 253 + "\no"),
    "text itself is cut": (Reply("x" * 300), True, False, "x" * 255),
    "the last that keeps its ok": (Reply("x" * 251), True, False, "x" * 251 + "\nok\n"),
}


@pytest.mark.parametrize(("reply", "is_last", "in_macro", "expected"), MARLIN.values(), ids=MARLIN)
def test_marlin_framing(reply, is_last, in_macro, expected):
    assert framed(reply, "Marlin", is_last, in_macro) == expected


NATIVE = {
    "empty reply": (Reply(), "\n"),
    "text": (Reply("x"), "x\n"),
    "temperatures": (Reply("T:1 /0", Kind.TEMPERATURES), "T:1 /0\n"),
    "nothing at all": (Reply("", Kind.NONE), ""),
}


@pytest.mark.parametrize(("reply", "expected"), NATIVE.values(), ids=NATIVE)
@pytest.mark.parametrize("mode", ["RepRapFirmware", "Default"])
def test_native_framing_has_no_ok(mode, reply, expected):
    assert framed(reply, mode, True, False) == expected


def test_other_firmwares_are_not_emulated():
    assert framed(Reply("x"), "Teacup", True, False) == "Emulation of Teacup is not supported\n"
