"""A key of the object model, taken apart once: its value in a snapshot, and whether that changed.

The grammar is the one of ``m409`` (RepRapFirmware 3.5.3 ObjectModel.cpp:1189 and :1225). Other
than there no flags hide anything, and nothing is copied.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from enum import Enum
from typing import Any, Union

from .merge import Changes

_NAME = re.compile(r"[^.\[^]+")
"""A member's name."""

_INDEX = re.compile(r"\[[ \t\n\v\f\r]*([+-]?)0*([0-9]{1,20})\]")
"""An array's index; groups are sign and digits. Blanks may stand before it, as strtol does."""


class MalformedKey(ValueError):
    """A text that is no key."""


class _Step(Enum):
    EACH = "[]"
    """Every element."""
    MEMBERS = "."
    """A dot at the end, which only an object may have before it."""


Step = Union[str, int, _Step]

_MISSING = object()


class Key:
    """One key, such as ``heat.heaters[0].current``, ``#tools`` or ``move.axes[].homed``."""

    def __init__(self, text: str) -> None:
        """Take a key apart; raises ``MalformedKey``."""
        self.text = text
        self._lengths = text.startswith("#")
        self._steps = tuple(_steps(text, 1 if self._lengths else 0))

    def value(self, model: Mapping[str, Any], default: Any = None) -> Any:
        """Return the value in a snapshot, ``default`` where there is none.

        It is the snapshot's own, not to be changed; a list that ``[]`` makes is a new one.
        """
        found = self._below(model, 0)
        return default if found is _MISSING else found

    def touches(self, changes: Changes | None) -> bool:
        """Return whether something below the key may be other than before; see ``merge``."""
        return bool(changes) and _touches(changes, self._steps)

    def _below(self, value: Any, place: int) -> Any:
        for step in self._steps[place:]:
            place += 1
            if step is _Step.EACH:
                return self._elements(value, place)
            if step is _Step.MEMBERS:
                return self._told(value, True) if isinstance(value, Mapping) else _MISSING
            if isinstance(step, str):
                value = value.get(step, _MISSING) if isinstance(value, Mapping) else _MISSING
            else:
                has = isinstance(value, list) and 0 <= step < len(value)
                value = value[step] if has else _MISSING
            if value is _MISSING:
                return _MISSING
        return self._told(value, not self._steps)

    def _elements(self, value: Any, place: int) -> Any:
        if not isinstance(value, list):
            return _MISSING
        if place == len(self._steps) and not self._lengths:
            return value
        found = [self._below(element, place) for element in value]
        return [None if element is _MISSING else element for element in found]

    def _told(self, value: Any, of_members: bool) -> Any:
        """Return the value, or its length; of an object the lengths of its members."""
        if not self._lengths:
            return value
        if of_members:
            return {name: _length(member) for name, member in value.items()}
        length = _length(value)
        return _MISSING if length is None else length


def value_at(model: Mapping[str, Any], key: str, default: Any = None) -> Any:
    """Return the value at a key, the snapshot's own; ``default`` where there is none."""
    try:
        return Key(key).value(model, default)
    except MalformedKey:
        return default


def _steps(text: str, at: int) -> list[Step]:
    steps: list[Step] = []
    end = len(text)
    while at < end:
        if at == end - 1 and text[at] == "." and steps:
            return [*steps, _Step.MEMBERS]
        step: Step
        if steps and text.startswith("[]", at):
            step, at = _Step.EACH, at + 2
        elif steps and text[at] == "[":
            index = _INDEX.match(text, at)
            if index is None:
                raise MalformedKey(f"{text!r} is no key: what is in brackets is no number")
            step, at = int(index[1] + index[2]), index.end()
        else:
            if steps and text[at] != ".":
                raise MalformedKey(f"{text!r} is no key: a name has to follow a dot")
            name = _NAME.match(text, at + 1 if steps else at)
            if name is None:
                raise MalformedKey(f"{text!r} is no key: a name is missing")
            step, at = name[0], name.end()
        steps.append(step)
    return steps


def _touches(changes: Any, steps: tuple[Step, ...]) -> bool:
    for place, step in enumerate(steps):
        if changes is True or step is _Step.MEMBERS:
            return True
        if step is _Step.EACH:
            return any(_touches(below, steps[place + 1 :]) for below in changes.values())
        if step not in changes:
            return False
        changes = changes[step]
    return True


def _length(value: Any) -> int | None:
    if isinstance(value, list):
        return len(value)
    return len(value.encode("utf-8", "surrogatepass")) if isinstance(value, str) else None
