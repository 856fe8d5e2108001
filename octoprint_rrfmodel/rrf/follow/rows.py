"""The model followed by small parts, on a line whose time is dear.

Each part is a row with its age. The guard's come when they are due. Of the others the one that is
most overdue by its own measure comes as soon as the line's share for asking is paid off, so that
in the end each has its turn.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Callable

from ..model.columns import OtherElements, laid
from ..views.machine import Machine, mapping
from ..wire.reply import ModelReply
from ..wire.request import ModelRequest
from .freshness import (
    BOX,
    DECIDING_SECONDS,
    FREE_GUARD_SECONDS,
    GUARD_SECONDS,
    OPEN_BOX_SECONDS,
)
from .interest import Interest
from .parts import parts_of, told
from .row import CHANGED_FLAGS, Row, is_short, live_rows

AROUND_BYTES = 31
"""Bytes around key and answer: the rest of the request with number and checksum, and the ok."""

GAP_SECONDS = 0.05
"""Shortest time between two: by then a line of the print is on its way."""

MOST_DEBT_SECONDS = 5.0
"""Time for which the guard's needs may hold back all others where they take more than the share."""

TURN_SECONDS = 20.0
"""Where there isn't time for all, even what is wanted least gains so on what is wanted most."""

WHOLE_SECONDS = 300.0
"""Between two answers of all that is live, where the line is free."""

ALL_SECONDS = 4.0
"""The same while somebody looks at all of it."""

CUT_SECONDS = 120.0
"""Time after which the model is cut into parts anew: they may have grown."""

PATIENCE = 3
"""Failures in a row of one that the guard needs before the others have their turn."""


class Rows:
    """Chooses the part to ask for; ``clock`` is the time, ``interest`` who looks at what."""

    def __init__(self, clock: Callable[[], float], interest: Interest | None = None) -> None:
        self._clock = clock
        self._interest = interest or Interest(clock)
        self._bytes_a_second = 0.0
        self._share = 1.0
        self.is_free = False
        """Whether a long answer does no harm."""
        self.restart()

    def restart(self) -> None:
        """Know no parts: of another board, or of one that began anew."""
        self._live: list[Row] = []
        self._changed: dict[str, list[Row]] = {}
        self._asked: Row | None = None
        self._first: Row | None = None
        self._cut_at: float | None = None
        self._refused: set[str] = set()
        self._lengths: dict[str, int] = {}
        self._failures = 0
        self._box_is_open = self._prints = False
        self._whole_at: float | None = None
        self._begun = self._paid_at = self._ended_at = self._clock()

    def spare(self, bytes_a_second: float, share: float = 1.0, is_free: bool = False) -> None:
        """Ask for parts on a line that is so fast, and take no more than that share of it.

        ``is_free`` where no print waits for the line: what is long may be asked for, too.
        """
        self._bytes_a_second = bytes_a_second
        self._share = share
        if is_free and not self.is_free:
            # a print is over, or pauses: much may be other than it was
            self._whole_at = None
        self.is_free = is_free

    @property
    def is_on(self) -> bool:
        """Whether the model is to be asked for by parts."""
        return self._bytes_a_second > 0

    @property
    def paths(self) -> tuple[str, ...]:
        """The parts of what changes all the time."""
        return tuple(row.path for row in self._live) if self.is_on else ()

    @property
    def guarded(self) -> tuple[str, ...]:
        """Those of them that the guard needs."""
        return tuple(row.path for row in self._live if row.is_guarded) if self.is_on else ()

    @property
    def waiting(self) -> tuple[str, ...]:
        """Keys of which a part has changed and isn't known yet."""
        changed = self._changed.items() if self.is_on else ()
        return tuple(key for key, rows in changed if any(row.changed_at for row in rows))

    @property
    def behind(self) -> bool:
        """Whether something has changed that decides about commands, and isn't known yet."""
        return self.is_on and any(
            row.changed_at is not None and self._aim(row) <= DECIDING_SECONDS
            for rows in self._changed.values()
            for row in rows
        )

    ##~~ what to ask

    @property
    def wants_whole(self) -> bool:
        """Whether all live values are to come at once."""
        at = self._whole_at
        seconds = ALL_SECONDS if self._interest.looks_at_all else WHOLE_SECONDS
        return self.is_free and (at is None or self._clock() - at >= seconds)

    def request(self, model: Mapping[str, Any]) -> ModelRequest:
        """Return what to ask now."""
        now = self._clock()
        self._box_is_open = bool(mapping(model.get("state")).get("messageBox"))
        self._prints = Machine(model).prints
        if self._cut_at is None or now - self._cut_at > CUT_SECONDS:
            self._cut(model, now)
        row = self._first or self._next(now)[0]
        self._asked, self._first = row, None
        row.tried_at = now
        return row.request

    def wait(self) -> float:
        """Return the seconds until the next one is due."""
        now = self._clock()
        if self._first is not None or not self._live or self.wants_whole:
            return GAP_SECONDS
        return max(GAP_SECONDS, self._next(now)[1] - now)

    def _next(self, now: float) -> tuple[Row, float]:
        """Return the row that is next, and when."""
        soonest = self._ended_at + GAP_SECONDS
        guarded, guarded_at = self._first_due(
            [row for row in self._live if row.is_guarded], max(soonest, now)
        )
        paid_at = max(soonest, min(self._paid_at, now + MOST_DEBT_SECONDS), now)
        other, other_at = self._first_due(list(self._others()), paid_at)
        if other is None or (guarded is not None and guarded_at <= other_at):
            assert guarded is not None
            return guarded, guarded_at
        return other, other_at

    def _first_due(self, rows: list[Row], soonest: float) -> tuple[Row | None, float]:
        """Return the row that is most overdue at a time, or due first after it, and when."""
        if not rows:
            return None, soonest
        due = [row for row in rows if self._due_at(row) <= soonest]
        if due:
            return max(due, key=lambda row: self._overdue(row, soonest)), soonest
        row = min(rows, key=self._due_at)
        return row, self._due_at(row)

    def _others(self) -> Iterable[Row]:
        yield from (row for row in self._live if not row.is_guarded)
        for rows in self._changed.values():
            yield from (row for row in rows if row.changed_at is not None)

    def _aim(self, row: Row) -> float:
        if row.is_guarded:
            if row.path == BOX and self._box_is_open:
                return OPEN_BOX_SECONDS
            return FREE_GUARD_SECONDS if self.is_free else GUARD_SECONDS
        is_looked_at = self._interest.looks_at(row.path) or (
            # a host shows it as its own print
            self._prints and row.path.startswith("job")
        )
        return row.aims.looked_at if is_looked_at else row.aims.unseen

    def _begun_at(self, row: Row) -> float:
        """Return from when on its age counts; what never was asked for is overdue at once."""
        known = [at for at in (row.tried_at, row.changed_at) if at is not None]
        return max(known) if known else self._begun - self._aim(row)

    def _due_at(self, row: Row) -> float:
        begun_at = self._begun_at(row)
        return begun_at if row.is_changed else begun_at + self._aim(row)

    def _overdue(self, row: Row, now: float) -> float:
        """Return how much a row needs its turn: by its own measure, and by the time it waits."""
        age = now - self._begun_at(row)
        aim = self._aim(row)
        decides = row.is_changed and aim <= DECIDING_SECONDS
        return age / aim + age / TURN_SECONDS + row.is_changed + decides

    ##~~ what has come of it

    def take(self, reply: ModelReply, model: Mapping[str, Any]) -> dict[str, Any]:
        """Return what an answer lays over the model; raises ``OtherElements``."""
        row = self._asked
        assert row is not None
        self._failures = 0
        if reply.result is None and told(row.path, row.flags, model) is not None:
            # of a version that hasn't got it in this form
            self._refuse(row)
            return {}
        if reply.next:
            raise OtherElements(row.path)
        row.changed_at = None
        if isinstance(reply.result, list):
            self._lengths[row.path] = sum(value is not None for value in reply.result)
        return laid(row.path, reply.result, model)

    def spent(self, length: int, request: ModelRequest) -> None:
        """Note the length of an answer: the line is to be left alone for its share."""
        now = self._clock()
        seconds_taken = (length + len(request.key) + AROUND_BYTES) / self._bytes_a_second
        self._ended_at = now
        self._paid_at = max(self._paid_at, now - seconds_taken) + seconds_taken / self._share
        self._paid_at = min(self._paid_at, now + 2 * MOST_DEBT_SECONDS)

    def failed(self) -> None:
        """Note that the row brought nothing: one of the guard's is asked for again."""
        self._ended_at = self._clock()
        self._failures += 1
        row = self._asked
        if row is not None and row.is_guarded and self._failures < PATIENCE:
            self._first = row

    def came(self, path: str, elements: int) -> bool:
        """Note that a column was told unasked, of so many elements; return whether of all."""
        if not self.is_on:
            return False
        rows = [row for row in self._live if row.path == path]
        is_whole = bool(rows) and elements >= self._lengths.get(path, 0) > 0
        for row in rows:
            if is_whole:
                row.tried_at = self._clock()
        return is_whole

    def again(self) -> None:
        """Ask once more for what has just come."""
        self._first = self._asked

    def whole_came(self) -> None:
        """Note that all live values have come at once."""
        now = self._ended_at = self._whole_at = self._clock()
        for row in self._live:
            row.tried_at = now

    def key_came(self, key: str) -> None:
        """Note that a key was fetched, and no part of it is wanted any more."""
        for row in self._changed.get(key, ()):
            row.changed_at = None

    def hurry(self) -> None:
        """Ask for all that the guard needs, or for all that is live: something has happened."""
        self._whole_at = None
        for row in self._live:
            if row.is_guarded:
                row.tried_at = None

    def changed(self, key: str, model: Mapping[str, Any]) -> None:
        """Note that a key's counter has moved: each part of it is asked for once."""
        now = self._clock()
        if key not in self._changed:
            parts = parts_of(key, CHANGED_FLAGS, model)
            rows = [Row(path, CHANGED_FLAGS) for path in parts if is_short(path, model)]
            # another one each time: other threads look at it
            self._changed = {**self._changed, key: rows}
        for row in self._changed[key]:
            if row.changed_at is None and row.path not in self._refused:
                row.changed_at = now

    def torn(self, key: str) -> None:
        """Note that a key is built otherwise than it was."""
        self._cut_at = None
        self._changed = {name: rows for name, rows in self._changed.items() if name != key}

    def _refuse(self, row: Row) -> None:
        self._refused.add(row.path)
        self._live = [each for each in self._live if each is not row]
        row.changed_at = None

    ##~~ the parts

    def _cut(self, model: Mapping[str, Any], now: float) -> None:
        self._cut_at = now
        before = {row.request: row for row in self._live}
        rows = [row for row in live_rows(model) if row.path not in self._refused]
        self._live = [before.get(row.request, row) for row in rows]
