"""Where the axes are said to be, and how coordinates are read: G20 to G92, M120, M290, M564."""

from __future__ import annotations

from functools import partial
from typing import Any

from ..device.motion import Motion
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome, Running
from ..model.tree import ObjectModel
from ..text.command import Command
from .moves import INCH


class Coordinates:
    """Sets coordinates without moving."""

    def __init__(self, model: ObjectModel, motion: Motion):
        self._model = model
        self._motion = motion

    def rows(self) -> Rows:
        return {
            "G20": self._mode("distanceUnit", "in"),
            "G21": self._mode("distanceUnit", "mm"),
            "G54": Row(self._workplace),
            "G55": Row(self._workplace),
            "G56": Row(self._workplace),
            "G57": Row(self._workplace),
            "G58": Row(self._workplace),
            "G59": Row(self._workplace),
            "G90": self._mode("axesRelative", False),
            "G91": self._mode("axesRelative", True),
            "G92": Row(self._set_position),
            "M18": Row(self._motors_off),
            "M82": self._mode("drivesRelative", False),
            "M83": self._mode("drivesRelative", True),
            "M84": Row(self._motors_off),
            "M120": Row(self._push),
            "M121": Row(self._pop),
            "M290": Row(self._babystep),
            "M564": Row(self._limits),
        }

    def _set_position(self, channel: Channel, command: Command) -> Outcome:
        """G92: the named axes are where it says, and count as homed."""
        words = command.coordinates()
        scale = INCH if channel.input["distanceUnit"] == "in" else 1.0
        if "E" in words or not words:
            self._motion.virtual_e = words.get("E", 0.0) * scale
        jumps = {
            index: words[axis["letter"]] * scale + self._motion.offset(index)
            for index, axis in enumerate(self._motion.axes)
            if axis["letter"] in words
        }
        return self._jump_at_standstill(jumps) if jumps else None

    def _jump_at_standstill(self, jumps: dict[int, float]) -> Running:
        yield self._motion.has_stopped
        for index in jumps:
            self._motion.axes[index]["homed"] = True
        self._motion.jump(jumps)
        self._model.bump("move")

    def _motors_off(self, channel: Channel, command: Command) -> Running:
        """M18 and M84: the axes named, or all, aren't homed any more; ``M84 S`` sets idle time."""
        seconds = command.number_of("S")
        if seconds is not None:
            self._model.data["move"]["idle"]["timeout"] = seconds
            self._model.bump("move")
            return
        yield self._motion.has_stopped
        for index in self._motion.named_axes(command.raw) or range(len(self._motion.axes)):
            if "E" not in command:
                self._motion.axes[index]["homed"] = False
        self._model.bump("move")

    def _babystep(self, channel: Channel, command: Command) -> Outcome:
        """M290: S or Z, other axes by letter; relative unless R0, clamped to 1 mm a command."""
        if not command.raw:
            axes = self._motion.axes
            offsets = " ".join(f"{axis['letter']}:{axis['babystep']:.3f}" for axis in axes)
            return f"Baby stepping offsets (mm): {offsets}"
        absolute = command.integer("R", 1) == 0
        for index, axis in enumerate(self._motion.axes):
            letter = axis["letter"]
            amount = command.number_of(letter)
            if amount is None and letter == "Z":
                amount = command.number_of("S")
            if amount is None:
                continue
            change = amount - axis["babystep"] if absolute else max(-1.0, min(1.0, amount))
            axis["babystep"] += change
            self._motion.jump({index: self._motion.target()[index] + change})
        self._model.bump("move")
        return None

    def _limits(self, channel: Channel, command: Command) -> Outcome:
        """M564: H0 allows moves of unhomed axes, S0 beyond the limits."""
        move = self._model.data["move"]
        before_homing, limit = command.integer("H"), command.integer("S")
        if before_homing is not None:
            move["noMovesBeforeHoming"] = before_homing != 0
        if limit is not None:
            move["limitAxes"] = limit != 0
        if before_homing is None and limit is None:
            outside = "not allowed" if move.get("limitAxes", True) else "allowed"
            unhomed = "not allowed" if move.get("noMovesBeforeHoming", True) else "allowed"
            return (
                f"Movement outside the bed is {outside}, "
                f"movement of axes that haven't been homed is {unhomed}"
            )
        self._model.bump("move")
        return None

    def _push(self, channel: Channel, command: Command) -> Outcome:
        """M120."""
        channel.push()
        return None

    def _pop(self, channel: Channel, command: Command) -> Outcome:
        """M121."""
        channel.pop()
        return None

    def _workplace(self, channel: Channel, command: Command) -> Outcome:
        """G54 to G59.3: selects a coordinate system."""
        move = self._model.data["move"]
        if command.number == 59 and command.fraction > 0:
            move["workplaceNumber"] = 5 + command.fraction
        else:
            move["workplaceNumber"] = (command.number or 54) - 54
        if "workspaceNumber" in move:
            move["workspaceNumber"] = move["workplaceNumber"] + 1
        self._model.bump("move")
        return None

    def _mode(self, member: str, value: Any) -> Row:
        """Return the row that sets one modal member of the channel (G90, M83, G20 ...)."""
        return Row(partial(self._set_mode, member, value))

    def _set_mode(self, member: str, value: Any, channel: Channel, command: Command) -> Outcome:
        if channel.input.get(member) != value:
            channel.input[member] = value
            self._model.bump("inputs")
        return None
