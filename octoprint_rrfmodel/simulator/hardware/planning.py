"""How long moves take: the speeds at which they begin and end, and the times that follow.

A move is planned as the firmware does it (RRF 3.5 DDA.cpp, InitStandardMove and DoLookahead):
a trapezoid under the limits of every drive, and where two moves meet no drive changes its speed
at once by more than its jerk.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

USUAL_ACCELERATION = 1000.0
START_DELAY = 0.06
"""Seconds from a move's coming in to its begin where nothing moves (seen in firmware)."""
NO_LIMIT = 1e6
SLOWEST = 0.1
"""mm/s"""


class Drive(NamedTuple):
    """What an axis or an extruder may do, in mm and seconds."""

    speed: float
    acceleration: float
    jerk: float
    pressure_advance: float = 0.0


def drives_of(axes: Iterable[dict[str, Any]], extruders: Iterable[dict[str, Any]]) -> list[Drive]:
    """Return the drives of the model's axes and, behind them, of its extruders."""
    found = [_drive(axis) for axis in axes]
    for extruder in extruders:
        advance = float(extruder.get("pressureAdvance") or 0.0)
        found.append(_drive(extruder)._replace(pressure_advance=advance))
    return found


def _drive(part: dict[str, Any]) -> Drive:
    return Drive(
        float(part.get("speed") or NO_LIMIT) / 60,
        float(part.get("acceleration") or USUAL_ACCELERATION),
        float(part.get("jerk") or 0.0) / 60,
    )


@dataclass
class Move:
    """A queued move: machine coordinates of its two ends, extruder positions, and its times."""

    begin: Sequence[float]
    target: Sequence[float]
    extruded: Sequence[float]
    """Extrusion of each extruder in mm."""
    speed: float
    """mm/s"""
    origin: int | None = None
    """Index of the line of a print file that it comes from."""
    length: float = 0.0
    parts: Sequence[float] = ()
    """Of each drive, how far it goes for 1 mm of the move."""
    is_printing: bool = False
    acceleration: float = USUAL_ACCELERATION
    joint: float = 0.0
    """Highest speed at which it may begin behind the move in front of it."""
    entry: float = 0.0
    exit: float = 0.0
    start: float = 0.0
    end: float = 0.0

    @property
    def seconds(self) -> float:
        return self.end - self.start

    def limit(self, drives: Sequence[Drive]) -> None:
        """Keep it under the limits of the drives that it moves."""
        ways = [b - a for a, b in zip(self.begin, self.target)]
        travel = math.hypot(*ways)
        self.length = travel or sum(abs(amount) for amount in self.extruded)
        self.parts = [way / self.length for way in [*ways, *self.extruded]]
        self.is_printing = any(ways[:2]) and any(amount > 0 for amount in self.extruded)
        acceleration, speed = math.inf, max(self.speed, SLOWEST)
        for drive, part in zip(drives, self.parts):
            if part:
                speed = min(speed, drive.speed / abs(part))
                acceleration = min(acceleration, drive.acceleration / abs(part))
                if self.is_printing and part > 0 and drive.pressure_advance and drive.jerk:
                    # what the pressure advance adds to the extruder's speed is a jerk too
                    most = drive.jerk / (drive.pressure_advance * part)
                    acceleration = min(acceleration, most)
        self.speed, self.acceleration = speed, acceleration

    def joins(self, before: Move, drives: Sequence[Drive]) -> float:
        """Return the highest speed at which it may follow that move; 0 after a standstill."""
        if not before.parts or not self.parts or before.kind != self.kind:
            return 0.0
        speed = min(before.speed, self.speed)
        for drive, old, new in zip(drives, before.parts, self.parts):
            change = abs(new - old)
            if change * speed > drive.jerk:
                speed = drive.jerk / change
        return speed

    @property
    def kind(self) -> tuple[bool, bool]:
        """Only moves of one kind go into each other without a stop."""
        return self.is_printing, any(self.parts[:2])

    def reachable(self, speed: float) -> float:
        """Return the highest speed at one end where that is the speed at the other."""
        return math.sqrt(speed * speed + 2 * self.acceleration * self.length)

    def needed(self) -> float:
        """Return how many seconds it takes between its two speeds."""
        slow, last, acceleration = self.entry, self.exit, self.acceleration
        square = (2 * acceleration * self.length + slow * slow + last * last) / 2
        top = min(self.speed, math.sqrt(square))
        changing = (2 * top * top - slow * slow - last * last) / (2 * acceleration)
        steady = max(0.0, self.length - changing) / top
        return (2 * top - slow - last) / acceleration + steady


def append(moves: deque[Move], move: Move, drives: Sequence[Drive], now: float) -> None:
    """Put a move behind the others, and plan those anew that haven't begun."""
    move.limit(drives)
    if moves and moves[-1].start > now:
        move.joint = move.joins(moves[-1], drives)
    moves.append(move)
    first = _raise_speeds(moves, now)
    for index in range(first, len(moves)):
        _place(moves, index, now)


def append_timed(moves: deque[Move], move: Move, seconds: float, now: float) -> None:
    """Put a move behind the others that takes a given time."""
    move.start = max(now, moves[-1].end if moves else now)
    move.end = move.start + seconds
    moves.append(move)


def _raise_speeds(moves: deque[Move], now: float) -> int:
    """Raise the speeds where moves meet, from the last on; return the first that has changed."""
    index = len(moves) - 1
    while index > 0 and moves[index - 1].start > now:
        move, before = moves[index], moves[index - 1]
        entry = min(move.joint, move.reachable(move.exit))
        if index < len(moves) - 1 and entry <= move.entry:
            break
        move.entry = before.exit = entry
        index -= 1
    return index


def _place(moves: deque[Move], index: int, now: float) -> None:
    """Give a move the speed that it can have reached, and its times."""
    move = moves[index]
    if index:
        move.start = moves[index - 1].end
    elif not move.start:
        move.start = now + START_DELAY
    move.exit = min(move.exit, move.reachable(move.entry))
    if index + 1 < len(moves):
        moves[index + 1].entry = move.exit
    move.end = move.start + move.needed()
