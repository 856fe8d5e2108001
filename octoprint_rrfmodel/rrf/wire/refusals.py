"""Replies by which the firmware refuses what a part can't do without.

Most ``Error:`` replies only say that a command was refused, and a person who has typed it sees
that. A line of a file that a host streams is another matter: the firmware goes on with the next
one, and the file runs through to its end beside the part.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from .errors import is_halted, is_serious
from .gcode_words import words
from .sentences import sentences

LINE, EXTRUSION, MACHINE = "line", "extrusion", "machine"
"""What a reply is about: the command that is awaited, one before it that extruded (it comes behind
the ``ok``, and not for each), or none."""


class Refusal(NamedTuple):
    """One line of the table."""

    code: str
    pattern: str
    reason: str
    """Why a part is spoilt, with the source."""
    about: str = LINE


ROWS = (
    Refusal(
        "refused_move",
        r"insufficient axes homed|not homed|outside (?:machine|axis) limits|[Ff]ailed to home"
        r"|\bG(?:0|1|2|3|0/G1|28|29|30|32): ",
        "The part lacks that line (3.5 GCodes.cpp, DoStraightMove; GCodes4.cpp, homing).",
    ),
    Refusal(
        "refused_extrusion",
        r"[Ee]xtrude with no tool selected|was not driven because",
        "The head moves on without filament, also behind a T that the board doesn't know, which"
        " it takes without a word (3.5 GCodes.cpp, LoadExtrusionAndFeedrateFromGCode).",
        EXTRUSION,
    ),
    Refusal(
        "refused_selection",
        r"\bT-?\d*: |[Tt]ool \d+ (?:not found|does not exist)",
        "What follows is printed with another tool, or with none.",
    ),
    Refusal(
        "refused_heating",
        r"\b(?:M(?:104|109|116|140|141|144|190|191|568)|G10): |Invalid tool number"
        r"|temperature out of range",
        "What follows is printed too cold, or on a cold bed (3.5 GCodes2.cpp:1759).",
    ),
    Refusal(
        "refused_heating",
        r"VSSA fault",
        "What the thermistors tell is wrong (3.5 Platform.cpp, Spin).",
        MACHINE,
    ),
    Refusal(
        "refused_pause",
        r"use M226 and M601 only|M25: Cannot pause",
        "A macro of the file's was to wait for a person (3.5 GCodes2.cpp, M226).",
    ),
)

CODES = tuple(dict.fromkeys(row.code for row in ROWS))

BEGINS = ("Error:", "Warning:")

_ROWS = [(row, re.compile(row.pattern)) for row in ROWS]

_HEATING = re.compile(r"\s*(?:M(?:104|109|140|141|190|191|568)|G10)(?!\d)")

_PREFIX = re.compile(r"(?:Error|Warning): *")


def refusal(line: str) -> Refusal | None:
    """Return the row that a line is of, ``None`` for others.

    >>> refusal("Error: G1: insufficient axes homed").code
    'refused_move'
    >>> refusal("Warning: M155: Command is not supported") is None
    True
    """
    if not line.startswith(BEGINS) or is_halted(line) or is_serious(line):
        return None
    line = sentences(line)
    for row, pattern in _ROWS:
        # of commands that have failed no more than a warning is told where it goes on as it was to
        if pattern.search(line) and (row.about == EXTRUSION or line.startswith("Error:")):
            return row
    return None


def is_plain_refusal(line: str) -> bool:
    """Return whether a line refuses a command, and tells of no fault of the machine."""
    return line.startswith("Error:") and not is_halted(line) and not is_serious(line)


def text_of(line: str) -> str:
    """Return what a line says, as it may stand in a sentence.

    >>> text_of("Error: Attempting to extrude with no tool selected.")
    'Attempting to extrude with no tool selected'
    """
    return _PREFIX.sub("", line, count=1).strip().rstrip(".")


def only_switches_off(command: str) -> bool:
    """Return whether a command heats nothing: files switch off what a machine may not have.

    >>> only_switches_off("M141 S0"), only_switches_off("M104 S200 T1"), only_switches_off("G1 X1")
    (True, False, False)
    """
    if not _HEATING.match(command):
        return False
    found = words(command)
    targets = [found[letter] for letter in "SR" if letter in found]
    return bool(targets) and all(target is not None and target <= 0 for target in targets)
