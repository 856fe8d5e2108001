"""The live root, whole or, where there is no room for it, key by key."""

from __future__ import annotations

from collections.abc import Container, Mapping
from typing import Any

from ..wire.reply import ModelReply
from ..wire.request import LIVE_FLAGS, ModelRequest
from .fetch import Fetch

SEQS = "seqs"

LIVE_KEYS = (
    "state",
    "heat",
    SEQS,
    "tools",
    "move",
    "job",
    "fans",
    "sensors",
    "inputs",
    "spindles",
    "boards",
)
"""Top-level keys with live members, the most wanted first."""

FIRST = ("state", "boards", "heat", "tools", "move", "job", "fans", "sensors", "inputs")
"""Fetched before the others, so that a page has something to show early."""

MOST_ROUNDS = 16
"""Rounds of parts after which the whole is tried again, where that has failed again and again."""


def keys_of(outline: Any) -> list[str]:
    """Return the keys that an outline names, the most wanted first; where it names none the usual
    ones."""
    names = [name for name in outline if name != SEQS] if isinstance(outline, dict) else []
    if not names:
        return [key for key in LIVE_KEYS if key != SEQS]
    return [*(name for name in FIRST if name in names), *(n for n in names if n not in FIRST)]


def counter_of(key: str, counters: Mapping[str, Any]) -> Any:
    """Return what tells whether a key changed; files on a card count by themselves."""
    if key == "volumes":
        return counters.get(key), counters.get("volChanges")
    return counters.get(key)


class LiveRound:
    """Asks for the live root; after ``no_room`` for one key behind the other.

    The whole is tried again after each round of parts, and where there is still no room for it
    after two, four, ... of them.
    """

    def __init__(self) -> None:
        self._is_in_parts = False
        self._asks_whole = True
        self._has_tried = False
        self._parts: list[Fetch] = []
        self._rounds = self._pause = 0
        self.keys: tuple[str, ...] = ()
        """The parts of this round, none where the root is asked for as a whole."""

    @property
    def is_amid(self) -> bool:
        """Whether further parts belong to what has come: they are to follow at once."""
        return self._is_in_parts and (bool(self._parts) or self._has_tried)

    def request(self, known: Container[str]) -> ModelRequest:
        """Return what to ask; ``known`` are keys that the board has."""
        self._has_tried = False
        self._asks_whole = not self._parts and (not self._is_in_parts or self._rounds <= 0)
        if self._asks_whole:
            return ModelRequest("", LIVE_FLAGS)
        if not self._parts:
            self.keys = tuple(key for key in LIVE_KEYS if key in known or key == SEQS)
            self._parts = [Fetch(key, LIVE_FLAGS) for key in self.keys]
        return self._parts[0].request

    def take(self, reply: ModelReply) -> dict[str, Any] | None:
        """Take the answer; return the members that are complete with it."""
        if self._asks_whole:
            self._is_in_parts, self._pause, self.keys = False, 0, ()
            return reply.result if isinstance(reply.result, dict) else None
        part = self._parts[0]
        if not part.take(reply):
            return None
        self._go_on()
        return None if part.value is None else {part.key: part.value}

    def no_room(self) -> bool:
        """Note that there was no room for the answer; return whether another way is left."""
        if not self._asks_whole:
            return False
        self._has_tried = self._is_in_parts
        self._is_in_parts = True
        self._pause = min(MOST_ROUNDS, 2 * self._pause or 1)
        self._rounds = self._pause
        return True

    @property
    def is_trial(self) -> bool:
        """Whether the whole is only tried: that there is no room for it is known."""
        return self._asks_whole and self._is_in_parts

    def failed(self) -> None:
        """Note that a part can't be had now: the others have their turn."""
        if self._parts:
            self._go_on()

    def again(self, members: dict[str, Any]) -> None:
        """Ask once more for what has just come."""
        if self._is_in_parts:
            waiting = [part for part in self._parts if part.key not in members]
            self._parts = [Fetch(key, LIVE_FLAGS) for key in members] + waiting

    def _go_on(self) -> None:
        self._parts.pop(0)
        if not self._parts:
            self._rounds -= 1
