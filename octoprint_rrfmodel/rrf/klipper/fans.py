"""Fans: the part fan, those that a temperature rules, and the rest."""

from __future__ import annotations

from typing import Any

from ..views.machine import array, mapping
from .kept import sensor_reading
from .printer import Model, Printer
from .sections import PIN
from .values import element, first, fraction, named, number, text, whole
from .view import Row, View, each, where

ELECTRONICS = frozenset(("mcutemp", "drivers", "driversduex"))
"""Types of sensors on the boards themselves: a fan that they rule cools the electronics."""


def _fans(view: Printer) -> list[Model]:
    return [mapping(fan) for fan in array(view.model.get("fans"))]


def _part_fan_index(view: Printer) -> int:
    """Return the first fan of the current tool, else 0."""
    index = first((view.tool or {}).get("fans"))
    return index if index is not None and element(view.model.get("fans"), index) else 0


def _part_fan(view: Printer) -> Model:
    return element(view.model.get("fans"), _part_fan_index(view))


def _ruling_sensors(view: Printer, fan: Model) -> list[Model]:
    """Return the sensors that rule a thermostatic fan; before 3.5 they are called heaters."""
    thermostat = mapping(fan.get("thermostatic"))
    numbers = array(thermostat.get("sensors")) or array(thermostat.get("heaters"))
    sensors = mapping(view.model.get("sensors")).get("analog")
    return [element(sensors, index) for index in numbers]


def thermostatic_fans(view: Printer) -> dict[str, Model]:
    """Return the fans that a temperature rules, by name."""
    return named(
        (text(fan.get("name")), f"fan{index}", fan)
        for index, fan in enumerate(_fans(view))
        if _ruling_sensors(view, fan)
    )


def _kind(view: Printer, index: int, fan: Model) -> str:
    """Return what Klipper would call a fan that isn't the part fan."""
    sensors = _ruling_sensors(view, fan)
    if not sensors:
        # M408 tells as a bitmap which fans nothing rules
        free = whole(mapping(view.model.get("m408")).get("controllableFans"))
        return "fan_generic" if free is None or free >> index & 1 else "heater_fan"
    is_electronics = all(text(sensor.get("type")) in ELECTRONICS for sensor in sensors)
    return "controller_fan" if is_electronics else "heater_fan"


def _other_fans(kind: str) -> Any:
    """Return for ``Row.things`` the fans of that kind but the part fan."""

    def things(view: View) -> dict[str, Model]:
        part_fan = _part_fan_index(view)
        return named(
            (text(fan.get("name")), f"fan{index}", fan)
            for index, fan in enumerate(_fans(view))
            if fan and index != part_fan and _kind(view, index, fan) == kind
        )

    return each(kind, things)


def _rpm(view: View, fan: Model) -> float | None:
    """Return the speed; -1 stands for a fan without a tacho."""
    rpm = number(fan.get("rpm"))
    return None if rpm is None or rpm < 0 else rpm


def _warmest(view: View, fan: Model) -> float | None:
    readings = [sensor_reading(sensor) for sensor in _ruling_sensors(view, fan)]
    return max((value for value in readings if value is not None), default=None)


def _requested(view: View, fan: Model) -> float:
    """Return what was asked for, as in Klipper."""
    return fraction(fan.get("requestedValue"))


def _actual(view: View, fan: Model) -> float:
    """Return how fast a fan runs that nobody asks; M408 tells only what it would run at."""
    return fraction(fan.get("actualValue", fan.get("requestedValue")))


def _section(view: View, fan: Model) -> dict[str, Any]:
    return {"pin": PIN}


def _ruled_section(view: View, fan: Model) -> dict[str, Any]:
    # by which heaters is in no model, only by which sensors
    return {"pin": PIN, "heater": []}


KINDS = {
    "fan_generic": (_requested, _section),
    "heater_fan": (_actual, _ruled_section),
    "controller_fan": (_actual, _ruled_section),
}
"""Kinds of fans beside the part fan, their speed and their section."""

ROWS = (
    Row("fan", where("fan", _part_fan), {"speed": _requested, "rpm": _rpm}, settings=_section),
    *(
        Row(f"{kind} X", _other_fans(kind), {"speed": speed, "rpm": _rpm}, settings=section)
        for kind, (speed, section) in KINDS.items()
    ),
    Row(
        "temperature_fan X",
        each("temperature_fan", thermostatic_fans),
        {
            "speed": _actual,
            "temperature": _warmest,
            "target": lambda view, fan: number(
                mapping(fan.get("thermostatic")).get("lowTemperature")
            ),
        },
        settings=_section,
    ),
)
