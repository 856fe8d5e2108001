"""M106 and M107: fans."""

from __future__ import annotations

from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError


class Fans:
    """Sets fans."""

    def __init__(self, model: ObjectModel):
        self._model = model

    def rows(self) -> Rows:
        return {
            "M106": Row(self._set_fan),
            "M107": Row(self._fan_off),
        }

    def _set_fan(self, channel: Channel, command: Command) -> Outcome:
        """M106: S up to 1 is a fraction, above it /255; without P the fans of the current tool."""
        fans = self._model.data.get("fans") or []
        if "P" in command:
            numbers = [command.integer("P", 0) or 0]
        else:
            tool = self._model.current_tool()
            numbers = (tool.get("fans") if tool else None) or ([0] if fans else [])
        speed = command.number_of("S")
        for number in numbers:
            fan = fans[number] if 0 <= number < len(fans) else None
            if fan is None:
                raise GCodeError(f"Fan number {number} not found")
            if "C" in command:
                fan["name"] = command.string("C")
                self._model.bump("fans")
            for letter, member in (("L", "min"), ("X", "max"), ("B", "blip")):
                if letter in command:
                    fan[member] = command.number_of(letter)
                    self._model.bump("fans")
            if speed is not None:
                fan["requestedValue"] = max(0.0, min(1.0, speed / 255 if speed > 1 else speed))
        if not command.raw and numbers and fans:
            return f"Fan {numbers[0]} speed: {round(fans[numbers[0]]['requestedValue'] * 100)}%"
        return None

    def _fan_off(self, channel: Channel, command: Command) -> Outcome:
        """M107."""
        tool = self._model.current_tool()
        for number in (tool.get("fans") if tool else None) or [0]:
            if 0 <= number < len(self._model.data.get("fans") or ()):
                self._model.data["fans"][number]["requestedValue"] = 0.0
        return None
