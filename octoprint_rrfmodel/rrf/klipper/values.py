"""Values of the model as Klipper's clients may get them: of the right type, or none."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any

from ..model.merge import DEEPEST
from ..views.machine import array, mapping
from ..views.temperatures import ABSOLUTE_ZERO, BAD_READING

BEYOND_ANY = 2**63
"""Whole numbers from here on are in no model; a float could not hold them."""


def number(value: Any) -> float | None:
    """Return a finite number, ``None`` for anything else; a truth value is no number."""
    if type(value) is int:
        return value if -BEYOND_ANY < value < BEYOND_ANY else None
    return value if type(value) is float and math.isfinite(value) else None


def whole(value: Any) -> int | None:
    """Return a whole number that isn't negative, such as an index, ``None`` for anything else."""
    return value if type(value) is int and 0 <= value < BEYOND_ANY else None


def text(value: Any) -> str:
    """Return a text, an empty one for anything else."""
    return value if isinstance(value, str) else ""


def truth(value: Any) -> bool | None:
    """Return a truth value, ``None`` for anything else."""
    return value if isinstance(value, bool) else None


def fraction(value: Any) -> float:
    """Return a number kept between 0 and 1; 0.0 for anything else."""
    known = number(value)
    return 0.0 if known is None else min(1.0, max(0.0, float(known)))


def reading(value: Any) -> float | None:
    """Return a temperature in °C; ``None`` for one that stands for a sensor that can't be read."""
    known = number(value)
    return known if known is not None and ABSOLUTE_ZERO < known < BAD_READING else None


def element(values: Any, index: Any) -> Mapping[str, Any]:
    """Return the object at an index of an array, an empty one where there is none."""
    values = array(values)
    place = whole(index)
    return mapping(values[place]) if place is not None and place < len(values) else {}


def first(values: Any) -> int | None:
    """Return the first element of an array of numbers, where that is an index."""
    values = array(values)
    return whole(values[0]) if values else None


def least(*values: float | None) -> float | None:
    """Return the smallest of those that are known."""
    known = [value for value in values if value is not None]
    return min(known) if known else None


def named(things: Iterable[tuple[str, str, Any]]) -> dict[str, Any]:
    """Return things by name: each the one it wants, or its second where that is empty or taken."""
    names: dict[str, Any] = {}
    for wanted, other, thing in things:
        name = wanted.strip()
        if not name or name in names:
            name = other
        while name in names:
            name += "_"
        names[name] = thing
    return names


def finite(value: Any, levels: int = DEEPEST) -> Any:
    """Return a value as JSON can hold it: not a number and infinity are ``None``."""
    if value is None or isinstance(value, (bool, str)):
        return value
    if isinstance(value, (int, float)):
        return number(value)
    if levels > 0 and isinstance(value, Mapping):
        return {str(name): finite(member, levels - 1) for name, member in value.items()}
    if levels > 0 and isinstance(value, (list, tuple)):
        return [finite(member, levels - 1) for member in value]
    return None
