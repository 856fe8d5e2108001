"""The last hour of temperatures and heater power, for charts.

A row of samples is taken from the model at most every two seconds. Where the model isn't known the
row is empty, so that a line through the samples has a gap there.
"""

from __future__ import annotations

import math
from array import array as packed
from collections.abc import Container, Iterator, Mapping
from typing import Any, Callable, NamedTuple

from .machine import array, mapping
from .sensor_kinds import DEGREES, is_thermometer, other_reading, unit_of
from .temperatures import ABSOLUTE_ZERO, BAD_READING, TARGET_OF_STATE

INTERVAL_SECONDS = 2.0
"""Least time between two rows."""

LONGEST_SECONDS = 3600.0
MOST_ROWS = 1800

MOST_SERIES = 256
"""32 heaters with three series each, and as many sensors as RepRapFirmware can have."""

_NONE = math.nan


class Kind(NamedTuple):
    """What is kept of each heater, or of each sensor: one line of the table."""

    kind: str
    what: str
    digits: int
    """Decimals that are worth telling."""
    find: Callable[[Mapping[str, Any]], Any]
    """The value of a heater or sensor now, anything but a number where it has none."""
    is_reported: bool = False
    """Whether a temperature report tells it too."""


class Series(NamedTuple):
    """The samples of one value."""

    kind: str
    number: int
    """Of the heater or the sensor."""
    name: str
    what: str
    unit: str
    values: list[float | None]

    @property
    def id(self) -> str:
        """What tells it from all others, also over a reset."""
        return f"{self.kind}{self.number}.{self.what}"


class Samples(NamedTuple):
    """Rows of samples: one time each, and in each series one value."""

    times: list[float]
    series: list[Series]


def _temperature(value: Any) -> float | None:
    is_told = type(value) in (int, float) and ABSOLUTE_ZERO < value < BAD_READING
    return float(value) if is_told else None


def _target(heater: Mapping[str, Any]) -> float | None:
    return _temperature(heater.get(TARGET_OF_STATE.get(str(heater.get("state")), "")))


def _sensor(sensor: Mapping[str, Any]) -> float | None:
    find = _temperature if is_thermometer(sensor) else other_reading
    return find(sensor.get("lastReading"))


def _share(value: Any) -> float | None:
    return float(value) if type(value) in (int, float) and 0 <= value <= 1 else None


KINDS = (
    Kind("heater", "current", 2, lambda heater: _temperature(heater.get("current")), True),
    Kind("heater", "target", 2, _target, True),
    Kind("heater", "pwm", 3, lambda heater: _share(heater.get("avgPwm"))),
    Kind("sensor", "current", 2, _sensor),
)


class History:
    """Keeps the samples; ``now`` is the time of day in seconds wherever one is handed in."""

    def __init__(self) -> None:
        # single precision: an hour of 30 series is 1,800 rows of 4 bytes each, 216 kB, and with
        # the most series under 2 MB
        self._times = packed("d")
        self._columns: dict[tuple[str, int, str], packed[float]] = {}
        self._labels: dict[tuple[str, int, str], tuple[str, str]] = {}
        self._told_at: dict[tuple[str, int, str], float] = {}
        self._ends_with_gap = True
        self._is_new = False

    def connected(self) -> None:
        """Note that another machine may be there now."""
        self._is_new = True

    def sample(
        self, model: Mapping[str, Any], now: float, heaters: Container[int] | None = None
    ) -> None:
        """Take a row from the model where it is time for one.

        With ``heaters`` only their temperatures are known to be those of now.
        """
        self._follow_clock(now)
        if self._times and now - self._times[-1] < INTERVAL_SECONDS and not self._ends_with_gap:
            return
        # which sensors are heaters' own is known with the heaters alone
        if self._is_new and heaters is None and model.keys() >= {"heat", "sensors"}:
            self._is_new = False
            self._forget_what_is_gone(model)
        values = {}
        for kind, number, thing in _things(model):
            is_known = heaters is None or (kind.is_reported and number in heaters)
            value = kind.find(thing) if is_known else None
            if value is not None:
                key = (kind.kind, number, kind.what)
                values[key] = value
                self._labels[key] = (_name(kind, thing), _unit(kind, thing))
        if values:
            self._append(values, now)
        else:
            self.gap(now)

    def gap(self, now: float) -> None:
        """Note that nothing is known from now on, until the next sample."""
        self._follow_clock(now)
        if not self._ends_with_gap:
            self._append({}, now)

    def since(self, time: float = -math.inf) -> Samples:
        """Return the rows that are later than a time, of all series."""
        first = len(self._times)
        while first and self._times[first - 1] > time:
            first -= 1
        series = []
        for kind in KINDS:
            for key in sorted(key for key in self._columns if _is_of(key, kind)):
                told = [
                    None if value != value else round(value, kind.digits)
                    for value in self._columns[key][first:]
                ]
                name, unit = self._labels[key]
                series.append(Series(key[0], key[1], name, key[2], unit, told))
        return Samples(self._times[first:].tolist(), series)

    def _append(self, values: Mapping[tuple[str, int, str], float], now: float) -> None:
        self._forget_before(now - LONGEST_SECONDS, MOST_ROWS - 1)
        for key in values:
            if key not in self._columns and len(self._columns) < MOST_SERIES:
                self._columns[key] = packed("f", [_NONE]) * len(self._times)
            self._told_at[key] = now
        for key, column in self._columns.items():
            column.append(values.get(key, _NONE))
        self._times.append(now)
        self._ends_with_gap = not values

    def _forget_before(self, time: float, most: int) -> None:
        count = max(0, len(self._times) - most)
        while count < len(self._times) and self._times[count] < time:
            count += 1
        del self._times[:count]
        for key, column in list(self._columns.items()):
            del column[:count]
            if self._told_at[key] < time:
                del self._columns[key], self._told_at[key], self._labels[key]

    def _forget_what_is_gone(self, model: Mapping[str, Any]) -> None:
        """Drop series of what this machine doesn't have: they were another one's."""
        there = {(kind.kind, number) for kind, number, _ in _things(model)}
        for key in [key for key in self._columns if key[:2] not in there]:
            del self._columns[key], self._told_at[key], self._labels[key]

    def _follow_clock(self, now: float) -> None:
        """Drop what would lie ahead because the clock was set back."""
        count = len(self._times)
        while count and self._times[count - 1] > now:
            count -= 1
        if count < len(self._times):
            del self._times[count:]
            for column in self._columns.values():
                del column[count:]
            self._ends_with_gap = False


def _is_of(key: tuple[str, int, str], kind: Kind) -> bool:
    return (key[0], key[2]) == (kind.kind, kind.what)


def _things(model: Mapping[str, Any]) -> Iterator[tuple[Kind, int, Mapping[str, Any]]]:
    """Yield each heater, and each sensor that isn't a heater's own, with what is kept of it."""
    heaters = [mapping(heater) for heater in array(mapping(model.get("heat")).get("heaters"))]
    used = [heater.get("sensor") for heater in heaters]
    sensors = [mapping(sensor) for sensor in array(mapping(model.get("sensors")).get("analog"))]
    for kind in KINDS:
        is_heater = kind.kind == "heater"
        for number, thing in enumerate(heaters if is_heater else sensors):
            if is_heater or number not in used:
                yield kind, number, thing


def _name(kind: Kind, thing: Mapping[str, Any]) -> str:
    name = thing.get("name")
    return name if kind.kind == "sensor" and isinstance(name, str) else ""


def _unit(kind: Kind, thing: Mapping[str, Any]) -> str:
    if kind.what == "pwm":
        return ""
    return unit_of(thing) if kind.kind == "sensor" else DEGREES
