"""Which ``Error:`` replies say more than that a command was refused.

RepRapFirmware puts ``Error: `` before the reply of every command that fails (3.5
Platform.cpp:3560, :3609): a move beyond the limits, an unhomed axis, a cold extruder, a file
that isn't there. The machine is as well afterwards as it was before. Few texts mean harm.
"""

from __future__ import annotations

import re

from .alerts import alerts
from .sentences import sentences

SERIOUS = (
    r"heater \d+ fault",  # 3.3 LocalHeater.cpp:743
    r"heating fault",
    r"temperature excursion",
    r"temperature (?:rising|rose) too",
    r"over ?temperature",
    r"short[- ]to[- ]ground",
    r"driver \d.{0,250}?(?:error|fault|short)",
    r"emergency stop",
    r"over-?voltage",
)
"""Patterns, in lower case, of texts that a person has to see; none looks farther than a reply is
long (256 bytes), or a line of many beginnings would take time that grows with its square."""

HALTED = "machine is halted"
"""In the answer to all but a few commands after ``M112`` (3.5 GCodes2.cpp:585)."""

_SERIOUS = re.compile("|".join(SERIOUS))


def is_serious(text: str) -> bool:
    """Return whether an error's text tells of harm to the machine or of a fault of it."""
    return _SERIOUS.search(sentences(text).lower()) is not None


def guarded_warning(text: str) -> str | None:
    """Return the code of the warning that says what a serious error is about."""
    return next((alert.code for alert in alerts(text)), None)


def is_halted(text: str) -> bool:
    """Return whether a command was refused because the board was halted."""
    return HALTED in sentences(text).lower()
