"""One key fetched whole, in as many requests as the board's buffers make necessary."""

from __future__ import annotations

import re
from typing import Any, Union

from ..model.m409 import AXES_SHOWN
from ..wire.reply import ModelReply
from ..wire.request import KEY_FLAGS, ModelRequest

AXES = "move.axes"

_STEP = re.compile(r"([^.\[\]]+)|\[([0-9]+)\]")
"""One step of a path: group 1 a member, group 2 an index."""

_Steps = list[Union[str, int]]


class Fetch:
    """Asks for a key until its value is complete.

    Arrays come in pages (``next``, asked for by ``a<n>``). ``move.axes`` is cut to nine elements
    without a word where neither f nor a is asked (3.5 Move.cpp:69), so a list of nine is asked
    for again by itself. Where a reply doesn't fit the board's buffers, ``split`` goes on with
    the members one by one.
    """

    def __init__(
        self,
        key: str,
        flags: str = KEY_FLAGS,
        *,
        in_parts: bool = False,
        without: frozenset[str] = frozenset(),
    ) -> None:
        self.key = key
        self._flags = flags
        self._paths = [key]
        self._outline = in_parts
        self._without = set(without)
        self._items: list[Any] = []
        self._parts: dict[str, Any] = {}

    @property
    def request(self) -> ModelRequest:
        """What to ask now."""
        path, flags = self._paths[0], self._flags
        if self._outline:
            # depth counts objects from the root, so this shows the members and nothing below
            flags = flags.replace("d99", f"d{path.count('.') + 2}")
        if self._items or path == AXES:
            flags += f"a{len(self._items)}"
        return ModelRequest(path, flags)

    @property
    def path(self) -> str:
        """What is asked for now: the key, or a part of it."""
        return self._paths[0]

    @property
    def left_out(self) -> frozenset[str]:
        """The parts that were not asked for, or not to be had."""
        return frozenset(self._without)

    def skip(self) -> bool:
        """Go on without the part that is asked for now; return whether that was the last."""
        self._without.add(self._paths.pop(0))
        self._outline = False
        self._items = []
        return not self._paths

    def take(self, reply: ModelReply) -> bool:
        """Take the answer to ``request``; return whether the value is complete."""
        path, value = self._paths[0], reply.result
        if isinstance(value, list):
            value = self._items + value
            # a board that says it has more and sends nothing must not be asked forever
            if reply.next == len(value) > len(self._items):
                self._items = value
                return False
        self._items = []
        self._parts[path] = value
        members = []
        if self._outline:
            self._outline = False
            asked = _members_to_ask(path, value)
            members = [member for member in asked if member not in self._without]
        elif path == "move" and isinstance(value, dict) and "f" not in self._flags:
            axes = value.get("axes")
            if isinstance(axes, list) and len(axes) == AXES_SHOWN:
                members = [AXES]
        self._paths[0:1] = members
        return not self._paths

    def split(self) -> bool:
        """Go on by smaller parts; return whether that is possible here."""
        if self._outline or self._paths[0] == AXES or "f" in self._flags:
            return False
        self._outline = True
        self._items = []
        return True

    @property
    def value(self) -> Any:
        """The value, put together from its parts; members that were left out aren't there."""
        whole = self._parts[self.key]
        for path, part in self._parts.items():
            steps = [name or int(index) for name, index in _STEP.findall(path[len(self.key) :])]
            whole = _with_part(whole, steps, part)
        for path in self._without:
            whole = _without_part(whole, path[len(self.key) :])
        return whole


def _without_part(whole: Any, path: str) -> Any:
    """Return ``whole`` without the member at a path; an element of a list stays as it was told."""
    *steps, last = [name or int(index) for name, index in _STEP.findall(path)]
    place = whole
    for step in steps:
        is_there = step in place if isinstance(place, dict) else isinstance(place, list)
        if not is_there:
            return whole
        place = place[step]
    if not isinstance(place, dict) or last not in place:
        return whole
    left = {name: value for name, value in place.items() if name != last}
    return _with_part(whole, steps, left)


def _members_to_ask(path: str, outline: Any) -> list[str]:
    """Return the paths of members, or of elements, of which the outline hasn't everything."""
    if isinstance(outline, dict):
        return [f"{path}.{name}" for name, value in outline.items() if _is_outline(value)]
    # the elements of an array are entered at the depth of an outline, and cut one level below
    return [
        f"{path}[{index}]"
        for index, value in enumerate(outline if isinstance(outline, list) else ())
        if _is_outline(list(value.values()) if isinstance(value, dict) else value)
    ]


def _is_outline(value: Any) -> bool:
    """Return whether a value may have been cut by the depth: ``{}``, or a list with one."""
    return value == {} or (isinstance(value, list) and any(map(_is_outline, value)))


def _with_part(whole: Any, steps: _Steps, part: Any) -> Any:
    """Return ``whole`` with ``part`` at the end of the steps; neither is changed."""
    if not steps:
        return part
    first, rest = steps[0], steps[1:]
    changed = whole.copy()
    changed[first] = _with_part(whole[first], rest, part)
    return changed
