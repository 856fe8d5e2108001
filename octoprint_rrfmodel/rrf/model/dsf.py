"""What Duet Software Framework (DSF) tells of a machine, as a board by itself would tell it.

DSF tells the whole model and then patches, and neither flags nor the counters ``seqs`` by which a
board's model is followed. Here patches are laid over the model, what only DSF has is left out, and
the counters are kept. Patches are told apart from live replies (``merge``) in few places: ``{}``
and ``[]`` in a list are what hasn't changed, variables are told whole, and ``null`` takes one away.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from .m409 import prepared
from .marks import MARKS
from .merge import DEEPEST, NestedTooDeep, patched

LEFT_OUT = frozenset(("httpEndpoints", "messages", "plugins", "sbc", "userSessions"))
"""Keys that no board has; what is in them of other programs isn't for everybody's eyes."""

LEFT_OUT_BELOW = {"job": ("layers",)}
"""Members that no board has: this one grows with each layer and is told by nobody else."""

ALWAYS_CHANGING = {"volumes": frozenset(("freeSpace",))}
"""What isn't marked as live and changes all the time: the computer writes to its card."""

VARIABLES = "global"

KINDS = ("", "Warning: ", "Error: ")
"""How a message of each type begins on a board."""

MOST_RECENT = 100
"""Messages by which those of the next whole model are told to be news; DSF keeps few."""

_MARKS = prepared(MARKS)
_COUNTED = frozenset(_MARKS["seqs"])
"""Keys of which boards count the changes; the others are fetched once."""


class Unpatchable(ValueError):
    """A patch is none of the model that is known: the whole has to be fetched again."""


class Told(NamedTuple):
    """What DSF has told up to now."""

    model: dict[str, Any]
    """As a board has it, with ``seqs``; not to be changed by anybody."""
    messages: tuple[str, ...]
    """What the machine has said with the last text, a line or more each."""
    recent: tuple[Any, ...]
    """The messages that the last whole model had, to tell those that are news in the next one."""


def begun(whole: Any, before: Told | None = None) -> Told:
    """Return what a whole model tells; ``before`` is what was known until then.

    Messages are told where they are news: at first there are none, as nobody knows how old they
    are.
    """
    if not isinstance(whole, dict) or not isinstance(whole.get("state"), dict):
        raise Unpatchable("no whole model")
    known = {name: value for name, value in whole.items() if name not in LEFT_OUT}
    for key, names in LEFT_OUT_BELOW.items():
        known[key] = _without(known.get(key), names)
    try:
        known = patched({}, known)[0]
    except NestedTooDeep as error:
        raise Unpatchable(str(error)) from None
    counters = dict(before.model["seqs"]) if before else {"volChanges": [0]}
    _count(counters, known)
    recent = whole.get("messages")
    recent = tuple(recent) if isinstance(recent, list) else ()
    news = [each for each in recent if each not in before.recent] if before else []
    return Told({**known, "seqs": counters}, _texts(news), recent)


def after(told: Told, patch: Any) -> Told:
    """Return what is told once a patch has come; raises ``Unpatchable``."""
    if not isinstance(patch, dict):
        raise Unpatchable("no object")
    model, counters, changed = dict(told.model), dict(told.model["seqs"]), []
    for key, value in patch.items():
        if key in LEFT_OUT or key == "seqs":
            continue
        value = _without(value, LEFT_OUT_BELOW.get(key, ()))
        laying = _Laying(ALWAYS_CHANGING.get(key, frozenset()))
        if key == VARIABLES:
            model[key] = laying.variables(model.get(key), value)
        else:
            model[key] = laying.member(model.get(key), value, key, _MARKS, DEEPEST)
        if laying.shows:
            changed.append(key)
    _count(counters, changed)
    model["seqs"] = counters
    said = patch.get("messages")
    said = tuple(said) if isinstance(said, list) else ()
    return Told(model, _texts(said), (*told.recent, *said)[-MOST_RECENT:])


def with_another_card(told: Told) -> Told:
    """Return the same with the counter moved by which files of the card are looked at again."""
    counters = dict(told.model["seqs"])
    counters["volChanges"] = [counters["volChanges"][0] + 1]
    return told._replace(model={**told.model, "seqs": counters})


def _without(value: Any, names: tuple[str, ...]) -> Any:
    if not names or not isinstance(value, dict):
        return value
    return {name: member for name, member in value.items() if name not in names}


def _count(counters: dict[str, Any], keys: Any) -> None:
    for key in keys:
        if key in _COUNTED:
            counters[key] = counters.get(key, 0) + 1


def _texts(messages: Any) -> tuple[str, ...]:
    found = []
    for each in messages:
        content = each.get("content") if isinstance(each, dict) else None
        if isinstance(content, str) and content.strip():
            kind = each.get("type")
            begin = KINDS[kind] if type(kind) is int and 0 <= kind < len(KINDS) else ""
            found.append(begin + content)
    return tuple(found)


class _Laying:
    """Lays a patch over a part of the model, and sees whether live values tell all of it."""

    def __init__(self, always_changing: frozenset[str]) -> None:
        self._always_changing = always_changing
        self.shows = False
        """Whether something has changed that live values don't show."""

    def member(self, old: Any, new: Any, name: str, node: Mapping[str, Any], levels: int) -> Any:
        """Return a member of an object with what a patch tells of it."""
        below: Any = node.get(name, {})
        is_live = "live" in getattr(below, "own", ())
        if isinstance(new, dict) and isinstance(old, dict):
            if not is_live:
                self.shows = True
            return self._object(old, new, below, levels - 1)
        if isinstance(new, list) and isinstance(old, list):
            if not is_live and not self._is_always_changing(new):
                self.shows = True
            return self._list(old, new, below, levels - 1)
        if isinstance(new, (dict, list)) and isinstance(old, (dict, list)):
            raise Unpatchable(f"{name} is of another kind")
        if not is_live and name not in self._always_changing:
            self.shows = True
        return self._whole(new, levels)

    def variables(self, old: Any, patch: Any) -> Any:
        """Return the variables: each is told whole, and ``null`` is the end of one."""
        self.shows = True
        told = self._whole(patch, DEEPEST)
        if not isinstance(told, dict):
            return told
        laid = {**(old if isinstance(old, dict) else {}), **told}
        return {name: value for name, value in laid.items() if value is not None}

    def _object(
        self, old: dict[str, Any], new: dict[str, Any], node: Mapping[str, Any], levels: int
    ) -> dict[str, Any]:
        _enter(levels)
        laid = old.copy()
        for name, value in new.items():
            laid[name] = self.member(old.get(name), value, name, node, levels)
        return laid

    def _list(
        self, old: list[Any], new: list[Any], node: Mapping[str, Any], levels: int
    ) -> list[Any]:
        _enter(levels)
        self.shows = self.shows or len(old) != len(new)
        return [
            self._element(old[index] if index < len(old) else None, value, node, levels)
            for index, value in enumerate(new)
        ]

    def _element(self, old: Any, new: Any, node: Mapping[str, Any], levels: int) -> Any:
        if isinstance(new, dict):
            if isinstance(old, dict):
                return self._object(old, new, node, levels - 1)
            if not new:
                raise Unpatchable("what is unchanged isn't known")
        elif new == [] and isinstance(old, list):
            return old
        # a slot that was filled, or emptied
        self.shows = self.shows or (old is None) is not (new is None)
        return self._whole(new, levels)

    def _whole(self, value: Any, levels: int) -> Any:
        if isinstance(value, (dict, list)):
            self.shows = True
            try:
                return patched({}, {"": value})[0][""]
            except NestedTooDeep as error:
                raise Unpatchable(str(error)) from None
        return value

    def _is_always_changing(self, elements: list[Any]) -> bool:
        return bool(self._always_changing) and all(
            isinstance(each, dict) and self._always_changing.issuperset(each) for each in elements
        )


def _enter(levels: int) -> None:
    if levels <= 0:
        raise Unpatchable("nested deeper than any model")
