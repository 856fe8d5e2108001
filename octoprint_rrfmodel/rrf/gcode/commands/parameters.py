"""Parameters of commands: a reader for each kind returns the value, or raises ``Refused``.

What a parameter must be by itself is here; what the machine has is in ``things``.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping, Sequence
from typing import Any, Callable, NamedTuple

from ...views.machine import Machine
from ...wire.gcode_words import number as as_text
from .outcome import bad

Read = Callable[[str, Any, Machine], Any]
"""Name, value and machine to what the value means."""

HUGE = 1e9
"""Beyond this no number means anything to a machine."""

LARGEST = 2**32 - 1
"""The largest whole number that the firmware reads."""

MOST_PATH_BYTES = 120
"""Longest path that the firmware takes (3.5 Configuration.h, MaxFilenameLength)."""

UNSENDABLE = ("Cc", "Cs", "Zl", "Zp")
"""Unicode categories that must not get into a line: control characters, halves of a character,
line and paragraph separators."""

SHOWN_LETTERS = 40


class Parameter(NamedTuple):
    """One parameter of a command."""

    name: str
    read: Read
    is_required: bool = True
    default: Any = None


def shown(value: object) -> str:
    """Return what somebody sent, short and harmless enough to be told to a person."""
    text = str(value) if isinstance(value, (str, int, float)) else type(value).__name__
    return "".join(letter if letter.isprintable() else "?" for letter in text[:SHOWN_LETTERS])


def listed(values: Sequence[object]) -> str:
    """Return the things there are; a dash for none."""
    return ", ".join(map(str, values)) or "–"


def values_of(
    command: str, rows: Sequence[Parameter], given: Mapping[str, Any], machine: Machine
) -> dict[str, Any]:
    """Return the value of each parameter; ``null`` counts as left out."""
    known = [row.name for row in rows]
    for name in given:
        if name not in known:
            raise bad(
                "unknown_parameter", command=command, parameter=shown(name), known=listed(known)
            )
    values = {}
    for row in rows:
        value = given.get(row.name)
        if value is None:
            if row.is_required:
                raise missing(row.name)
            # a bed 0 that is meant silently has to be there too
            value = row.default
        values[row.name] = None if value is None else row.read(row.name, value, machine)
    return values


def missing(name: str) -> Exception:
    """Return the exception for a parameter that has to be there."""
    return bad("missing_parameter", parameter=name)


def is_number(value: Any) -> bool:
    """Return whether a value is a number; truth values are none."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def number_or(value: Any, otherwise: float) -> float:
    """Return a number of the model, the other one for anything else."""
    return value if is_number(value) else otherwise


def within(name: str, value: float, low: float, high: float) -> float:
    """Return a number that lies in its range; what is no number lies in none."""
    if not low <= value <= high:
        raise bad("out_of_range", parameter=name, low=as_text(low), high=as_text(high))
    return float(value)


def number(low: float = -HUGE, high: float = HUGE) -> Read:
    """Return the reader of a number from ``low`` to ``high``."""

    def read(name: str, value: Any, machine: Machine) -> float:
        if not is_number(value):
            raise bad("not_a_number", parameter=name)
        return within(name, value, low, high)

    return read


def several(low: float = -HUGE, high: float = HUGE) -> Read:
    """Return the reader of one number, or a list of them."""
    one = number(low, high)

    def read(name: str, value: Any, machine: Machine) -> float | tuple[float, ...]:
        if not isinstance(value, (list, tuple)):
            result: float = one(name, value, machine)
            return result
        if not value:
            raise bad("not_a_number", parameter=name)
        return tuple(one(name, item, machine) for item in value)

    return read


def whole_number(name: str, value: Any, machine: Machine) -> int:
    """Return a whole number that some firmware could mean something with; 3.0 is none."""
    if not isinstance(value, int) or isinstance(value, bool) or abs(value) > LARGEST:
        raise bad("not_whole", parameter=name)
    return value


def whole(low: int, high: int) -> Read:
    """Return the reader of a whole number from ``low`` to ``high``."""

    def read(name: str, value: Any, machine: Machine) -> int:
        return int(within(name, whole_number(name, value, machine), low, high))

    return read


def truth(name: str, value: Any, machine: Machine) -> bool:
    """Return a truth value."""
    if not isinstance(value, bool):
        raise bad("not_a_truth_value", parameter=name)
    return value


def word(*known: str) -> Read:
    """Return the reader of one of these words."""

    def read(name: str, value: Any, machine: Machine) -> str:
        if not isinstance(value, str) or value not in known:
            raise bad("wrong_word", parameter=name, known=listed(known))
        return value

    return read


def sendable(name: str, value: Any) -> str:
    """Return a text that can be part of a line.

    A host takes a semicolon for the beginning of a comment, even between quotes.
    """
    if not isinstance(value, str):
        raise bad("not_a_text", parameter=name)
    if ";" in value or any(unicodedata.category(letter) in UNSENDABLE for letter in value):
        raise bad("unsendable", parameter=name)
    return value


def text(most: int) -> Read:
    """Return the reader of a text of one to ``most`` bytes."""

    def read(name: str, value: Any, machine: Machine) -> str:
        checked = sendable(name, value)
        if not 0 < len(checked.encode("utf-8")) <= most:
            raise bad("wrong_length", parameter=name, most=str(most))
        return checked

    return read


def path(name: str, value: Any, machine: Machine) -> str:
    """Return the path of a file on a card."""
    checked: str = text(MOST_PATH_BYTES)(name, value, machine)
    if checked.endswith(("/", "\\")) or not checked.strip():
        raise bad("not_a_file", parameter=name)
    return checked
