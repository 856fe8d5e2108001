"""M591: filament monitors that are a switch (RRF 3.5 SimpleFilamentMonitor.cpp)."""

from __future__ import annotations

from typing import Any, NamedTuple

from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome
from ..model.tree import ObjectModel
from ..text.command import Command

NONE, LOW_WITHOUT, HIGH_WITHOUT = range(3)
"""P: no monitor, a switch that is low or high when there is no filament."""
MODES = ("disabled", "enabled when printing from SD card", "enabled always")
"""What S says, from 3.5 on; before, every monitor that is on is enabled."""


class Switch(NamedTuple):
    """What of a switch isn't in the model."""

    pin: str = "io4.in"
    level: str = "low"
    """Its level when there is no filament."""


class Monitors:
    """Configures switches, and tells of them; of other monitors no note is taken."""

    def __init__(self, model: ObjectModel):
        self._model = model
        self.restart()

    def restart(self) -> None:
        self._switches: dict[int, Switch] = {}

    def rows(self) -> Rows:
        return {"M591": Row(self._monitor)}

    def _monitor(self, channel: Channel, command: Command) -> Outcome:
        index, kind = command.integer("D"), command.integer("P")
        monitors = self._model.data["sensors"].get("filamentMonitors")
        if index is None or monitors is None:
            return None
        found = monitors[index] if 0 <= index < len(monitors) else None
        if kind is not None:
            return self._create(command, index, kind)
        if found is None:
            return f"Extruder {index} has no filament sensor"
        if found.get("type", "simple") != "simple":
            return None
        if "S" in command:
            found.update(self._enabled(command))
            self._model.bump("sensors")
            return None
        return self._told(index, found)

    def _create(self, command: Command, index: int, kind: int) -> Outcome:
        if kind not in (NONE, LOW_WITHOUT, HIGH_WITHOUT):
            return None
        monitors = self._model.data["sensors"]["filamentMonitors"]
        monitors.extend([None] * (index + 1 - len(monitors)))
        monitors[index] = None
        if kind != NONE:
            level = "low" if kind == LOW_WITHOUT else "high"
            self._switches[index] = Switch(command.needed_string("C"), level)
            path = "sensors.filamentMonitors[]"
            monitor = {"status": "ok", "type": "simple", **self._enabled(command)}
            monitors[index] = self._model.members_of(monitor, path)
        while monitors and monitors[-1] is None:
            monitors.pop()
        self._model.bump("sensors")
        return None

    def _enabled(self, command: Command) -> dict[str, Any]:
        mode = min(max(command.integer("S", 0) or 0, 0), len(MODES) - 1)
        members = {"enableMode": mode, "enabled": mode > 0}
        kept: dict[str, Any] = self._model.members_of(members, "sensors.filamentMonitors[]")
        return kept

    def _told(self, index: int, monitor: dict[str, Any]) -> str:
        switch = self._switches.get(index, Switch())
        enabled = "enabled" if monitor["enabled"] else "disabled"
        mode = MODES[monitor["enableMode"]] if "enableMode" in monitor else enabled
        there = "no" if monitor.get("status") == "noFilament" else "yes"
        return (
            f"Simple filament sensor on pin {switch.pin}, {mode}, output {switch.level} when no "
            f"filament, filament present: {there}"
        )
