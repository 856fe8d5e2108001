"""How long the layers of a job took that the board runs from its card.

All firmware from 3.3 on tells ``job.layer``, ``job.layerTime`` (a tenth of a second, without
pauses) and ``job.duration`` (whole seconds, without pauses); ``M408`` may lack the second.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping
from typing import Any, NamedTuple

from .event_facts import Facts, facts_of
from .events import COMPLETE_FROM
from .machine import array, mapping

MOST_LAYERS = 5000

MOST_AT_ONCE = 10
"""Layers that may end between two replies; a number further on is taken for a broken digit."""


class Layer(NamedTuple):
    """A layer that is through; ``None`` stands for what isn't known."""

    layer: int
    seconds: float
    height: float | None
    """User position of Z in mm, when the layer was seen last."""
    filament: float | None
    """Millimetres that were fed."""
    at: float
    """When its end was seen."""


class Seen(NamedTuple):
    """What one model tells of the layer under way."""

    layer: int
    """0 before the first one."""
    at: float
    time: float | None
    """Seconds since the layer's beginning."""
    duration: float | None
    height: float | None
    extrusion: float | None


class Layers:
    """Keeps the layers of the job that is under way, or of the last one.

    Outlives a connection: the board prints on without. ``now`` is the time of day in seconds.
    """

    def __init__(self) -> None:
        self.began_at: float | None = None
        """When the job was seen first; ``None`` before the first one."""
        self._done: deque[Layer] = deque(maxlen=MOST_LAYERS)
        self._facts = Facts()
        self._number: int | None = None
        self._first: Seen | None = None
        self._last: Seen | None = None
        self._is_whole = False

    def look(self, model: Mapping[str, Any], now: float) -> None:
        """Take what a model tells."""
        before, self._facts = self._facts, facts_of(model, self._facts)
        job = self._facts.job
        if job is None or job.number != self._number:
            if self._number is not None:
                self._end(before, now)
            self._number = None
            if job is None:
                return
            self._begin(job.number, now)
        # without a status nothing says that what the model tells is of this job
        seen = _seen(model, now) if mapping(model.get("state")).get("status") else None
        if seen is not None:
            self._see(seen)

    def heard(self, line: str) -> None:
        """Take a line from the printer, which may say that the job has ended."""
        self._facts = self._facts.heard(line)

    def since(self, time: float = -math.inf) -> list[Layer]:
        """Return the layers whose end was seen later than a time."""
        return [layer for layer in self._done if layer.at > time]

    def _begin(self, number: int, now: float) -> None:
        self._number = number
        self.began_at = now
        self._done.clear()
        self._first = self._last = None

    def _end(self, before: Facts, now: float) -> None:
        """Take the layer that was the last, unless the job was broken off in it."""
        last = self._last
        if last is not None and last.layer and last.time is not None and _is_through(before):
            fed = self._fed(last.extrusion)
            self._done.append(Layer(last.layer, last.time, last.height, fed, now))

    def _see(self, seen: Seen) -> None:
        last = self._last
        if last is not None and _went_back(seen, last):
            # the same file once more, begun while nothing was heard from the board
            self._begin(self._number or 0, seen.at)
            last = None
        if last is None or seen.layer != last.layer:
            ended = seen.layer - last.layer if last is not None else 0
            if last is not None and last.layer and 0 < ended <= MOST_AT_ONCE:
                self._finish(last, seen)
            self._first = seen
            # of a layer that nobody saw begin only the firmware knows how long it has been on
            self._is_whole = 0 < ended <= (MOST_AT_ONCE if last is not None and last.layer else 1)
        self._last = seen

    def _finish(self, last: Seen, seen: Seen) -> None:
        """Take the layers up to the one that is seen now; several share time and filament."""
        count = seen.layer - last.layer
        seconds = self._seconds(last, seen)
        fed = self._fed(seen.extrusion)
        if seconds is None:
            return
        for layer in range(last.layer, seen.layer):
            part = None if fed is None else fed / count
            self._done.append(Layer(layer, seconds / count, last.height, part, seen.at))

    def _seconds(self, last: Seen, seen: Seen) -> float | None:
        """Return the job's time from the beginning of one layer to that of another."""
        if last.duration is None or seen.duration is None:
            return None
        # whole seconds of the job's own clock, made finer by ours where that says the same
        passed = seen.duration - last.duration
        passed = min(max(seen.at - last.at, passed - 1), passed + 1)
        if last.time is not None and seen.time is not None:
            return max(0.0, last.time + passed - seen.time)
        if self._first is None or self._first.duration is None or not self._is_whole:
            return None
        return max(0.0, seen.duration - self._first.duration)

    def _fed(self, extrusion: float | None) -> float | None:
        first = self._first.extrusion if self._first is not None and self._is_whole else None
        if first is None or extrusion is None:
            return None
        return max(0.0, extrusion - first)


def _is_through(facts: Facts) -> bool:
    job = facts.job
    if job is None or job.was_cancelling:
        return False
    if job.heard:
        return job.heard == "Finished"
    return job.progress is not None and job.progress >= COMPLETE_FROM


def _went_back(seen: Seen, last: Seen) -> bool:
    if seen.duration is None or last.duration is None:
        return False
    return seen.layer < last.layer and seen.duration < last.duration


def _seen(model: Mapping[str, Any], now: float) -> Seen | None:
    job = mapping(model.get("job"))
    layer = job.get("layer")
    if "layer" not in job or not (layer is None or type(layer) is int):
        return None
    axes = map(mapping, array(mapping(model.get("move")).get("axes")))
    return Seen(
        max(0, layer or 0),
        now,
        _real(job.get("layerTime")),
        _real(job.get("duration")),
        next((_real(axis.get("userPosition")) for axis in axes if axis.get("letter") == "Z"), None),
        _real(job.get("rawExtrusion")),
    )


def _real(value: Any) -> float | None:
    if type(value) not in (int, float) or not abs(value) < 1e9:
        return None
    return float(value)
