"""A part of the model under its path, in which ``[]`` stands for each element of a list.

The firmware answers ``heat.heaters[].state`` with one value for each heater: a column.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

EACH = "[]"


class OtherElements(ValueError):
    """A column is of other elements than the model has: the list was made longer, or shorter."""


def laid(path: str, value: Any, model: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a path was answered with in the form of a live reply, to be laid over the model.

    A column says ``null`` for a member that is null, for one that isn't there, and for an element
    that isn't; which it is the model knows. Raises ``OtherElements``.

    >>> laid("fans[].rpm", [5, None], {"fans": [{"rpm": 1}, None]})
    {'fans': [{'rpm': 5}, None]}
    """
    return _laid(path.split("."), value, model)


def _laid(steps: list[str], value: Any, known: Mapping[str, Any]) -> dict[str, Any]:
    name, rest = steps[0], steps[1:]
    if name.endswith(EACH):
        name = name[: -len(EACH)]
        return {name: _elements(rest, value, known.get(name))}
    if not rest:
        return {} if value is None and name not in known else {name: value}
    below = known.get(name)
    if isinstance(below, Mapping):
        return {name: _laid(rest, value, below)}
    if value is not None:
        raise OtherElements(name)
    return {}


def _elements(steps: list[str], values: Any, known: Any) -> list[Any]:
    if not isinstance(values, list) or not isinstance(known, list) or len(values) != len(known):
        raise OtherElements(".".join(steps))
    elements = []
    for value, element in zip(values, known):
        if isinstance(element, Mapping):
            elements.append(_laid(steps, value, element))
        elif value is None:
            elements.append(element)
        else:
            raise OtherElements(".".join(steps))
    return elements
