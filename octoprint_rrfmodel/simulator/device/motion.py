"""The movement queue: what is queued, where the axes are at any moment, how long a move takes."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from ..core import Core


class Move(NamedTuple):
    """A queued move: machine coordinates of its two ends, extruder positions, and its times."""

    start: float
    end: float
    begin: Sequence[float]
    target: Sequence[float]
    extruded: Sequence[float]
    """Extrusion of each extruder in mm."""
    speed: float
    """mm/s"""
    acceleration: float


class Motion:
    """Takes moves, and lets the model's positions follow them in simulated time."""

    def __init__(self, board: Core):
        self._board = board
        self._moves: deque[Move] = deque()
        self._target: list[float] = []
        self._extruded_done: list[float] = []
        self.last_code: int | None = None
        """G number that a line of bare coordinates continues on a CNC machine."""
        self.cold_reported = False
        self.virtual_e = 0.0

    @property
    def axes(self) -> list[dict[str, Any]]:
        axes: list[dict[str, Any]] = self._board.data["move"]["axes"]
        return axes

    @property
    def extruders(self) -> list[dict[str, Any]]:
        return self._board.data["move"].get("extruders") or []

    @property
    def is_moving(self) -> bool:
        return bool(self._moves)

    @property
    def is_full(self) -> bool:
        return len(self._moves) >= self._board.queue_length

    @property
    def next_end(self) -> float:
        """When the move under way ends; infinity while nothing moves."""
        return self._moves[0].end if self._moves else math.inf

    def target(self) -> list[float]:
        """Return the machine coordinates where the queue ends."""
        if not self._moves or not self._target:
            self._target = [float(axis["machinePosition"]) for axis in self.axes]
        return list(self._target)

    def queue(
        self,
        target: Sequence[float],
        extruded: Sequence[float],
        feed: float,
        seconds: float | None = None,
    ) -> None:
        """Append a move to ``target``; ``feed`` in mm/s, or the time it takes."""
        begin = self.target()
        distance = math.dist(begin, target) or sum(abs(amount) for amount in extruded)
        if not distance and seconds is None:
            return
        speed = self._limited(begin, target, distance, feed)
        if seconds is None:
            seconds = distance / speed
        now = self._board.now
        start = max(now, self._moves[-1].end if self._moves else now)
        acceleration = float(self.axes[0].get("acceleration") or 1000.0) if self.axes else 1000.0
        self._moves.append(
            Move(start, start + seconds, begin, list(target), extruded, speed, acceleration)
        )
        self._target = list(target)

    def _limited(
        self, begin: Sequence[float], target: Sequence[float], distance: float, feed: float
    ) -> float:
        """Return the feed under the maximum speeds of the axes that move."""
        speed = max(feed, 0.1)
        for axis, old, new in zip(self.axes, begin, target):
            part = abs(new - old)
            if part:
                speed = min(speed, float(axis["speed"]) / 60 * distance / part)
        return speed

    def follow(self, now: float) -> None:
        """Drop the moves that have ended, leaving their end positions in the model."""
        moves = self._moves
        while moves and moves[0].end <= now:
            move = moves.popleft()
            self._place(move.target)
            self._extrude(move.extruded, 1.0)

    def show(self, now: float) -> None:
        """Put the positions and the current move into the model."""
        move = self._moves[0] if self._moves else None
        if move is not None:
            part = min(1.0, max(0.0, (now - move.start) / (move.end - move.start or 1.0)))
            self._place([a + (b - a) * part for a, b in zip(move.begin, move.target)])
            self._extrude(move.extruded, part)
        self._show_current(move)
        self._show_user_positions()
        self._board.data["move"]["virtualEPos"] = self.virtual_e

    def _place(self, position: Sequence[float]) -> None:
        for axis, value in zip(self.axes, position):
            axis["machinePosition"] = value

    def _extrude(self, amounts: Sequence[float], part: float) -> None:
        done = self._extruded_done or [0.0] * len(amounts)
        for index, amount in enumerate(amounts):
            if amount and index < len(self.extruders):
                more = amount * part - done[index]
                extruder = self.extruders[index]
                extruder["position"] += more * float(extruder.get("factor") or 1.0)
                extruder["rawPosition"] += more
        self._extruded_done = [] if part >= 1.0 else [amount * part for amount in amounts]

    def _show_current(self, move: Move | None) -> None:
        current = self._board.data["move"]["currentMove"]
        speed = move.speed if move else 0.0
        acceleration = move.acceleration if move else 0.0
        current["acceleration"] = current["deceleration"] = acceleration
        current["requestedSpeed"] = current["topSpeed"] = speed
        if "extrusionRate" in current:
            amount = sum(move.extruded) if move else 0.0
            current["extrusionRate"] = amount / (move.end - move.start) if amount and move else 0.0

    def _show_user_positions(self) -> None:
        for index, axis in enumerate(self.axes):
            axis["userPosition"] = axis["machinePosition"] - self.offset(index)

    def offset(self, index: int) -> float:
        """Return what is added to a user coordinate of that axis to get the machine coordinate."""
        move = self._board.data["move"]
        axis = self.axes[index]
        workplaces = axis.get("workplaceOffsets") or [0.0]
        offset = float(workplaces[min(move.get("workplaceNumber") or 0, len(workplaces) - 1)])
        tool = self._board.current_tool()
        if tool is not None and index < len(tool.get("offsets") or ()):
            offset -= tool["offsets"][index]
        return offset + float(axis.get("babystep") or 0.0)

    def jump(self, position: dict[int, float]) -> None:
        """Set machine coordinates without a move (G92, homing)."""
        self._target = self.target()
        for index, value in position.items():
            self.axes[index]["machinePosition"] = self._target[index] = value

    def stop(self) -> None:
        """Drop the whole queue where it is, as an emergency stop does."""
        self.show(self._board.now)
        self._moves.clear()
        self._extruded_done = []
