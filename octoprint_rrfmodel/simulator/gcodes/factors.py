"""M220 and M221: what speed and extrusion are multiplied by."""

from __future__ import annotations

from ..device.motion import Motion
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError, SyntaxProblem


class Factors:
    """Sets the factors of moves to come."""

    def __init__(self, model: ObjectModel, motion: Motion):
        self._model = model
        self._motion = motion

    def rows(self) -> Rows:
        return {
            "M220": Row(self._speed_factor),
            "M221": Row(self._extrusion_factor),
        }

    def _speed_factor(self, channel: Channel, command: Command) -> Outcome:
        """M220."""
        move = self._model.data["move"]
        percent = command.number_of("S")
        if percent is None:
            return f"Speed factor: {move['speedFactor'] * 100:.1f}%"
        if percent <= 0:
            column = command.raw["S"][1]
            raise SyntaxProblem(f"{command.name}: value must be greater than zero", column)
        move["speedFactor"] = percent / 100
        self._model.bump("move")
        return None

    def _extrusion_factor(self, channel: Channel, command: Command) -> Outcome:
        """M221: with D one extruder, otherwise those of the current tool."""
        percent, drive = command.number_of("S"), command.integer("D")
        extruders = self._motion.extruders
        if drive is not None:
            if not 0 <= drive < len(extruders):
                raise GCodeError("parameter 'D' too high")
            drives = [drive]
            head = f"Extrusion factor for extruder {drive}: "
        else:
            tool = self._model.current_tool()
            if tool is None:
                raise GCodeError("No tool selected")
            drives = tool.get("extruders") or []
            head = "Extrusion factor(s) for current tool: "
        if percent is None:
            return head + ", ".join(f"{extruders[i]['factor'] * 100:.1f}%" for i in drives)
        for index in drives:
            extruders[index]["factor"] = percent / 100
        self._model.bump("move")
        return None
