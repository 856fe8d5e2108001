"""What to ask the board next. Decides; sends nothing and knows no clock."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from ..wire.reply import ModelReply
from ..wire.request import LIVE_FLAGS, OUTLINE_FLAGS, ModelRequest, Request
from .fetch import Fetch
from .live import LIVE_KEYS, SEQS, LiveRound
from .too_large import TooLarge

FIRST = ("state", "boards", "heat", "tools", "move", "job", "fans", "sensors", "inputs")
"""Fetched before the others, so that a page has something to show early."""

FETCHES_BETWEEN_LIVE = 4
"""Keys fetched in a row before a live reply is due again."""

WHOLE_EVERY = 4
"""A key that was asked for in parts is tried as a whole again each so many times."""

PATIENCE = 3
"""Failures of one key in a row before the next one gets its turn."""


class Update(NamedTuple):
    """A value to put into the store; an empty path patches the whole model."""

    path: str
    value: Any


class ModelPlan:
    """The order of ``M409`` requests, from what is known and what has failed.

    First the counters (``seqs``), the names of the keys, and every key once; then the live root
    again and again, and each key whose counter moved. A counter is taken before its key is
    asked for, so that a change in between is seen as one.
    """

    def __init__(self) -> None:
        self.restart()

    def restart(self) -> None:
        """Begin anew, as with a board that was reset."""
        self._request: ModelRequest | None = None
        self._counters: Mapping[str, Any] | None = None
        self._asked: dict[str, Any] = {}
        self._keys: list[str] | None = None
        self._fetched: set[str] = set()
        self._wanted: list[str] = []
        self._fetch: Fetch | None = None
        self._asks_live = False
        self._live = LiveRound()
        self.too_large = TooLarge()
        self._split: dict[str, int] = {}
        self._refused = 0
        self._since_live = 0
        self._failures = 0
        self._short = 0

    @property
    def ready(self) -> bool:
        """Whether every key was fetched at least once since the beginning or a reset."""
        return self._keys is not None and self._fetched.issuperset(self._keys)

    @property
    def behind(self) -> bool:
        """Whether something waits to be fetched, apart from live values."""
        return self._keys is None or bool(self._wanted)

    @property
    def is_amid(self) -> bool:
        """Whether what is asked next belongs to what has just come, and is to follow at once."""
        return self._live.is_amid

    @property
    def live_keys(self) -> tuple[str, ...]:
        """The keys by which live values come one by one, none where they come as a whole."""
        return self._live.keys

    @property
    def short_of_buffers(self) -> int:
        """How many times in a row the board had no room for its answer."""
        return self._short

    def next_request(self) -> Request:
        """Return what to ask now; the same again until it was answered or given up."""
        if self._request is None:
            self._request = self._choose()
        return self._request

    def _choose(self) -> ModelRequest:
        if self._counters is None:
            return ModelRequest(SEQS, LIVE_FLAGS)
        if self._keys is None:
            return ModelRequest("", OUTLINE_FLAGS)
        self._asks_live = self._since_live >= FETCHES_BETWEEN_LIVE or not self._wanted
        if not self._asks_live:
            if self._fetch is None:
                key = self._wanted[0]
                self._fetch = self._new_fetch(key)
                self._asked[key] = self._counter(key)
            return self._fetch.request
        return self._live.request(self._fetched)

    def take(self, reply: ModelReply) -> list[Update]:
        """Take the answer to ``next_request``; return what it adds to the model."""
        self._request = None
        self._failures = self._short = 0
        if self._counters is None:
            self._counters = reply.result if isinstance(reply.result, dict) else {}
            return [Update("", {SEQS: self._counters})]
        if self._keys is None:
            return self._take_outline(reply.result)
        if self._fetch is not None and not self._asks_live:
            return self._take_key(self._fetch, reply)
        self._since_live = 0
        for key in self.too_large.tick():
            self._want(key)
        members = self._live.take(reply)
        return [] if members is None else [Update("", members)]

    def failed(self) -> None:
        """Note that ``next_request`` brought nothing that could be used; it will be asked again.

        Where one key fails again and again the others get their turn, and so do keys that wait
        where live values fail.
        """
        self._request = None
        self._failures += 1
        if self._failures < PATIENCE:
            return
        self._failures = 0
        if self._fetch is not None and not self._asks_live:
            self._wanted.append(self._wanted.pop(0))
            self._fetch = None
            self._since_live = FETCHES_BETWEEN_LIVE
        else:
            self._live.failed()
            self._since_live = 0

    def no_buffers(self) -> list[Update]:
        """Note ``{"err":-1}``: once may be chance, twice in a row calls for smaller requests.

        Returns what a key's last member that can't be had leaves of it.
        """
        self._request = None
        fetch = None if self._asks_live else self._fetch
        if self._asks_live and self._live.is_trial:
            self._live.no_room()
            return []
        if fetch is not None and fetch.path in self.too_large:
            return self._go_without(fetch)
        if fetch is not None and fetch.key in self._split and fetch.split():
            return []
        self._short += 1
        if self._short < 2:
            return []
        if fetch is not None:
            if fetch.split():
                self._split[fetch.key] = 0
                return []
            return self._has_no_room(fetch)
        # where there is no room for anything no key is to blame
        self._refused = 0
        if self._keys is not None and not self._live.no_room():
            self.failed()
        return []

    def _has_no_room(self, fetch: Fetch) -> list[Update]:
        """Note that a part of a key that can't be split has no room; live values tell who has."""
        self._refused += 1
        self._since_live = FETCHES_BETWEEN_LIVE
        self._short = 0 if self._refused > 1 else self._short
        return self._go_without(fetch) if self._refused >= PATIENCE else []

    def _go_without(self, fetch: Fetch) -> list[Update]:
        self._refused = self._short = 0
        self.too_large.note(fetch.path)
        if fetch.path != fetch.key:
            return self._finished(fetch) if fetch.skip() else []
        self._fetch = None
        self._wanted.remove(fetch.key)
        self._fetched.add(fetch.key)
        return []

    def _new_fetch(self, key: str) -> Fetch:
        """Return what asks for a key: in parts at once where that was needed last."""
        in_parts = key in self._split and self._split[key] % WHOLE_EVERY < WHOLE_EVERY - 1
        if key in self._split:
            self._split[key] += 1
        return Fetch(key, in_parts=in_parts, without=self.too_large.resting_of(key))

    def again(self, updates: list[Update]) -> None:
        """Note that what was just taken doesn't count: live values tell it again, and first."""
        for path, value in updates:
            if path:
                self._want(path)
            else:
                self._live.again(value)
        self._since_live = FETCHES_BETWEEN_LIVE

    def observe(self, model: Mapping[str, Any]) -> None:
        """Look at the counters after a change, and want each key that has another."""
        counters = model.get(SEQS)
        if isinstance(counters, dict) and counters is not self._counters:
            self._counters = counters
            for key in self._keys or ():
                if key in self._asked and self._asked[key] != self._counter(key):
                    self._want(key)

    def refetch(self, key: str = "") -> None:
        """Want a key again, or every one."""
        for name in self._keys or ():
            if key in ("", name):
                self.too_large.wake(name)
                self._want(name)

    def _take_outline(self, outline: Any) -> list[Update]:
        """Learn the names of the keys; the firmware says them all, verbose ones too."""
        names = [name for name in outline if name != SEQS] if isinstance(outline, dict) else []
        if not names:
            self._keys = [key for key in LIVE_KEYS if key != SEQS]
        else:
            self._keys = sorted(names, key=lambda name: (name not in FIRST, _place(name)))
        self._wanted = list(self._keys)
        return []

    def _take_key(self, fetch: Fetch, reply: ModelReply) -> list[Update]:
        self._refused = 0
        return self._finished(fetch) if fetch.take(reply) else []

    def _finished(self, fetch: Fetch) -> list[Update]:
        self.too_large.came(fetch.key, fetch.left_out)
        self._fetch = None
        self._wanted.pop(0)
        self._fetched.add(fetch.key)
        self._since_live += 1
        if self._asked[fetch.key] != self._counter(fetch.key):
            self._want(fetch.key)
        return [Update(fetch.key, fetch.value)]

    def _want(self, key: str) -> None:
        if key not in self._wanted and not self.too_large.rests(key):
            self._wanted.append(key)

    def _counter(self, key: str) -> Any:
        """Return what tells whether a key changed; files on a card count by themselves."""
        counters = self._counters or {}
        if key == "volumes":
            return counters.get(key), counters.get("volChanges")
        return counters.get(key)


def _place(key: str) -> int:
    return FIRST.index(key) if key in FIRST else len(FIRST)
