"""``server.temperature_store``: the kept hour in Moonraker's form, one value for each second.

Where nothing was known a value is 0.0: clients draw that where they have no value themselves, and
some can read nothing but numbers (KlipperScreen's ``ks_includes/widgets/heatergraph.py``).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..views.history import Samples
from ..views.machine import array, mapping
from .heat import HEATERS, SENSORS
from .query import seen
from .view import View
from .world import World

STORE_SECONDS = 3600
"""Values of each list at most, which ``server.config`` tells too."""

MOST_VALUES = 400_000
"""Of all lists together, 3 MB as text: more would be more than a socket holds for a slow reader."""

PARTS = {"temperatures": "current", "targets": "target", "powers": "pwm"}
"""Names of Moonraker's lists and of the series that they are made from."""

NEVER_SET = "targets"
"""The list that a heater has in any case: a target that was never set is 0."""

_Place = tuple[str, int]


def temperature_store(
    world: World, samples: Samples, now: float
) -> dict[str, dict[str, list[float]]]:
    """Return the lists of each object whose temperature is kept, oldest value first.

    ``now`` is the time of the last value, by the clock of the samples. All lists are of one
    length: that of the time that is known, at most ``STORE_SECONDS``.
    """
    series = {(each.kind, each.number, each.what): each.values for each in samples.series}
    kept = {}
    for name, (kind, number) in _places(seen(world)).items():
        found = {part: series.get((kind, number, what)) for part, what in PARTS.items()}
        if found["temperatures"] is not None:
            kept[name] = {part: found[part] for part in _parts_of(kind, found)}
    count = sum(len(each) for each in kept.values())
    longest = min(STORE_SECONDS, MOST_VALUES // count) if count else 0
    rows = _rows(samples.times, now, longest)
    return {
        name: {part: _picked(values, rows) for part, values in each.items()}
        for name, each in kept.items()
    }


def _parts_of(kind: str, found: Mapping[str, Any]) -> list[str]:
    is_heater = kind == "heater"
    return [part for part in PARTS if found[part] is not None or (is_heater and part == NEVER_SET)]


def _places(view: View) -> dict[str, _Place]:
    """Return where the history has each heater and sensor, by the object's name."""
    heaters = array(view.heat.get("heaters"))
    sensors = array(mapping(view.model.get("sensors")).get("analog"))
    places: dict[str, _Place] = {}
    for row in HEATERS:
        for name, thing in row.things(view).items():
            heater = getattr(thing, "heater", thing)
            places.update(_place(name, "heater", heaters, heater))
    for name in SENSORS.things(view):
        sensor = view.analog.get(name.partition(" ")[2])
        places.update(_place(name, "sensor", sensors, sensor))
    return places


def _place(name: str, kind: str, things: Sequence[Any], thing: Any) -> dict[str, _Place]:
    number = next((place for place, each in enumerate(things) if each is thing), None)
    return {} if thing is None or number is None else {name: (kind, number)}


def _rows(times: Sequence[float], now: float, longest: int) -> list[int]:
    """Return for each second until now the place of the row that held then."""
    if not times or now < times[0]:
        return []
    count = min(longest, int(now - times[0]) + 1)
    rows = []
    row = 0
    for second in range(1 - count, 1):
        while row + 1 < len(times) and times[row + 1] <= now + second:
            row += 1
        rows.append(row)
    return rows


def _picked(values: Sequence[float | None] | None, rows: Sequence[int]) -> list[float]:
    return [(values[row] if values is not None else None) or 0.0 for row in rows]
