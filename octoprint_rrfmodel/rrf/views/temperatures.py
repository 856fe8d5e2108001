"""View: the model's temperatures under the names that a host's temperature report has."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from .sensor_kinds import is_thermometer

Temperature = tuple[Any, Any]
"""Current value and target in degrees Celsius; ``None`` where there is none."""

ABSOLUTE_ZERO = -273.0
BAD_READING = 1999.0
"""The firmware shows -273.15 for a sensor that has none, 2000 for one that is broken."""

RESERVED = re.compile(r"(?:[a-z]|bed|chamber|tool|time)[\d_]*|_+.*", re.IGNORECASE)
"""Names that are the host's own, with any number, whatever the letters' case. A temperature report
has single letters for beds, chambers and tools; OctoPrint puts sensors among its own members:
words for the same, and ``time``, which is no temperature. A test asks OctoPrint for them."""

TARGET_OF_STATE = {"active": "active", "tuning": "active", "standby": "standby"}


class Temperatures(NamedTuple):
    """What the model says about heat."""

    tools: dict[int, Temperature]
    """By RRF's tool number; a tool without a heater is missing."""
    bed: Temperature | None
    chamber: Temperature | None
    others: dict[str, Temperature]
    """Further heaters of a tool, beds, chambers, and sensors that no heater uses."""


def temperatures(model: Mapping[str, Any]) -> Temperatures:
    """Return the temperatures of tools, beds, chambers and sensors.

    The first slot with a heater is the bed, the chamber; further ones are called ``B1``, ``C1``
    as in the firmware's own report (3.5 GCodes.cpp:4811). Sensors keep their names unless they
    could be the host's own (``RESERVED``) or are there twice; those that measure no temperature
    are left out.
    """
    heat = _object(model.get("heat"))
    heaters = _array(heat.get("heaters"))
    others: dict[str, Temperature] = {}
    tools: dict[int, Temperature] = {}
    for tool in _array(model.get("tools")):
        number = _object(tool).get("number")
        own = [_heater(heaters, index) for index in _array(_object(tool).get("heaters"))]
        if isinstance(number, int) and own and own[0]:
            tools[number] = own[0]
            for place, extra in enumerate(own[1:], 1):
                if extra:
                    others[f"Tool {number} heater {place}"] = extra
    beds = list(_slots(heaters, heat.get("bedHeaters")))
    chambers = list(_slots(heaters, heat.get("chamberHeaters")))
    for letter, slots in (("B", beds), ("C", chambers)):
        for slot, value in slots[1:]:
            others[f"{letter}{slot}"] = value
    counts: dict[str, int] = {}
    for name, reading in _free_sensors(model, heaters):
        others[_unused(name, others, counts)] = (reading, None)
    return Temperatures(
        tools, beds[0][1] if beds else None, chambers[0][1] if chambers else None, others
    )


def _heater(heaters: list[Any], index: Any) -> Temperature | None:
    if not isinstance(index, int) or not 0 <= index < len(heaters):
        return None
    heater = _object(heaters[index])
    if "current" not in heater:
        return None
    target = heater.get(TARGET_OF_STATE.get(str(heater.get("state")), ""), 0.0)
    # a target of -273.15 is one that was never set, or that switched the heater off
    if not isinstance(target, (int, float)) or target < 0:
        target = 0.0
    return heater["current"], target


def _slots(heaters: list[Any], slots: Any) -> Iterator[tuple[int, Temperature]]:
    for slot, index in enumerate(_array(slots)):
        value = _heater(heaters, index)
        if value:
            yield slot, value


def _free_sensors(model: Mapping[str, Any], heaters: list[Any]) -> Iterator[tuple[str, float]]:
    """Yield name and reading of each working sensor that isn't a heater's own."""
    numbers = (_object(heater).get("sensor") for heater in heaters)
    used = {number for number in numbers if isinstance(number, int)}
    sensors = _array(_object(model.get("sensors")).get("analog"))
    for number, sensor in enumerate(sensors):
        reading = _object(sensor).get("lastReading")
        if number in used or not isinstance(reading, (int, float)):
            continue
        if not is_thermometer(sensor):
            continue
        # a host keeps each name that it was ever told, so that one not yet known has to wait
        if ABSOLUTE_ZERO < reading < BAD_READING and "name" in sensor:
            yield str(sensor.get("name") or f"Sensor {number}"), reading


def _unused(name: str, names: Mapping[str, Any], counts: dict[str, int]) -> str:
    """Return a name that isn't there yet; ``counts`` is how often each was wanted before."""
    if RESERVED.fullmatch(name):
        name = f"Sensor {name}"
    unused, count = name, counts.get(name, 1)
    while unused in names:
        count += 1
        unused = f"{name} {count}"
    counts[name] = count
    return unused


def _object(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, Mapping) else {}


def _array(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []
