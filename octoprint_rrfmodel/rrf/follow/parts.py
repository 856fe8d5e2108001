"""A key cut into paths of which each has a short answer."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from ..model.columns import EACH
from ..model.m409 import answer

MOST_BYTES = 350
"""Longest answer on a slow line, where the firmware can give it so short: 30 ms at 115200 baud."""

ROOM_TO_GROW = 40
"""Bytes by which an answer may get longer: by and by numbers have more digits."""

WHOLE = frozenset(("state.messageBox",))
"""What is told as a whole or not at all: half a question is none."""

PARTED = frozenset(("heat", "heat.heaters", "boards", "boards[].drivers", "sensors"))
"""What is told by its members however short it is: one of them is asked for oftener."""


def parts_of(key: str, flags: str, model: Mapping[str, Any]) -> list[str]:
    """Return the paths by which a key is asked for, none where nothing would be answered.

    >>> parts_of("heat", "fin", {"heat": {"heaters": [{"state": "off", "current": 20.5}]}})
    ['heat.heaters[].state', 'heat.heaters[].current']
    """
    return list(_parts(key, flags, model))


def length_of(path: str, flags: str, value: Any) -> int:
    """Return the bytes of an answer without the line's end."""
    text = json.dumps(value, separators=(",", ":"), ensure_ascii=False)
    following = len(',"next":0') if isinstance(value, list) else 0
    envelope = len('{"key":"","flags":"","result":}')
    return envelope + len(path) + len(flags) + len(text.encode()) + following


def told(path: str, flags: str, model: Mapping[str, Any]) -> Any:
    """Return what a board with this model would answer."""
    return answer(model, path, flags, firmware=True, axes_shown=None)["result"]


def _parts(path: str, flags: str, model: Mapping[str, Any]) -> Iterator[str]:
    value = told(path, flags, model)
    items = [item for item in _items(value, path.count(EACH)) if item not in (None, {}, [])]
    if not items and value is not None and not _is_simple(value):
        return
    if value is None and "." not in path:
        return
    is_short = length_of(path, flags, value) + ROOM_TO_GROW <= MOST_BYTES
    below: list[str] = []
    if path not in WHOLE and (not is_short or path in PARTED):
        below = list(_below(path, items))
    if not below:
        yield path
    for part in below:
        yield from _parts(part, flags, model)


def _items(value: Any, depth: int) -> list[Any]:
    """Return the values of a column, or the one value of what is none."""
    items = [value]
    for _ in range(depth):
        items = [each for item in items if isinstance(item, list) for each in item]
    return items


def _below(path: str, items: list[Any]) -> Iterator[str]:
    """Yield the paths of an object's members, of the columns of a list of objects; none else."""
    for name in dict.fromkeys(name for item in items if isinstance(item, dict) for name in item):
        yield f"{path}.{name}"
    elements = [each for item in items if isinstance(item, list) for each in item]
    for name in dict.fromkeys(name for each in elements if isinstance(each, dict) for name in each):
        yield f"{path}{EACH}.{name}"


def _is_simple(value: Any) -> bool:
    return not isinstance(value, (dict, list))
