"""Extruders, heaters and temperature sensors."""

from __future__ import annotations

from typing import NamedTuple

from ..views.machine import array, mapping
from ..views.temperatures import ABSOLUTE_ZERO
from .fans import thermostatic_fans
from .kept import sensor_reading
from .printer import Extruder, Model, Printer
from .sections import HOTTEST_TOOL, of_extruder, of_heater
from .values import named, number, reading, text
from .view import Row, View, each, one, where

TARGETS = {"active": "active", "tuning": "active", "standby": "standby"}
"""State of a heater and the member that is its target then; in the others there is none."""

SMOOTH_TIME = 0.0
"""RRF doesn't smooth pressure advance."""


class Sensor(NamedTuple):
    """What a temperature sensor shows, in °C."""

    temperature: float | None
    lowest: float | None
    highest: float | None


def _temperature(heater: Model) -> float | None:
    return None if heater.get("state") == "offline" else number(heater.get("current"))


def _target(heater: Model) -> float:
    target = number(heater.get(TARGETS.get(text(heater.get("state")), "")))
    # -273.15 is a target that was never set
    return 0.0 if target is None or target <= ABSOLUTE_ZERO else target


def _power(heater: Model) -> float | None:
    return number(heater.get("avgPwm"))


_HEATER = {
    "temperature": lambda view, heater: _temperature(heater),
    "target": lambda view, heater: _target(heater),
    "power": lambda view, heater: _power(heater),
}


def _pressure_advance(view: View, extruder: Extruder) -> float:
    drive = view.drive(extruder.tool)
    # 3.7 has models of it, with other members
    newer = mapping(drive.get("pressAdv"))
    for value in (drive.get("pressureAdvance"), newer.get("k0"), newer.get("k")):
        if (advance := number(value)) is not None:
            return advance
    return 0.0


def _can_extrude(view: View, extruder: Extruder) -> bool | None:
    limit = number(view.heat.get("coldExtrudeTemperature"))
    current = _temperature(extruder.heater)
    return None if limit is None or current is None else current >= limit


def _further_heaters(view: Printer) -> dict[str, Model]:
    """Return all heaters of a tool but its first, by the name of the generic heater they are."""
    found = {}
    for tool_number, tool in sorted(view.tools.items()):
        for place, index in enumerate(array(tool.get("heaters"))[1:], 1):
            if heater := view.heater(index):
                found[f"tool{tool_number}_h{place}"] = heater
    return found


def _sensors(view: View) -> dict[str, Sensor]:
    analog = []
    for name, sensor in view.analog.items():
        lowest, highest = view.kept.extremes.get(name, (None, None))
        analog.append((name, name, Sensor(sensor_reading(sensor), lowest, highest)))
    boards = []
    for name, board in view.boards.items():
        if cpu := mapping(board.get("mcuTemp")):
            shown = Sensor(*(reading(cpu.get(part)) for part in ("current", "min", "max")))
            boards.append((f"mcu_{name}", f"mcu_{name}", shown))
    return named([*analog, *boards])


def _heaters(view: View) -> list[str]:
    names: list[str] = []
    for row in HEATERS:
        names.extend(row.things(view))
    return names


def _all_sensors(view: View) -> list[str]:
    fans = each("temperature_fan", thermostatic_fans)
    return [*_heaters(view), *SENSORS.things(view), *fans(view)]


HEATERS = (
    Row(
        "extruder",
        lambda view: view.extruders,
        {
            "temperature": lambda view, extruder: _temperature(extruder.heater),
            "target": lambda view, extruder: _target(extruder.heater),
            "power": lambda view, extruder: _power(extruder.heater),
            "pressure_advance": _pressure_advance,
            "smooth_time": lambda view, _: SMOOTH_TIME,
            "can_extrude": _can_extrude,
            "motion_queue": lambda view, _: None,
        },
        settings=of_extruder,
    ),
    Row(
        "heater_bed",
        where("heater_bed", lambda view: view.slot("bedHeaters")),
        _HEATER,
        settings=of_heater,
    ),
    Row(
        "heater_generic chamber",
        where("heater_generic chamber", lambda view: view.slot("chamberHeaters")),
        _HEATER,
        settings=of_heater,
    ),
    Row(
        "heater_generic toolN_hM",
        each("heater_generic", _further_heaters),
        _HEATER,
        settings=lambda view, heater: of_heater(view, heater, HOTTEST_TOOL),
    ),
)

SENSORS = Row(
    "temperature_sensor X",
    each("temperature_sensor", _sensors),
    {
        "temperature": lambda view, sensor: sensor.temperature,
        "measured_min_temp": lambda view, sensor: sensor.lowest,
        "measured_max_temp": lambda view, sensor: sensor.highest,
    },
)

ROWS: tuple[Row, ...] = (
    *HEATERS,
    SENSORS,
    Row(
        "heaters",
        one("heaters"),
        {
            "available_heaters": lambda view, _: _heaters(view),
            "available_sensors": lambda view, _: _all_sensors(view),
            "available_monitors": lambda view, _: [],
        },
    ),
)
