"""M0 and M1 in a file that a host streams: the end of the print, or a place where it pauses.

From its card the board ends a job at them: it runs stop.g, before 3.5 sleep.g for M1, and switches
the heaters off unless they have H1 (3.5 GCodes2.cpp, case 0). A host takes them for a place where
a person is to act. At the end of a file there is nothing to go on with, so that they can't be that.
"""

from __future__ import annotations

import re

from ..views.machine import Machine
from ..wire.gcode_words import words
from .blocking import padded
from .switch_off import all_off

STOPS = padded(frozenset(("M0", "M1")))

ROW = "stop"
"""As the setting that switches this off is called."""

_COMMENT = re.compile(r";.*|\([^()]*\)|^\s*%\s*$")
"""What is no command: RRF's two kinds of comments, and the sign around files of CNC machines."""

_STOP = re.compile(r"\s*(?:N\d+\s*)?M0*(?P<number>[01])(?![\d.])", re.IGNORECASE)


REFUSES_STOPS = (3, 5)
"""From here on a channel that prints no file is told to pause first (seen in 3.5.3)."""


def plain_stop(line: str) -> str | None:
    """Return a stop in the only form in which hosts know one, ``None`` for other commands.

    >>> plain_stop("N70 m00 H1"), plain_stop("M1"), plain_stop("M10")
    ('M0 H1', 'M1', None)
    """
    found = _STOP.match(line)
    return f"M{found['number']}{line[found.end() :]}" if found else None


def stop_lines(command: str, gcode: str, machine: Machine) -> list[str]:
    """Return the lines that end a print as the command does in a file on the card.

    Behind M400, for alone a host keeps it back; where the firmware refuses it, what it would do.
    """
    # of what else may stand in it the firmware reads H
    keeps_heaters = words(command).get("H") == 1
    if machine.version < REFUSES_STOPS:
        return [f"M400 {gcode} H1" if keeps_heaters else f"M400 {gcode}"]
    off = [] if keeps_heaters else [off.line for off in all_off(machine)]
    return ["M400", 'M98 P"stop.g"', *off]


def is_at_end(before: str, behind: str) -> bool:
    """Return whether a stop between two parts of a file, the first one with it, is its end.

    A host that miscounts bytes tells a wrong place: then a stop is the end where the file has no
    other one near by, and nothing behind it.
    """
    line = before.splitlines()[-1:]
    if line and _STOP.match(line[0]) and not (behind and before[-1] not in "\r\n"):
        return not _commands(behind)
    all_of_it = _commands(before + behind)
    is_stop = [bool(_STOP.match(line)) for line in all_of_it]
    return bool(is_stop) and is_stop[-1] and sum(is_stop) == 1


def _commands(text: str) -> list[str]:
    """Return the lines that are more than a comment."""
    lines = (_COMMENT.sub("", line).strip() for line in text.splitlines())
    return [line for line in lines if line]
