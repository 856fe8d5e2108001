"""The movement queue: what is queued, where the axes are at any moment, how long a move takes."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Container, Sequence
from typing import Any

from ..clock import Clock
from ..firmware import Firmware
from ..hardware.planning import Move, append, append_timed, drives_of
from ..model.tree import ObjectModel

LONG_QUEUE, SHORT_QUEUE = 2.0, 0.5
"""Seconds of waiting moves from which the queue takes no more."""
RETURN_SPEED = 100.0
"""mm/s"""
LONGEST_SLEEP, AHEAD = 0.5, 0.1
"""Seconds for which firmware that doesn't look for room sleeps, and how early it wakes."""


class Motion:
    """Takes moves, and lets the model's positions follow them in simulated time."""

    def __init__(self, model: ObjectModel, clock: Clock, firmware: Firmware):
        self._model = model
        self._clock = clock
        self._firmware = firmware
        self.restart()

    def restart(self) -> None:
        self._moves: deque[Move] = deque()
        self._began_crowded: Move | None = None
        """The move in front of others that had no room any more before it began."""
        self._target: list[float] = []
        self._extruded_done: list[float] = []
        self.last_code: int | None = None
        """G number that a line of bare coordinates continues on a CNC machine."""
        self.virtual_e = 0.0

    @property
    def axes(self) -> list[dict[str, Any]]:
        axes: list[dict[str, Any]] = self._model.data["move"]["axes"]
        return axes

    @property
    def extruders(self) -> list[dict[str, Any]]:
        return self._model.data["move"].get("extruders") or []

    def axis_index(self, letter: str) -> int | None:
        """Return the index of the axis of that letter; ``None`` without one."""
        for index, axis in enumerate(self.axes):
            if axis["letter"] == letter:
                return index
        return None

    def named_axes(self, letters: Container[str]) -> list[int]:
        """Return the indexes of the axes whose letters are among these."""
        return [index for index, axis in enumerate(self.axes) if axis["letter"] in letters]

    @property
    def is_delta(self) -> bool:
        return "elta" in str((self._model.data["move"].get("kinematics") or {}).get("name"))

    @property
    def is_homed(self) -> bool:
        """Whether all axes are."""
        return all(axis["homed"] for axis in self.axes)

    @property
    def is_moving(self) -> bool:
        return bool(self._moves)

    def has_stopped(self) -> bool:
        """Return whether the queue has run empty, as a condition to wait for."""
        return not self._moves

    @property
    def is_full(self) -> bool:
        """Whether a further move has to wait.

        One move waits in front of the queue, and the queue takes another while what isn't under
        way yet takes less than 2 s, or less than 0.5 s besides its first move (RRF 3.5
        DDARing.cpp, CanAddMove; seen in firmware).
        """
        if len(self._moves) >= self._model.queue_length:
            return True
        begun = 0 if self._is_asleep() else 1
        return self._is_crowded(list(self._moves)[begun:-1])

    def _is_crowded(self, waiting: Sequence[Move]) -> bool:
        seconds = [move.seconds for move in waiting]
        return sum(seconds) >= LONG_QUEUE and sum(seconds[1:]) >= SHORT_QUEUE

    def _is_asleep(self) -> bool:
        """Return whether the first move has begun without anybody looking for room since.

        3.6 sleeps when it has begun a move with a full queue behind it, until it is time to
        prepare the next or for half a second (RRF 3.6 Move.cpp, MoveLoop; seen in firmware).
        """
        first = self._began_crowded
        if first is None or self._firmware.fills_queue_at_once:
            return False
        if not self._moves or self._moves[0] is not first:
            self._began_crowded = None
            return False
        return self._clock.now < first.start + min(LONGEST_SLEEP, first.seconds - AHEAD)

    def has_room(self) -> bool:
        """Return whether the queue takes another move, as a condition to wait for."""
        return not self.is_full

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
        *,
        origin: int | None = None,
    ) -> None:
        """Append a move to ``target``; ``feed`` in mm/s, or the time it takes."""
        begin = self.target()
        if seconds is None and list(target) == begin and not any(extruded):
            return
        now = self._clock.now
        move = Move(begin, list(target), extruded, feed, origin)
        if seconds is None:
            append(self._moves, move, drives_of(self.axes, self.extruders), now)
        else:
            append_timed(self._moves, move, seconds, now)
        self._target = list(target)
        first = self._moves[0]
        if first.start > now and self._is_crowded(list(self._moves)[:-1]):
            self._began_crowded = first

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
            part = min(1.0, max(0.0, (now - move.start) / (move.seconds or 1.0)))
            self._place([a + (b - a) * part for a, b in zip(move.begin, move.target)])
            self._extrude(move.extruded, part)
        self._show_current(move)
        self._show_user_positions()
        self._model.data["move"]["virtualEPos"] = self.virtual_e

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
        current = self._model.data["move"]["currentMove"]
        speed = move.speed if move else 0.0
        acceleration = move.acceleration if move else 0.0
        current["acceleration"] = current["deceleration"] = acceleration
        current["requestedSpeed"] = current["topSpeed"] = speed
        if "extrusionRate" in current:
            amount = sum(move.extruded) if move else 0.0
            current["extrusionRate"] = amount / move.seconds if amount and move else 0.0

    def _show_user_positions(self) -> None:
        for index, axis in enumerate(self.axes):
            axis["userPosition"] = axis["machinePosition"] - self.offset(index)

    def offset(self, index: int) -> float:
        """Return what is added to a user coordinate of that axis to get the machine coordinate."""
        move = self._model.data["move"]
        axis = self.axes[index]
        workplaces = axis.get("workplaceOffsets") or [0.0]
        offset = float(workplaces[min(move.get("workplaceNumber") or 0, len(workplaces) - 1)])
        tool = self._model.current_tool()
        if tool is not None and index < len(tool.get("offsets") or ()):
            offset -= tool["offsets"][index]
        return offset + float(axis.get("babystep") or 0.0)

    def jump(self, position: dict[int, float]) -> None:
        """Set machine coordinates without a move (G92, homing)."""
        self._target = self.target()
        for index, value in position.items():
            self.axes[index]["machinePosition"] = self._target[index] = value

    def go_back(self, target: Sequence[float]) -> None:
        """Move to where the axes have been before, as fast as they may."""
        if len(target) == len(self.axes):
            self.queue(target, [0.0] * len(self.extruders), RETURN_SPEED)

    def drop_waiting(self) -> int | None:
        """Drop the print's moves that haven't begun; return where in the file the first is from."""
        now = self._clock.now
        first = None
        while self._moves and self._moves[-1].start > now and self._moves[-1].origin is not None:
            move = self._moves.pop()
            first, self._target = move.origin, list(move.begin)
        return first

    def stop(self) -> None:
        """Drop the whole queue where it is, as an emergency stop does."""
        self.show(self._clock.now)
        self._moves.clear()
        self._extruded_done = []

    def lose_position(self) -> None:
        """Stop where the axes are; nobody knows where that is."""
        self.stop()
        for axis in self.axes:
            axis["homed"] = False
        self._model.bump("move")

    def save_restore_point(self, index: int) -> None:
        """Keep position and tool, as the model shows them, in ``state.restorePoints``."""
        state = self._model.data["state"]
        points = state.get("restorePoints") or []
        if 0 <= index < len(points):
            points[index]["coords"] = [axis["userPosition"] for axis in self.axes]
            points[index]["toolNumber"] = state["currentTool"]
            self._model.bump("state")
