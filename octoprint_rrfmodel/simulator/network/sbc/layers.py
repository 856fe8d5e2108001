"""The layers of a print, which DSF counts and the board doesn't (``job.layers``)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


class Layers:
    """Those that have been seen to end, of the print that is under way or was the last."""

    def __init__(self) -> None:
        self._found: list[dict[str, Any]] = []
        self._number = 0
        self._started_at = 0.0

    def seen(self, model: Mapping[str, Any]) -> list[dict[str, Any]]:
        """Look at the model, and return all layers up to now."""
        job = model.get("job") or {}
        number, duration = job.get("layer") or 0, job.get("duration") or 0.0
        if number < self._number:
            self._found, self._number, self._started_at = [], 0, 0.0
        while self._number < number:
            if self._number:
                self._found = [*self._found, self._layer(job, model, duration)]
                self._started_at = duration
            self._number += 1
        return self._found

    def _layer(
        self, job: Mapping[str, Any], model: Mapping[str, Any], duration: float
    ) -> dict[str, Any]:
        file = job.get("file") or {}
        heaters = (model.get("heat") or {}).get("heaters") or []
        layers = file.get("numLayers") or 1
        return {
            "duration": round(duration - self._started_at, 1),
            "filament": [],
            "fractionPrinted": round(1 / layers, 4),
            "height": file.get("layerHeight") or 0.0,
            "temperatures": [heater["current"] for heater in heaters if heater is not None],
        }
