"""What has changed in a model, as the websocket tells it (DSF ModelSubscription.cs).

Objects: only changed members. Lists of objects: full length, ``{}`` unchanged, ``null`` an empty
slot. Lists of lists: ``[]`` unchanged. Lists of plain values: complete. Growing lists: what is new;
an empty one has been cleared. Dictionaries: ``null`` for what has gone.
"""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any

MESSAGES = "messages"
GROWING = frozenset((MESSAGES, "job.layers"))
DICTIONARIES = frozenset(("global", "plugins"))


class Patches:
    """Follows a model for one listener, from the model that it was told first."""

    def __init__(self, model: Mapping[str, Any]):
        self._told: dict[str, Any] = copy.deepcopy(dict(model))

    def next(self, model: Mapping[str, Any]) -> dict[str, Any] | None:
        """Return what has changed since the last call, ``None`` where nothing has."""
        patch = _members(self._told, model, "")
        if not patch:
            return None
        told = copy.deepcopy(dict(model))
        for path in GROWING:
            _set_cleared(patch, told, path.split("."))
        self._told = told
        return patch


def _set_cleared(patch: Any, told: Any, steps: list[str]) -> None:
    """A list that has been cleared is told to be empty; what it has now comes next time."""
    *parents, name = steps
    for step in parents:
        patch, told = (patch or {}).get(step), (told or {}).get(step)
    if patch and told and patch.get(name) == []:
        told[name] = []


def _members(old: Mapping[str, Any], new: Mapping[str, Any], path: str) -> dict[str, Any]:
    found = {
        name: _value(old.get(name), value, f"{path}.{name}" if path else name)
        for name, value in new.items()
        if name not in old or old[name] != value
    }
    if path in DICTIONARIES:
        found.update({name: None for name in old if name not in new})
    if not path and found.get(MESSAGES) == []:
        # those that have become old are gone without a word
        del found[MESSAGES]
    return found


def _grown(old: list[Any], new: list[Any], *, keeps_order: bool) -> list[Any]:
    """Return what is new at the end, nothing where the list has been cleared.

    Where it keeps its order its beginning may have gone, and that isn't told.
    """
    gone = range(len(old) + 1) if keeps_order else (0,)
    for count in gone:
        kept = old[count:]
        if new[: len(kept)] == kept:
            return new[len(kept) :]
    return []


def _value(old: Any, new: Any, path: str) -> Any:
    if path in GROWING and isinstance(old, list) and isinstance(new, list):
        return _grown(old, new, keeps_order=path == MESSAGES)
    if path.partition(".")[0] in DICTIONARIES and "." in path:
        return new
    if isinstance(old, dict) and isinstance(new, dict):
        return _members(old, new, path)
    if isinstance(old, list) and isinstance(new, list):
        return _elements(old, new, path)
    return new


def _elements(old: list[Any], new: list[Any], path: str) -> list[Any]:
    if any(isinstance(element, dict) for element in new):
        return [
            _members(old[index], element, path)
            if index < len(old) and isinstance(old[index], dict) and isinstance(element, dict)
            else element
            for index, element in enumerate(new)
        ]
    if any(isinstance(element, list) for element in new):
        return [
            [] if index < len(old) and old[index] == element else element
            for index, element in enumerate(new)
        ]
    return new
