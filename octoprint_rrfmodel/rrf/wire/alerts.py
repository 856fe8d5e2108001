"""Faults as the firmware says them in words: a line of text, or the text of a message box.

Which words depends on the version: an ``Error:`` up to 3.3, from 3.4 on an event's text behind
``- Event notification -``, some of it also in a box (3.5 GCodes3.cpp:1520, ``SendSimpleAlert``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from .sentences import sentences

MAIN_BOARD = 0


class Alert(NamedTuple):
    """One fault."""

    code: str
    """The code of the warning by which the model shows it, where it does."""
    numbers: tuple[int, ...]
    """As that warning has them."""


_BEGINS = r"(?:^|\n)\s*(?:Error: |Warning: )?"
"""Only where a message begins: a macro may say something about a driver, too."""

_ONE = (
    ("heater_fault", re.compile(_BEGINS + r"Heater (\d{1,4}) fault")),  # 3.3 LocalHeater.cpp:743
    ("heater_fault", re.compile(_BEGINS + r"Heating fault on heater (\d{1,4})")),  # before 3.0
    ("filament_error", re.compile(_BEGINS + r"Filament error on extruder (\d{1,4})")),
)

_DRIVER = re.compile(_BEGINS + r"Driver (?:(\d{1,4})\.)?(\d{1,4}) error")
"""From 3.4 on; a number in front is the board's."""

_DRIVERS = re.compile(
    _BEGINS + r"(?:over ?temperature shutdown|short[- ]to[- ]\w+)[^\n]{0,40}? on drivers?"
    r"((?: \d{1,4})+)",
    re.IGNORECASE,
)
"""Up to 3.3: several at once (3.3 Platform.cpp, ``ReportDrivers``)."""


def alerts(text: str) -> Iterator[Alert]:
    """Yield each fault that a text tells of."""
    text = sentences(text)
    for code, pattern in _ONE:
        for found in pattern.finditer(text):
            yield Alert(code, (int(found[1]),))
    for found in _DRIVER.finditer(text):
        yield Alert("driver_error", (int(found[1] or MAIN_BOARD), int(found[2])))
    for found in _DRIVERS.finditer(text):
        for number in found[1].split():
            yield Alert("driver_error", (MAIN_BOARD, int(number)))
