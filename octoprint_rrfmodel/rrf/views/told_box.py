"""A message box as the firmware prints it where it can't show it otherwise (3.5 SendAlert).

``- Title -``, the message, ``Send M292 to continue or M292 P1 to cancel``: without a title the
message alone.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

MOST_LINES = 20
"""Lines of text that are looked back on for the beginning of a box."""

_ASKS = re.compile(r"Send M292 to continue(?P<cancels> or M292 P1 to cancel)?\s*")

_TITLE = re.compile(r"- (?P<title>.*) -\s*")

OK, OK_OR_CANCEL = 2, 3

FIRST_NUMBER = 1_000_000
"""The first number of such boxes; the firmware counts its own from 1 with each start."""


def is_told(seq: int) -> bool:
    """Return whether a number is one that the firmware doesn't know."""
    return seq >= FIRST_NUMBER


def box_told(lines: Sequence[str]) -> dict[str, Any] | None:
    """Return the box whose last line is the last of some lines, ``None`` where it is none's.

    >>> box_told(["ok", "- Tool -", "Change it", "Send M292 to continue"])["message"]
    'Change it'
    """
    asks = _ASKS.fullmatch(lines[-1]) if lines else None
    if asks is None:
        return None
    before = list(lines)[:-1]
    title, message = "", before[-1:]
    for number in reversed(range(len(before))):
        found = _TITLE.fullmatch(before[number])
        if found:
            title, message = found["title"], before[number + 1 :]
            break
    return {
        "mode": OK_OR_CANCEL if asks["cancels"] else OK,
        "title": title,
        "message": "\n".join(message),
        "timeout": 0,
        "axisControls": 0,
    }
