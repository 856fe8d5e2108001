"""Sections of a configuration that heaters, extruders and fans could have.

Clients take a section as a whole, as Klipper would have it: without one of its options Mobileraker
shows no printer at all. What the model doesn't have has the firmware's default.
"""

from __future__ import annotations

from typing import Any

from ..views.machine import mapping
from .motion import SECONDS
from .printer import Extruder, Model, Printer
from .values import element, number, text

PIN = ""
"""No model tells pins."""

HOTTEST_BED, HOTTEST_TOOL = 125.0, 290.0
COLDEST = 0.0
COLD_EXTRUDE = 160.0
FILAMENT_DIAMETER = 1.75
EXTRUDER_SPEED, EXTRUDER_ACCELERATION = 20.0, 250.0
SPEED, ACCELERATION = 100.0, 500.0
"""RepRapFirmware's defaults in °C, mm, mm/s and mm/s² (3.5 ``Configuration.h``)."""

LONGEST_EXTRUSION = 1000.0
"""More than anybody feeds at once: RepRapFirmware has no limit."""


def _or(value: Any, otherwise: float) -> float:
    known = number(value)
    return otherwise if known is None else known


def of_heater(view: Printer, heater: Model, hottest: float = HOTTEST_BED) -> dict[str, Any]:
    """Return the options of a heater."""
    model = mapping(heater.get("model"))
    sensors = mapping(view.model.get("sensors")).get("analog")
    is_pid = mapping(model.get("pid")).get("used") is not False
    return {
        "min_temp": _or(heater.get("min"), COLDEST),
        "max_temp": _or(heater.get("max"), hottest),
        "max_power": _or(model.get("maxPwm"), 1.0),
        "control": "pid" if is_pid else "watermark",
        "heater_pin": PIN,
        "sensor_type": text(element(sensors, heater.get("sensor")).get("type")),
    }


def of_extruder(view: Printer, extruder: Extruder) -> dict[str, Any]:
    """Return the options of a tool's heater and its first drive."""
    drive = view.drive(extruder.tool)
    speed = number(drive.get("speed"))
    return {
        **of_heater(view, extruder.heater, HOTTEST_TOOL),
        "min_extrude_temp": _or(view.heat.get("coldExtrudeTemperature"), COLD_EXTRUDE),
        "filament_diameter": _or(drive.get("filamentDiameter"), FILAMENT_DIAMETER),
        "max_extrude_only_distance": LONGEST_EXTRUSION,
        "max_extrude_only_velocity": EXTRUDER_SPEED if speed is None else speed / SECONDS,
        "max_extrude_only_accel": _or(drive.get("acceleration"), EXTRUDER_ACCELERATION),
    }
