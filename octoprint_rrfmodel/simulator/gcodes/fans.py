"""M106 and M107: fans."""

from __future__ import annotations

from typing import Any

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
            if speed is None and "R" in command:
                speed = self._saved(command.integer("R", 0) or 0)
            if speed is not None:
                fan["requestedValue"] = max(0.0, min(1.0, speed / 255 if speed > 1 else speed))
        if command.raw.keys() == {"P"}:
            return _told(numbers[0], fans[numbers[0]])
        return None

    def _saved(self, point: int) -> float:
        """Return the speed of a restore point."""
        points = self._model.data["state"].get("restorePoints") or []
        found = points[point] if 0 <= point < len(points) else None
        return float((found or {}).get("fanPwm") or 0.0)

    def _fan_off(self, channel: Channel, command: Command) -> Outcome:
        """M107."""
        tool = self._model.current_tool()
        for number in (tool.get("fans") if tool else None) or [0]:
            if 0 <= number < len(self._model.data.get("fans") or ()):
                self._model.data["fans"][number]["requestedValue"] = 0.0
        return None


def _told(number: int, fan: dict[str, Any]) -> str:
    """Return what M106 P says of a fan (RRF 3.5 Fan.cpp, seen in firmware)."""
    thermostatic = fan.get("thermostatic") or {}
    sensors = thermostatic.get("sensors") or thermostatic.get("heaters") or []
    text = f"Fan {number} ({fan['name']})" if fan["name"] else f"Fan {number}"
    if not sensors:
        text += f", speed {fan['requestedValue'] * 100:.0f}%"
    text += f", min: {fan['min'] * 100:.0f}%, max: {fan['max'] * 100:.0f}%, blip: {fan['blip']:.2f}"
    if not sensors:
        return text
    low, high = thermostatic["lowTemperature"], thermostatic["highTemperature"]
    watched = " ".join(str(sensor) for sensor in sensors)
    return (
        f"{text}, temperature: {low:.1f}:{high:.1f}C, sensors: {watched}, "
        f"current speed: {fan['actualValue'] * 100:.0f}%:"
    )
