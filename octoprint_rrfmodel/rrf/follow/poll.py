"""What to ask the board next. Decides; sends nothing and knows no clock."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..model.columns import OtherElements
from ..wire.reply import ModelReply
from ..wire.request import LIVE_FLAGS, OUTLINE_FLAGS, ModelRequest, Request
from .fetch import Fetch
from .live import SEQS, LiveRound, counter_of, keys_of
from .rows import Rows
from .too_large import TooLarge, key_of
from .update import Update

FETCHES_BETWEEN_LIVE = 4
"""Keys fetched in a row before a live reply is due again."""

WHOLE_EVERY = 4
"""A key that was asked for in parts is tried as a whole again each so many times."""

PATIENCE = 3
"""Failures of one key in a row before the next one gets its turn."""


class ModelPlan:
    """The order of ``M409`` requests, from what is known and what has failed.

    First the counters (``seqs``), the names of the keys, and every key once; then the live root
    again and again, and each key whose counter moved. A counter is taken before its key is
    asked for, so that a change in between is seen as one. While ``rows`` are on, parts come in
    the place of the root, and of keys that moved; those are fetched when the line is free.
    """

    def __init__(self, rows: Rows) -> None:
        self._rows = rows
        self.restart()

    def restart(self) -> None:
        """Begin anew, as with a board that was reset."""
        self._rows.restart()
        self._request: ModelRequest | None = None
        self._counters: Mapping[str, Any] | None = None
        self._asked: dict[str, Any] = {}
        self._keys: list[str] | None = None
        self._fetched, self._torn = set[str](), set[str]()
        self._wanted: list[str] = []
        self._fetch: Fetch | None = None
        self._is_ready = self._asks_live = self._asks_row = False
        self._model: Mapping[str, Any] = {}
        self._live = LiveRound()
        self.too_large = TooLarge()
        self._split: dict[str, int] = {}
        self._refused = self._since_live = self._failures = self._short = 0

    @property
    def ready(self) -> bool:
        """Whether every key was fetched at least once since the beginning or a reset."""
        return self._keys is not None and self._fetched.issuperset(self._keys)

    @property
    def behind(self) -> bool:
        """Whether something waits to be fetched, apart from live values."""
        return self._keys is None or bool(self._to_fetch) or self._rows.behind

    @property
    def wanted(self) -> frozenset[str]:
        """Keys that are known to have changed, and wait to be fetched."""
        return frozenset(self._rows.waiting).union(self._to_fetch)

    @property
    def _to_fetch(self) -> set[str]:
        is_beside_a_print = self.is_sparing and not self._rows.is_free
        return self._torn.intersection(self._wanted) if is_beside_a_print else set(self._wanted)

    @property
    def is_sparing(self) -> bool:
        """Whether parts are asked for, one by one as they are needed."""
        return self._rows.is_on and self.ready

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
        if self.is_sparing:
            self._asks_live = self._rows.wants_whole
            self._asks_row = not self._asks_live and not (self._to_fetch and self._asks_row)
            if self._asks_row:
                return self._rows.request(self._model)
            if self._fetch is None:
                self._wanted.sort(key=lambda key: key not in self._torn)
        else:
            self._asks_row = False
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
            self._keys = keys_of(reply.result)
            self._wanted = list(self._keys)
            return []
        if self._asks_row:
            return self._take_row(reply)
        if self._fetch is not None and not self._asks_live:
            return self._take_key(self._fetch, reply)
        self._since_live = 0
        for key in self.too_large.tick():
            self._want(key)
        members = self._live.take(reply)
        self._rows.whole_came()
        return [] if members is None else [Update("", members)]

    def failed(self) -> None:
        """Note that ``next_request`` brought nothing that could be used; it will be asked again.

        Where one key fails again and again the others get their turn, and so do keys that wait
        where live values fail.
        """
        self._request = None
        if self._asks_row:
            self._rows.failed()
            return
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
        """Note ``{"err":-1}``, twice in a row a call for smaller requests; return what is left."""
        self._request = None
        if self._asks_row:
            self._short += 1
            self.failed()
            return []
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
        if fetch is not None and not fetch.split():
            return self._has_no_room(fetch)
        if fetch is not None:
            self._split[fetch.key] = 0
            return []
        # where there is no room for anything no key is to blame
        self._refused = 0
        if self._keys is not None and not self._live.no_room():
            self.failed()
        return []

    def _has_no_room(self, fetch: Fetch) -> list[Update]:
        """Note that what can't be split has no room; live values tell who has."""
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
        if self._asks_row:
            self._rows.again()
            return
        for path, value in updates:
            if path:
                self._want(path)
                self._fetched -= set() if self._is_ready else {path}
            else:
                self._live.again(value)
        self._since_live = FETCHES_BETWEEN_LIVE

    def observe(self, model: Mapping[str, Any]) -> None:
        """Look at the counters after a change, and want each key that has another."""
        self._model, self._is_ready = model, self.ready
        counters = model.get(SEQS)
        if isinstance(counters, dict) and counters is not self._counters:
            before = {key: self._counter(key) for key in self._asked}
            self._counters = counters
            for key in before:
                if self.is_sparing and before[key] != self._counter(key):
                    self._rows.changed(key, model)
                if self._asked[key] != self._counter(key):
                    self._want(key)

    def refetch(self, key: str = "") -> None:
        """Want a key again, or every one."""
        for name in self._keys or ():
            if key in ("", name):
                self.too_large.wake(name)
                self._want(name)
                self._rows.changed(name, self._model)

    def spare(self, bytes_a_second: float, share: float, is_free: bool) -> None:
        """Ask for parts (``Rows.spare``), or with 0 for whole answers."""
        was_sparing = self.is_sparing and not self._rows.is_free
        self._rows.spare(bytes_a_second, share, is_free)
        if self.is_sparing and not is_free and not was_sparing:
            self._request = self._fetch = None
            for key in self._wanted:
                self._rows.changed(key, self._model)

    def _take_row(self, reply: ModelReply) -> list[Update]:
        """Return what a part lays over the model; a key that is built otherwise is fetched."""
        try:
            return [Update("", self._rows.take(reply, self._model))]
        except OtherElements:
            key = key_of(reply.key)
            self._torn.add(key)
            self._rows.torn(key)
            self._want(key)
            return []

    def _take_key(self, fetch: Fetch, reply: ModelReply) -> list[Update]:
        self._refused = 0
        return self._finished(fetch) if fetch.take(reply) else []

    def _finished(self, fetch: Fetch) -> list[Update]:
        self.too_large.came(fetch.key, fetch.left_out)
        self._fetch = None
        self._wanted.pop(0)
        self._torn.discard(fetch.key)
        self._rows.key_came(fetch.key)
        self._fetched.add(fetch.key)
        self._since_live += 1
        if self._asked[fetch.key] != self._counter(fetch.key):
            self._want(fetch.key)
        return [Update(fetch.key, fetch.value)]

    def _want(self, key: str) -> None:
        if key not in self._wanted and not self.too_large.rests(key):
            self._wanted.append(key)

    def _counter(self, key: str) -> Any:
        return counter_of(key, self._counters or {})
