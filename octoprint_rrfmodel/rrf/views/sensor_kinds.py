"""View: what a sensor of the machine measures, by its type. The only place that knows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

DEGREES = "°C"

OTHER_UNITS = (("humidity", "%"), ("pressure", ""), ("linear", ""), ("voltage", "V"))
"""Part of ``sensors.analog[].type`` and its unit, as ``dhthumidity`` and ``bme-pressure``; all
others tell degrees. A linear sensor measures whatever its owner has scaled it to."""

MOST = 1e9
"""A reading from here on is a spoilt one."""


def unit_of(sensor: Mapping[str, Any]) -> str:
    """Return the unit of what an analog sensor tells, empty where nobody can say."""
    of_type = str(sensor.get("type", "")).lower()
    return next((unit for part, unit in OTHER_UNITS if part in of_type), DEGREES)


def other_reading(value: Any) -> float | None:
    """Return what a sensor tells that is no thermometer, ``None`` where that is no number."""
    return float(value) if type(value) in (int, float) and abs(value) < MOST else None


def is_thermometer(sensor: Mapping[str, Any]) -> bool:
    """Return whether an analog sensor tells a temperature."""
    return unit_of(sensor) == DEGREES
