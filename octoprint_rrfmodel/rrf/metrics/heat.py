"""Metrics of heaters, analog sensors and fans."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ..views.machine import array, mapping
from ..views.sensor_kinds import is_thermometer, other_reading, unit_of
from ..views.state_words import HEATERS
from ..views.temperatures import TARGET_OF_STATE
from .metric import (
    GAUGE,
    Metric,
    Sample,
    Sources,
    each,
    indexed,
    infos,
    not_negative,
    numeric,
    reading,
    states,
    tools,
)

_heaters = indexed("heat.heaters")
_sensors = indexed("sensors.analog")
_fans = indexed("fans")


def _heater_infos(sources: Sources) -> Iterator[Sample]:
    """Yield what each heater heats; for one of several tools the first of them."""
    uses: dict[int, tuple[str, str]] = {}
    heat = mapping(sources.model.get("heat"))
    for kind, slots in (("bed", "bedHeaters"), ("chamber", "chamberHeaters")):
        for slot, heater in enumerate(array(heat.get(slots))):
            if type(heater) is int:
                uses.setdefault(heater, (kind, str(slot)))
    for number, tool in tools(sources.model):
        for heater in array(tool.get("heaters")):
            if type(heater) is int:
                uses.setdefault(heater, ("tool", number))
    for index, _ in _heaters(sources.model):
        yield (index, *uses.get(int(index), ("other", ""))), 1


def _targets(sources: Sources) -> Iterator[Sample]:
    for index, heater in _heaters(sources.model):
        state = heater.get("state")
        if isinstance(state, str):
            member = TARGET_OF_STATE.get(state)
            target: Any = heater.get(member) if member else 0.0
            yield (index,), max(target, 0.0) if numeric(target) else None


def _is_fault(state: Any) -> Any:
    return state == "fault" if isinstance(state, str) else None


def _working_sensors(sources: Sources) -> Iterator[Sample]:
    for index, sensor in _sensors(sources.model):
        if "lastReading" in sensor:
            find = reading if is_thermometer(sensor) else other_reading
            works = find(sensor["lastReading"]) is not None
            # told from 3.5 on
            yield (index,), works and sensor.get("state") in (None, "ok")


def _temperatures(sources: Sources) -> Iterator[Sample]:
    for index, sensor in _sensors(sources.model):
        if is_thermometer(sensor):
            yield (index,), reading(sensor.get("lastReading"))


def _other_readings(sources: Sources) -> Iterator[Sample]:
    for index, sensor in _sensors(sources.model):
        if not is_thermometer(sensor):
            yield (index, unit_of(sensor)), other_reading(sensor.get("lastReading"))


METRICS = (
    Metric(
        "rrf_heater_info",
        GAUGE,
        "What a heater heats: bed, chamber, tool or other, and its slot or tool number.",
        ("heater", "kind", "number"),
        _heater_infos,
    ),
    Metric(
        "rrf_heater_temperature_celsius",
        GAUGE,
        "Temperature of a heater.",
        ("heater",),
        each(_heaters, "current", reading),
    ),
    Metric(
        "rrf_heater_target_celsius",
        GAUGE,
        "Temperature that a heater is to have by its state, 0 when it is off.",
        ("heater",),
        _targets,
    ),
    Metric(
        "rrf_heater_active_celsius",
        GAUGE,
        "Active temperature that was set.",
        ("heater",),
        each(_heaters, "active", reading),
    ),
    Metric(
        "rrf_heater_standby_celsius",
        GAUGE,
        "Standby temperature that was set.",
        ("heater",),
        each(_heaters, "standby", reading),
    ),
    Metric(
        "rrf_heater_state",
        GAUGE,
        "State of a heater: 1 for the word that holds.",
        ("heater", "state"),
        states(_heaters, HEATERS, "state"),
    ),
    Metric(
        "rrf_heater_fault",
        GAUGE,
        "Whether a heater has a fault.",
        ("heater",),
        each(_heaters, "state", _is_fault),
    ),
    Metric(
        "rrf_heater_pwm_ratio",
        GAUGE,
        "Average power of a heater, 0 to 1.",
        ("heater",),
        each(_heaters, "avgPwm"),
    ),
    Metric(
        "rrf_sensor_info",
        GAUGE,
        "Name and type of an analog sensor.",
        ("sensor", "name", "type"),
        infos(_sensors, "name", "type"),
    ),
    Metric(
        "rrf_sensor_temperature_celsius",
        GAUGE,
        "Reading of an analog sensor that measures a temperature.",
        ("sensor",),
        _temperatures,
    ),
    Metric(
        "rrf_sensor_reading",
        GAUGE,
        "Reading of an analog sensor that measures something else, in its own unit.",
        ("sensor", "unit"),
        _other_readings,
    ),
    Metric(
        "rrf_sensor_ok",
        GAUGE,
        "Whether an analog sensor can be read.",
        ("sensor",),
        _working_sensors,
    ),
    Metric("rrf_fan_info", GAUGE, "Name of a fan.", ("fan", "name"), infos(_fans, "name")),
    Metric(
        "rrf_fan_requested_ratio",
        GAUGE,
        "Speed that a fan was set to, 0 to 1.",
        ("fan",),
        each(_fans, "requestedValue", not_negative),
    ),
    Metric(
        "rrf_fan_actual_ratio",
        GAUGE,
        "Speed that a fan is driven with, 0 to 1.",
        ("fan",),
        each(_fans, "actualValue", not_negative),
    ),
    Metric(
        "rrf_fan_speed_rpm",
        GAUGE,
        "Measured speed of a fan with a tacho, in revolutions a minute.",
        ("fan",),
        each(_fans, "rpm", not_negative),
    ),
)
