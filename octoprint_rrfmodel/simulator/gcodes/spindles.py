"""M3 to M5: spindles."""

from __future__ import annotations

from typing import Any

from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError


class Spindles:
    """Turns spindles."""

    def __init__(self, model: ObjectModel):
        self._model = model

    def rows(self) -> Rows:
        return {
            "M3": Row(self._spindle),
            "M4": Row(self._spindle),
            "M5": Row(self._spindle),
        }

    def _spindle(self, channel: Channel, command: Command) -> Outcome:
        """M3, M4, M5: spindle P or the current tool's; M5 without any stops all of them.

        RRF 3.5 GCodes2.cpp (M3, M4, M5), Spindle.cpp, SetRpm: the speed is kept as it was asked
        for, the spindle turns within its limits.
        """
        spindles = self._model.data.get("spindles") or []
        tool = self._model.current_tool() or {}
        place = command.integer("P", tool.get("spindle", -1))
        if place is None or not 0 <= place < len(spindles) or spindles[place] is None:
            if command.number != 5 or "P" in command:
                raise GCodeError("No P parameter and no active tool with spindle")
            for other in spindles:
                _turn(other, "stopped")
            return None
        speed = command.integer("S")
        if speed is not None and command.number != 5:
            spindles[place]["active"] = speed
        _turn(spindles[place], {3: "forward", 4: "reverse"}.get(command.number or 5, "stopped"))
        self._model.bump("spindles")
        return None


def _turn(spindle: dict[str, Any] | None, state: str) -> None:
    if spindle is None or spindle["state"] == "unconfigured":
        return
    turns = state != "stopped" and spindle["active"] > 0
    speed = min(max(spindle["active"], spindle["min"]), spindle["max"])
    spindle.update(state=state, current=speed if turns else 0)
