"""How long a print has taken, and how long it may still take (RRF 3.5 PrintMonitor.cpp)."""

from __future__ import annotations

from typing import Any

SNAPSHOT_SECONDS = 30.0
"""Seconds of printing after each of which the pace is measured; there is none before the first."""
LEAST_FILAMENT = 0.01
"""Share of the filament that has to be used for an estimate from it."""


class Progress:
    """The clocks of a print, and its pace."""

    def __init__(self) -> None:
        self.restart()

    def restart(self) -> None:
        self.duration = 0.0
        """Seconds without the pauses."""
        self.warm_up = 0.0
        """Seconds of them in which the file has waited for heaters (seen in firmware)."""
        self.paused = 0.0
        self._layer_started = 0.0
        self._measured_at = 0.0
        self._measured = (0.0, 0.0)
        self._file_pace = self._filament_pace = 0.0

    @property
    def printed(self) -> float:
        """Seconds of printing, without pauses and warming up."""
        return self.duration - self.warm_up

    @property
    def layer_time(self) -> float:
        return self.printed - self._layer_started

    def begin_layer(self) -> None:
        self._layer_started = self.printed

    def step(self, seconds: float, is_warming: bool) -> None:
        """Let the print go on for that long."""
        self.duration += seconds
        if is_warming:
            self.warm_up += seconds

    def measure(self, fraction: float, used: float) -> None:
        """Measure the pace where it is time to, by the share of the file and the filament in mm."""
        passed = self.printed - self._measured_at
        if passed < SNAPSHOT_SECONDS:
            return
        self._file_pace = (fraction - self._measured[0]) / passed
        self._filament_pace = (used - self._measured[1]) / passed
        self._measured, self._measured_at = (fraction, used), self.printed

    def times_left(self, info: dict[str, Any], fraction: float, used: float) -> dict[str, Any]:
        """Return ``job.timesLeft``."""
        total = sum(info.get("filament") or ())
        has_pace = self._filament_pace > 0 and used > total * LEAST_FILAMENT
        slicer = info.get("printTime")
        return {
            "file": round((1 - fraction) / self._file_pace) if self._file_pace > 0 else None,
            "filament": (
                round(max(1.0, (total - used) / self._filament_pace))
                if total > 0 and has_pace
                else None
            ),
            "slicer": round(max(1.0, slicer - self.printed)) if slicer else None,
        }
