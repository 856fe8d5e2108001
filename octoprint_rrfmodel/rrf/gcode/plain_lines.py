"""How the firmware takes a line as it stands: lines that a host takes for no command, and ``*``.

A host that knows Marlin takes only an upper-case G, M or T with a number for a command, and waits
for the acknowledgement of nothing else. The firmware acknowledges whatever it reads, and be it
with an error (3.5 GCodes2.cpp, HandleCommand): modal moves of CNC files (``X20 Y5``), line
numbers of a file's own (``N10 G1 X5``), small letters, meta commands, ``T-1``, nonsense.
"""

from __future__ import annotations

import re

from ..wire.gcode_words import quoted

_NUMBER = re.compile(r"\s*[Nn](?:\s*\d+\s*|\s*$)")
"""A line number of the file's own in front of a command."""

_UNACKNOWLEDGED = re.compile(r"(?:\([^()]*\)\s*)*(?:(?:[Qq]\d|\x7f).*)?", re.DOTALL)
"""What may never be acknowledged, without its number: nothing, Q, which is the firmware's own
letter for a comment (3.5 GCodes2.cpp:4931), what begins with DEL, and comments in brackets, which
are nothing to a CNC machine and an error to others."""

_NAME = re.compile(r"(?P<letter>[GgMm])0*(?P<number>\d+(?:\.\d+)?)|(?P<tool>T|t\s*[-\d{])")
"""The name of a command; groups: ``letter`` and ``number``, or ``tool`` where it selects one."""

HOSTS_OWN = "@"
"""Begins a command to the host itself, which no board gets to see."""

TAKES_TEXT = frozenset(("M23", "M28", "M30", "M32", "M36", "M38", "M117"))
"""Commands whose text may stand in quotes or without (3.5 GCodeBuffer, GetUnprecedentedString)."""

_CHECKSUM = re.compile(r"\*\s*\d{1,5}\s*")
"""The whole end of a line that once had a number."""


def name_of(line: str) -> str:
    """Return by what name to know a line that a host takes for no command.

    It is empty where the board will not acknowledge the line.

    >>> [name_of(line) for line in ("X20 Y5", "n10g04 p1", "T-1", "echo 1", "(top)", "Q0")]
    ['X20', 'G4', 'T', 'echo', '', '']
    """
    numbered = _NUMBER.match(line)
    bare = line[numbered.end() :] if numbered else line.lstrip()
    if _UNACKNOWLEDGED.fullmatch(bare):
        return ""
    name = _NAME.match(bare)
    if name is None:
        return bare.split(None, 1)[0]
    return "T" if name["tool"] else name["letter"].upper() + name["number"]


def _bare_star(line: str) -> int:
    """Return where the firmware sees a checksum begin, -1 where it doesn't."""
    is_quoted = False
    depth = 0
    for place, char in enumerate(line):
        if char == '"':
            is_quoted = not is_quoted
        elif is_quoted:
            continue
        elif char == "{":
            depth += 1
        elif char == "}":
            depth = max(0, depth - 1)
        elif char == "*" and not depth:
            return place
    return -1


def with_safe_stars(command: str, gcode: str) -> str | None:
    """Return a command in a form that a line number and a checksum can be put around.

    The first ``*`` of a numbered line that stands neither in quotes nor in braces begins its
    checksum, and a line with a wrong one is dropped without a word (3.5 StringParser.cpp:262-345).
    ``None`` where no form would be whole.

    >>> with_safe_stars("M117 ** hot **", "M117"), with_safe_stars("G1 X5*33", "G1")
    ('M117 "** hot **"', 'G1 X5')
    """
    star = _bare_star(command)
    if star < 0:
        return command
    if gcode in TAKES_TEXT:
        return f"{gcode} {quoted(command[len(gcode) :].strip())}"
    if _CHECKSUM.fullmatch(command, star):
        return command[:star].rstrip()
    return None
