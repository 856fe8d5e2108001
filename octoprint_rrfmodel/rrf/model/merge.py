"""Replies laid over a model, by RepRapFirmware's patch rules, copy-on-write.

No value that is handed in is changed. What did not change is the very same object in the
result, so a reader who kept a snapshot has a consistent one, and ``is`` tells whether a subtree
changed.

A merge's outcome is a pair: the value, and what changed in it. ``None`` as the second says that
nothing did; the value is then the old one itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Union

DEEPEST = 40
"""Levels of nesting taken into a model; firmware and user variables stay below 15."""

Changes = Union[bool, dict[Union[str, int], Any]]
"""``True`` for a value that changed as a whole, else member or index to its own changes."""

Merged = tuple[Any, Union[Changes, None]]

_MISSING = object()


class NestedTooDeep(ValueError):
    """A value has more levels than any model; it is not taken."""


def patched(old: Any, new: Any) -> Merged:
    """Return ``old`` with a live reply laid over it; members that it lacks stay.

    A shorter list cuts the tail off, a longer one appends, elements in both are patched
    (Duet3D/ObjectModel, ModelCollection.update). ``null`` is a value.
    """
    return _merged(old, new, True, DEEPEST)


def replaced(old: Any, new: Any) -> Merged:
    """Return ``new``, sharing with ``old`` whatever is equal; members that it lacks go."""
    return _merged(old, new, False, DEEPEST)


def _merged(old: Any, new: Any, keep: bool, levels: int) -> Merged:
    kind = type(new)
    if kind is dict and type(old) is dict:
        return _merged_object(old, new, keep, levels)
    if kind is list and type(old) is list:
        return _merged_list(old, new, keep, levels)
    if old == new and (type(old) is bool) is (kind is bool):
        return old, None
    _measure(new, levels)
    return new, True


def _merged_object(old: dict[str, Any], new: dict[str, Any], keep: bool, levels: int) -> Merged:
    if levels <= 0:
        raise NestedTooDeep("objects nested deeper than any model")
    values = None
    changes: dict[str | int, Any] = {}
    for name, value in new.items():
        try:
            before = old[name]
        except KeyError:
            before = _MISSING
        kind = type(value)
        if kind is not dict and kind is not list:
            # 0 is 0.0 (the firmware prints a zero without decimals), but true is not 1
            if value == before and (kind is bool) is (type(before) is bool):
                continue
            change: Any = True
        elif kind is not type(before):
            _measure(value, levels - 1)
            change = True
        else:
            merge: Any = _merged_object if kind is dict else _merged_list
            value, change = merge(before, value, keep, levels - 1)
            if change is None:
                continue
        if values is None:
            values = old.copy()
        values[name] = value
        changes[name] = change
    if keep:
        return (old, None) if values is None else (values, changes)
    gone = old.keys() - new.keys()
    if values is None:
        if not gone:
            return old, None
        values = old
    changes.update(dict.fromkeys(gone, True))
    # in the reply's own order: that of the firmware's table
    return {name: values[name] for name in new}, changes


# the same loop as above over indexes: one for both would cost a call for each value
def _merged_list(old: list[Any], new: list[Any], keep: bool, levels: int) -> Merged:
    if levels <= 0:
        raise NestedTooDeep("lists nested deeper than any model")
    values = None
    changes: dict[str | int, Any] = {}
    for index, value in enumerate(new[: len(old)]):
        before = old[index]
        kind = type(value)
        if kind is not dict and kind is not list:
            if value == before and (kind is bool) is (type(before) is bool):
                continue
            change: Any = True
        elif kind is not type(before):
            _measure(value, levels - 1)
            change = True
        else:
            merge: Any = _merged_object if kind is dict else _merged_list
            value, change = merge(before, value, keep, levels - 1)
            if change is None:
                continue
        if values is None:
            values = old[:]
        values[index] = value
        changes[index] = change
    if len(new) != len(old):
        if values is None:
            values = old[:]
        common = min(len(old), len(new))
        _measure(new[common:], levels)
        values[common:] = new[common:]
        changes.update(dict.fromkeys(range(common, max(len(old), len(new))), True))
    return (old, None) if values is None else (values, changes)


def _measure(value: Any, levels: int) -> None:
    """Raise ``NestedTooDeep`` where objects and lists are in more than ``levels`` levels."""
    row = [value]
    while row:
        containers = [item for item in row if type(item) is dict or type(item) is list]
        if containers and levels <= 0:
            raise NestedTooDeep("values nested deeper than any model")
        row = []
        for item in containers:
            row.extend(item.values() if type(item) is dict else item)
        levels -= 1


def paths(changes: Changes | None, prefix: str = "") -> Iterator[str]:
    """Yield the path of every value that changed, ``heat.heaters[0].current``."""
    if changes is True:
        yield prefix
    elif changes:
        for step, below in changes.items():
            if isinstance(step, int):
                yield from paths(below, f"{prefix}[{step}]")
            else:
                yield from paths(below, f"{prefix}.{step}" if prefix else step)
