"""``M409`` evaluated on a cached model: key grammar, flags, depth, array paging.

Rules and their numbers are those found by running the firmware's own code: RepRapFirmware
3.5.3 ObjectModel.cpp (flags :504, lengths :717, objects :641, members :600 and :1204, arrays
:1077, key grammar :1189 and :1225, index :763) and RepRap.cpp:2307 (envelope).
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from .marks import MARKS

EVERY_LEVEL = 99
"""Depth where none is asked for; no model is that deep."""

ROOT_ARRAY_BYTES = 4608
"""Text length at which a root array is cut: half of 36 buffers of 256 bytes (Duet 3, Mini)."""

AXES_SHOWN = 9
"""Elements of ``move.axes`` that 3.5 and newer admit to, unless f or a is asked (Move.cpp:69)."""

_UNSIGNED = 1 << 32

_NAME = re.compile(r"[^.\[^]*")
"""A member name: up to the next ``.``, ``[`` or ``^``."""

_INDEX = re.compile(r"\[[ \t\n\v\f\r]*([+-]?)0*([0-9]+)\]")
"""An array index; groups are sign and digits. Blanks may stand before it, as strtol does."""

_DIGITS = re.compile("[0-9]*")


class Flags(NamedTuple):
    """What a flags text asks for."""

    live: bool
    important: bool
    verbose: bool
    nulls: bool
    obsolete: bool
    depth: int | None
    start: int | None


def parse_flags(text: str) -> Flags:
    """Return the meaning of a flags text such as ``d99fn``; unknown letters are ignored."""
    return Flags(
        live="f" in text,
        important="i" in text,
        verbose="v" in text,
        nulls="n" in text,
        obsolete="o" in text,
        depth=_number(text, "d"),
        start=_number(text, "a"),
    )


def _number(text: str, letter: str) -> int | None:
    """Return the number behind the last such letter, 0 without one."""
    at = text.rfind(letter)
    digits = _DIGITS.match(text, at + 1)
    if at < 0 or digits is None:
        return None
    # it wraps at 32 bits, and 10**32 is a multiple of 2**32
    return int(digits[0][-32:] or "0") % _UNSIGNED


class _Marked(dict):  # type: ignore[type-arg]
    """The marks as a tree: name to node; ``own`` holds the marks of the node itself."""

    own: frozenset[str] = frozenset()
    axes: _Marked
    """The root's alone: the node of ``move.axes``, of which not all elements are shown."""


def prepared(marks: Mapping[str, frozenset[str]]) -> _Marked:
    """Return marks in the form that ``answer`` takes fastest, for who asks with them often."""
    root = _Marked()
    for path, own in marks.items():
        node = root
        for name in path.replace("[]", "").split("."):
            node = node.setdefault(name, _Marked())
        node.own = frozenset(own)
    root.axes = root.setdefault("move", _Marked()).setdefault("axes", _Marked())
    return root


_MARKS_TREE = prepared(MARKS)
_UNMARKED = _Marked()


def answer(
    model: Any,
    key: str = "",
    flags: str = "",
    marks: Mapping[str, Any] = MARKS,
    *,
    firmware: bool = False,
    axes_shown: int | None = AXES_SHOWN,
) -> dict[str, Any]:
    """Return ``{"key", "flags", "result"}``, and ``"next"`` for an array; never raises.

    ``model`` holds plain JSON values and is not changed; parts of it may be shared with the
    result. ``marks`` maps a path pattern to its marks, or is
    what ``prepared`` has made of that. ``firmware=True`` follows the firmware to
    the letter: depth 1 for an empty key even with ``f``, long arrays cut with ``next``, and
    ``move.axes`` cut to ``axes_shown`` elements (``None`` for firmware before 3.5). Otherwise
    the vendor's page wins over the firmware's first deviation and nothing is cut.
    """
    reply: dict[str, Any] = {"key": key, "flags": flags}
    tree = _MARKS_TREE if marks is MARKS else marks
    if not isinstance(tree, _Marked):
        tree = prepared(marks)
    asked = parse_flags(flags)
    try:
        reply.update(
            _Query(asked, key, firmware=firmware, axes_shown=axes_shown).result(model, tree, reply)
        )
    except RecursionError:
        reply["result"] = None
    return reply


class _Query:
    """One evaluation: what is asked for, and the walk that answers it."""

    def __init__(self, flags: Flags, key: str, *, firmware: bool, axes_shown: int | None) -> None:
        self.lengths = key.startswith("#")
        self.key = key[1:] if self.lengths else key
        self.flags = flags
        self.firmware = firmware
        self.axes_shown = axes_shown if firmware and not flags.live else None
        if flags.start is not None:
            self.axes_shown = None
        depth = flags.depth
        if depth is None:
            shallow = not self.key and not self.lengths and (firmware or not flags.live)
            depth = 1 if shallow else EVERY_LEVEL
        self.depth = depth
        # then there is nothing to leave out, and a snapshot needs no copy
        self.is_everything = (
            not (flags.live or self.lengths or firmware)
            and flags.verbose
            and flags.nulls
            and flags.obsolete
            and depth >= EVERY_LEVEL
        )

    def result(self, model: Any, tree: _Marked, envelope: dict[str, Any]) -> dict[str, Any]:
        """Return ``result``, and ``next`` where the first thing written is an array."""
        value, rest, node, opened = model, self.key, tree, 0
        self.axes = tree.axes
        at_root = True
        # names and [n] write nothing: follow them until something is written
        while True:
            if isinstance(value, dict):
                if opened >= self.depth or not rest or (rest == "." and not at_root):
                    return {"result": self.members(value, rest, node, opened, at_root)}
                step = self.step(value, rest, node, at_root)
                if step is None:
                    return {"result": None}
                value, rest, node = step
                opened, at_root = opened + 1, False
            elif isinstance(value, list):
                value = self.shown(value, node)
                if rest.startswith("[]") or (not rest and not self.lengths):
                    return self.root_array(value, rest[2:], node, opened, envelope)
                if not rest:
                    return {"result": len(value)}
                found = self.element(value, rest)
                if found is None:
                    return {"result": None}
                value, rest = found
            else:
                return {"result": self.leaf(value, rest)}

    def root_array(
        self, value: list[Any], rest: str, node: _Marked, opened: int, envelope: dict[str, Any]
    ) -> dict[str, Any]:
        """Return the elements from the start asked for, and where to go on."""
        start = self.flags.start or 0
        result: list[Any] = []
        # one more for the comma that the first element hasn't
        room = ROOT_ARRAY_BYTES - _text_length(dict(envelope, result=[])) + 3
        for index in range(start, len(value)):
            # ObjectModel.cpp:1077: tested before each further element and its comma
            if self.firmware and result and room <= 0:
                return {"result": result, "next": index}
            result.append(self.value(value[index], rest, node, opened))
            if self.firmware:
                room -= _text_length(result[-1]) + 1
        return {"result": result, "next": 0}

    def value(self, value: Any, rest: str, node: _Marked, opened: int) -> Any:
        """Return what the rest of the key makes of ``value``."""
        if isinstance(value, dict):
            return self.object(value, rest, node, opened)
        if isinstance(value, list):
            return self.array(self.shown(value, node), rest, node, opened)
        return self.leaf(value, rest)

    def object(self, value: dict[str, Any], rest: str, node: _Marked, opened: int) -> Any:
        """Return the members of an object, or what one of them says to the rest of the key."""
        if opened >= self.depth or not rest or rest == ".":
            return self.members(value, rest, node, opened, at_root=False)
        step = self.step(value, rest, node, at_root=False)
        return self.value(step[0], step[1], step[2], opened + 1) if step else None

    def members(
        self, value: dict[str, Any], rest: str, node: _Marked, opened: int, at_root: bool
    ) -> Any:
        """Return the members that are shown; ``{}`` below the depth asked for."""
        if self.lengths and not rest and not at_root:
            return None  # an object has no length, and is not entered to find that out
        if opened >= self.depth:
            return {}
        if self.is_everything:
            return value
        return {
            name: self.value(member, "", node.get(name, _UNMARKED), opened + 1)
            for name, member in value.items()
            if self.shows(member, node.get(name, _UNMARKED).own)
        }

    def step(
        self, value: dict[str, Any], rest: str, node: _Marked, at_root: bool
    ) -> tuple[Any, str, _Marked] | None:
        """Return the member that the key names, the key's rest and the marks below it."""
        if not at_root:
            if rest[0] != ".":
                return None
            rest = rest[1:]
        matched = _NAME.match(rest)
        name = matched[0] if matched else ""
        if not name or name not in value:
            return None
        below = node.get(name, _UNMARKED)
        if not self.shows(value[name], below.own):
            return None
        return value[name], rest[len(name) :], below

    def shows(self, member: Any, marks: frozenset[str]) -> bool:
        """Return whether a member passes the flags (ObjectModel.cpp:600 and :1204)."""
        flags = self.flags
        important = flags.important and "important" in marks
        if flags.live and "live" not in marks and not important:
            return False
        if not flags.verbose and "verbose" in marks:
            return False
        if not flags.obsolete and "obsolete" in marks:
            return False
        return member is not None or flags.nulls or important

    def array(self, value: list[Any], rest: str, node: _Marked, opened: int) -> Any:
        """Return every element, one element, or the length."""
        if rest.startswith("[]"):
            rest = rest[2:]
        elif not rest:
            if self.lengths:
                return len(value)
        else:
            found = self.element(value, rest)
            return self.value(found[0], found[1], node, opened) if found else None
        return [self.value(element, rest, node, opened) for element in value]

    @staticmethod
    def element(value: list[Any], rest: str) -> tuple[Any, str] | None:
        """Return the element that ``[n]`` names, and the key behind it."""
        matched = _INDEX.match(rest)
        # an absurdly long number is out of range and need not be converted
        if matched is None or len(matched[2]) > 20:
            return None
        index = int(matched[1] + matched[2])
        return (value[index], rest[matched.end() :]) if 0 <= index < len(value) else None

    def leaf(self, value: Any, rest: str) -> Any:
        """Return a plain value where the key ends on it; its length where that is asked."""
        if rest:
            return None
        if self.lengths:
            if isinstance(value, str):
                return len(value.encode("utf-8", "surrogatepass"))
            return None
        return value

    def shown(self, value: list[Any], node: _Marked) -> list[Any]:
        """Return the elements that the firmware admits to: all, but for long ``move.axes``."""
        if self.axes_shown is not None and node is self.axes:
            return value[: self.axes_shown]
        return value


def _text_length(value: Any) -> int:
    """Return the bytes of a value as compact JSON, the form that the firmware writes."""
    text = json.dumps(value, separators=(",", ":"), ensure_ascii=False)
    return len(text.encode("utf-8", "surrogatepass"))
