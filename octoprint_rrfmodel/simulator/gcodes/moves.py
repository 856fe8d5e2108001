"""G-codes that move: G0 to G3, and those that wait for moves."""

from __future__ import annotations

from collections.abc import Sequence

from ..clock import Clock
from ..device.extrusion import ExtrusionWarnings
from ..device.job import Job
from ..device.motion import Motion
from ..device.thermal import Thermal
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import MoveError, Outcome, Running
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError

INCH = 25.4
HIGHEST_CODE = 4
"""Highest H of G1."""


class Moves:
    """Puts moves into the queue."""

    def __init__(
        self,
        *,
        model: ObjectModel,
        motion: Motion,
        thermal: Thermal,
        job: Job,
        clock: Clock,
        warnings: ExtrusionWarnings,
    ):
        self._model = model
        self._motion = motion
        self._thermal = thermal
        self._job = job
        self._clock = clock
        self._warnings = warnings

    def rows(self) -> Rows:
        return {
            "G0": Row(self._linear_move),
            "G1": Row(self._linear_move),
            "G2": Row(self._linear_move),
            "G3": Row(self._linear_move),
            "G4": Row(self._dwell),
            "M400": Row(self._wait_for_moves),
        }

    def _linear_move(self, channel: Channel, command: Command) -> Outcome:
        """G0 to G3: answers once the move is in the queue, later while that is full."""
        if self._motion.is_full:
            return self._when_there_is_room(channel, command)
        self._queue_move(channel, command)
        return None

    def _when_there_is_room(self, channel: Channel, command: Command) -> Running:
        yield self._motion.has_room
        self._queue_move(channel, command)

    def _queue_move(self, channel: Channel, command: Command) -> None:
        words = command.coordinates()
        modal = channel.input
        scale = INCH if modal["distanceUnit"] == "in" else 1.0
        if "F" in words:
            modal["feedRate"] = words["F"] * scale / 60
        motion = self._motion
        motion.last_code = command.number
        code = int(words.get("H", 0))
        if not 0 <= code <= HIGHEST_CODE:
            raise GCodeError("parameter 'H' too high")
        if command.number in (2, 3) and not words.keys() & set("IJKR"):
            raise GCodeError("no I J K or R parameter")
        begin = motion.target()
        target = list(begin)
        involved: list[int] = []
        relative = modal["axesRelative"]
        for index, axis in enumerate(motion.axes):
            letter = axis["letter"]
            if letter in words:
                value = words[letter] * scale
                from_ = begin[index] if relative else self._zero(index, words)
                target[index] = from_ + value
                involved.append(index)
        if involved and not code:
            self._check_homed(involved)
        if code in (1, 3):
            self._home_by_move(involved)
        elif not code:
            target = self._inside_limits(target, involved)
        speed = modal["feedRate"] * float(self._model.data["move"].get("speedFactor") or 1.0)
        if command.number == 0 and self._model.is_cnc and "F" not in words:
            speed = max(float(axis["speed"]) / 60 for axis in motion.axes)
        extrusion = self._extrusion(channel, command, words, scale, bool(involved))
        is_printed = channel.name == "File" and any(amount > 0 for amount in extrusion)
        if is_printed and involved:
            self._job.objects.printed(begin, target)
        origin = self._job.line_number - 1 if channel.name == "File" else None
        motion.queue(target, extrusion, speed, origin=origin)

    def _zero(self, index: int, words: dict[str, float]) -> float:
        """Return where coordinates count from: the workplace, or with R a restore point."""
        offset = self._motion.offset(index)
        points = self._model.data["state"].get("restorePoints") or []
        point = int(words.get("R", -1))
        if not 0 <= point < len(points):
            return offset
        return float(points[point]["coords"][index]) + offset

    def _check_homed(self, involved: Sequence[int]) -> None:
        move = self._model.data["move"]
        if not move.get("noMovesBeforeHoming", True):
            return
        axes = self._motion.axes
        needed = range(min(3, len(axes))) if self._motion.is_delta else involved
        if not all(axes[index]["homed"] for index in needed):
            raise MoveError("insufficient axes homed")

    def _home_by_move(self, involved: Sequence[int]) -> None:
        for index in involved:
            self._motion.axes[index]["homed"] = True
        self._model.bump("move")

    def _inside_limits(self, target: list[float], involved: Sequence[int]) -> list[float]:
        """Return the target clamped to the axis limits; on a CNC machine that is an error."""
        if not self._model.data["move"].get("limitAxes", True):
            return target
        axes = self._motion.axes
        clamped = list(target)
        for index in involved:
            if axes[index]["homed"]:
                low, high = float(axes[index]["min"]), float(axes[index]["max"])
                clamped[index] = min(max(target[index], low), high)
        if clamped != target and self._model.is_cnc:
            raise MoveError("target position outside machine limits")
        return clamped

    def _extrusion(
        self,
        channel: Channel,
        command: Command,
        words: dict[str, float],
        scale: float,
        has_axes: bool,
    ) -> list[float]:
        """Return the extrusion of each extruder, none where the tool is missing or cold."""
        amounts = [0.0] * len(self._motion.extruders)
        if "E" not in words:
            return amounts
        drives_relative = channel.input["drivesRelative"]
        motion = self._motion
        if drives_relative and ":" in command.text:
            requested = [value * scale for value in command.numbers("E") or [0.0]]
        elif drives_relative:
            requested = [words["E"] * scale]
        else:
            requested = [words["E"] * scale - motion.virtual_e]
        if not drives_relative:
            motion.virtual_e += sum(requested)
        tool = self._model.current_tool()
        if tool is None:
            self._warnings.no_tool()
            return amounts
        if not self._thermal.can_extrude(tool):
            self._warnings.cold(tool["number"])
            return amounts
        drives = tool.get("extruders") or []
        mix = tool.get("mix") or [1.0]
        for position, drive in enumerate(drives):
            if drive >= len(amounts):
                continue
            if len(requested) > 1:
                amounts[drive] = requested[position] if position < len(requested) else 0.0
            else:
                amounts[drive] = requested[0] * (mix[position] if position < len(mix) else 0.0)
        if has_axes and any(amount > 0 for amount in amounts):
            self._job.extruded(sum(amounts), motion.target())
        return amounts

    def _dwell(self, channel: Channel, command: Command) -> Running:
        """G4: waits for the queue, then for P milliseconds or S seconds."""
        milliseconds = command.number_of("P", 0.0) or 0.0
        seconds = (command.number_of("S", 0.0) or 0.0) + milliseconds / 1000
        yield self._motion.has_stopped
        yield self._clock.after(seconds)

    def _wait_for_moves(self, channel: Channel, command: Command) -> Running:
        """M400."""
        yield self._motion.has_stopped
