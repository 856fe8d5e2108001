"""What would pause or end a print is believed when a second answer says so, or a line of text.

A line over USB has no checksum in this direction: one flipped bit in one live reply is a heater's
fault, or an up-time that goes back.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..views.warnings import RESET, faults

MOST_DOUBTS = 3
"""Replies in a row that are doubted; if each tells something else it is the machine after all."""

TOLD_FOR = 5
"""Replies for which a line of the firmware's own text counts as the first answer."""

LEAP_SECONDS = 10.0
"""By how much an up-time has to be ahead to be taken for a spoilt one where the next is near the
one before it."""

NEAR_SECONDS = 3.0

Alarm = tuple[str, tuple[int, ...]]
"""Code and last number of a fault. The number before it, a board's, is its place until the key that
has its address is known: the same fault would be a new one with each answer about that key."""

RESET_ALARM: Alarm = (RESET.code, ())


class Doubts:
    """Looks at each model before it counts, beside the one that does."""

    def __init__(self) -> None:
        self._alarms: frozenset[Alarm] = frozenset()
        self._in_a_row = 0
        self._told = 0
        self._before: float | None = None
        self._last: float | None = None

    def told(self) -> None:
        """Note that the firmware has said by itself that something is wrong."""
        self._told = TOLD_FOR

    def is_doubtful(self, old: Mapping[str, Any], new: Mapping[str, Any]) -> bool:
        """Return whether a model tells of something bad for the first time: ask again."""
        alarms = _alarms(new) - _alarms(old)
        if self._goes_back(new):
            alarms |= {RESET_ALARM}
        is_new = not alarms <= self._alarms
        if is_new and not self._told and self._in_a_row < MOST_DOUBTS:
            self._alarms = alarms
            self._in_a_row += 1
            return True
        self._alarms, self._in_a_row = frozenset(), 0
        self._told = max(0, self._told - 1)
        return False

    def is_reset(self, model: Mapping[str, Any]) -> bool:
        """Return whether a model that is believed shows a reset; it counts from now on.

        After a reset the up-time is below the last one seen (Duet3D/Connectors, PollConnector),
        unless that was the spoilt one: then it is not below the one before.
        """
        now = _up_time(model)
        if now is None:
            return False
        was_reset = self._goes_back(model) and not self._follows_the_one_before(now)
        if not self._goes_back(model):
            self._before = self._last
        self._last = now
        if was_reset:
            self._before = None
        return was_reset

    def _goes_back(self, model: Mapping[str, Any]) -> bool:
        now = _up_time(model)
        return now is not None and self._last is not None and now < self._last

    def _follows_the_one_before(self, now: float) -> bool:
        if self._before is None or self._last is None:
            return False
        leaps = self._last - self._before > LEAP_SECONDS
        return now >= self._before - (NEAR_SECONDS if leaps else 0.0)


def _alarms(model: Mapping[str, Any]) -> frozenset[Alarm]:
    return frozenset((fault.code, fault.numbers[-1:]) for fault in faults(model))


def _up_time(model: Mapping[str, Any]) -> float | None:
    state = model.get("state")
    value = state.get("upTime") if isinstance(state, Mapping) else None
    return value if type(value) in (int, float) else None
