"""Bytes and lines: what the host's bytes mean before any G-code is looked at, and reply framing.

RRF 3.5 StringParser.cpp:262-345 (line numbers and checksums), GCodes.cpp:3907-4118 (replies).
"""

from __future__ import annotations

import enum
import re
from typing import NamedTuple

from .letters import utf8

STRING_LENGTH = 256
"""Replies that aren't long ones pass a formatter of this size, NUL included
(RRF 3.5 Configuration.h:151)."""

_NUMBERED = re.compile(r"\s*[Nn]\s*(\d*)\s*(.*)", re.DOTALL)
"""A numbered line, which may lack its number; groups: line number, the rest."""

_CHECKSUM = re.compile(r"\*\s*(\d+)\s*(?:;.*)?$", re.DOTALL)
"""A checksum at the end of a line; a comment may follow (seen in firmware)."""

_MESSAGE_TYPE = re.compile(r"(?:Error|Warning): ")


def _crc_table() -> list[int]:
    table = []
    for byte in range(256):
        crc = byte << 8
        for _ in range(8):
            crc = ((crc << 1) ^ 0x1021 if crc & 0x8000 else crc << 1) & 0xFFFF
        table.append(crc)
    return table


_CRC_TABLE = _crc_table()


def crc16(data: bytes) -> int:
    """Return the CRC16 of a line: CCITT as in XMODEM, initial value 0 (RRF CRC16.h)."""
    crc = 0
    for byte in data:
        crc = ((crc << 8) & 0xFF00) ^ _CRC_TABLE[(crc >> 8) ^ byte]
    return crc


def xor(data: bytes) -> int:
    """Return the checksum of the RepRap protocol."""
    result = 0
    for byte in data:
        result ^= byte
    return result


class Line(NamedTuple):
    """A received line without line number and checksum; ``number`` is ``None`` without one."""

    text: str
    number: int | None


def _checksum_at(line: str) -> int:
    """Return where the first ``*`` outside quotes and braces is, -1 without.

    It begins the checksum even if the text goes on behind it (seen in firmware).
    """
    quoted = False
    depth = 0
    for at, char in enumerate(line):
        if char == '"':
            quoted = not quoted
        elif quoted:
            continue
        elif char == "{":
            depth += 1
        elif char == "}":
            depth = max(0, depth - 1)
        elif char == "*" and not depth:
            return at
        elif char == ";":
            break
    return -1


def parse_line(text: str, has_crc: bool = True, required: bool = False) -> Line | None:
    """Return the line, ``None`` where RRF drops it without a word for its checksum.

    A checksum counts only on a numbered line. Up to three digits are an XOR, five a CRC16; firmware
    before 3.4 knows XOR only.
    """
    if text[:1] not in "Nn \t":
        return None if required else Line(text, None)
    numbered = _NUMBERED.match(text)
    if numbered is None:
        return None if required else Line(text, None)
    number = int(numbered.group(1) or 0)
    at = _checksum_at(text)
    if at < 0:
        return None if required else Line(numbered.group(2), number)
    given = _CHECKSUM.match(text[at:])
    if given is None:
        return None
    covered = utf8(text[:at])
    digits = given.group(1)
    if len(digits) == 5 and has_crc:
        expected = crc16(covered)
    elif len(digits) <= 3:
        expected = xor(covered)
    else:
        return None
    if int(digits) != expected:
        return None
    command = _NUMBERED.match(text[:at])
    return Line(command.group(2) if command else "", number)


class Kind(enum.Enum):
    """How a reply is framed."""

    STRING = "string"
    LONG = "long"
    """Held in an output buffer: M409, M408, M20, M36, M122."""
    TEMPERATURES = "temperatures"
    """M105: the ``ok`` comes first, on the same line."""
    UPLOAD = "upload"
    """M28: the ``ok`` comes first."""
    FILE_LIST = "file list"
    """Plain M20 on a Marlin channel."""
    NONE = "none"
    """Neither text nor ``ok`` (RRF 3.5 GCodes2.cpp:1914, 4931)."""


class Reply(NamedTuple):
    """What a command answers."""

    text: str = ""
    kind: Kind = Kind.STRING


NO_REPLY = Reply("", Kind.NONE)


def _formatted(text: str) -> str:
    """Return the text as the 256-byte formatter leaves it: its tail may be lost."""
    data = utf8(text)
    if len(data) < STRING_LENGTH:
        return text
    return data[: STRING_LENGTH - 1].decode("utf-8", "surrogateescape")


_OK_FIRST = {Kind.TEMPERATURES: "ok ", Kind.UPLOAD: "ok\n"}
"""What these begin with instead of ending in it."""


def framed_marlin(reply: Reply, is_last: bool, in_macro: bool) -> str:
    """Return the characters of a reply on a channel in Marlin compatibility."""
    text, kind = reply
    if kind is Kind.NONE:
        return ""
    if kind is Kind.FILE_LIST:
        return f"Begin file list\n{text}End file list\n" + ("" if in_macro else "ok\n")
    if kind is Kind.LONG:
        # not the last command of the line is no reason to leave the ok out here
        return text + "\n" + ("" if in_macro else "ok\n")
    text = _formatted(text)
    if in_macro or not is_last:
        return text + "\n" if text else ""
    head = _OK_FIRST.get(kind)
    if head:
        # the type of a message stands in front of the ok that the command begins with
        found = _MESSAGE_TYPE.match(text)
        start = found.end() if found else 0
        return _formatted(f"{text[:start]}{head}{text[start:]}\n")
    return _formatted(f"{text}\nok\n") if text else "ok\n"


def framed_rrf(reply: Reply, is_last: bool, in_macro: bool) -> str:
    """Return the characters of a reply on a channel in RepRapFirmware mode: no ``ok`` ever."""
    if reply.kind is Kind.NONE:
        return ""
    if not reply.text and in_macro:
        return ""
    return reply.text + "\n"


FRAMINGS = {
    "Marlin": framed_marlin,
    "NanoDLP": framed_marlin,
    "RepRapFirmware": framed_rrf,
    "Default": framed_rrf,
}
"""Compatibility → framing; the others are not emulated."""

COMPATIBILITIES = (
    "Default",
    "RepRapFirmware",
    "Marlin",
    "Teacup",
    "Sprinter",
    "Repetier",
    "NanoDLP",
)
"""``M555 P`` → name (RRF 3.5 GCodeMachineState.h:150)."""


def framed(reply: Reply, compatibility: str, is_last: bool, in_macro: bool) -> str:
    """Return the characters that a channel sends for a reply."""
    framing = FRAMINGS.get(compatibility)
    if framing is None:
        return f"Emulation of {compatibility} is not supported\n"
    return framing(reply, is_last, in_macro)
