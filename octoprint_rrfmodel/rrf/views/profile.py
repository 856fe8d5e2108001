"""View: what a host that keeps a profile of the printer should have in it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .machine import Machine, array, mapping

ROUND = ("delta", "lineardelta", "rotary delta", "hangprinter")
"""Words of ``move.kinematics.name``, in small letters, whose bed is round and whose origin is its
centre (3.5 Kinematics.cpp and those derived from it; a delta is a linear one from 3.7 on)."""

MOST_EXTRUDERS = 99
"""A host takes no more."""

TOO_LONG_MM = 10_000
"""A host takes no side of a volume that is as long as this."""

CENTRED_MM = 1.0
"""How far from the middle of an axis the origin may be and still be its centre."""

Model = Mapping[str, Any]


def profile_values(model: Model) -> dict[str, Any]:
    """Return the values by path, as ``volume.width``; what the model doesn't tell isn't there.

    Lengths are in mm, speeds in mm/min as in ``move.axes[].speed``. ``volume.custom_box`` is
    ``False`` or the limits of X, Y and Z where an axis goes below its origin.
    """
    return {**_volume(model), **_speeds(model), **_tools(model), **_heaters(model)}


def _axes(model: Model) -> dict[str, Model]:
    axes = map(mapping, array(mapping(model.get("move")).get("axes")))
    return {axis["letter"]: axis for axis in axes if isinstance(axis.get("letter"), str)}


def _limits(model: Model) -> list[tuple[float, float]] | None:
    axes = _axes(model)
    found = []
    for letter in "XYZ":
        low, high = (_real(axes.get(letter, {}).get(end)) for end in ("min", "max"))
        # a router's Z ends at 0 and goes down from there
        if low is None or high is None or high <= (low if letter == "Z" else max(low, 0.0)):
            return None
        found.append((low, high))
    return found


def _volume(model: Model) -> dict[str, Any]:
    limits = _limits(model)
    if limits is None:
        return {}
    x, y, z = limits
    kinematics = mapping(mapping(model.get("move")).get("kinematics")).get("name")
    if isinstance(kinematics, str) and kinematics.lower() in ROUND:
        across = 2 * min(-x[0], x[1], -y[0], y[1])
        if across <= 0:
            return {}
        shape, origin, width, depth = "circular", "center", across, across
    elif all(abs(low + high) <= CENTRED_MM for low, high in (x, y)):
        shape, origin, width, depth = "rectangular", "center", x[1] - x[0], y[1] - y[0]
    else:
        shape, origin, width, depth = "rectangular", "lowerleft", x[1], y[1]
    height = z[1] if z[1] > 0 else z[1] - z[0]
    if max(width, depth, height) >= TOO_LONG_MM:
        return {}
    values: dict[str, Any] = {
        "volume.formFactor": shape,
        "volume.origin": origin,
        "volume.width": width,
        "volume.depth": depth,
        "volume.height": height,
        "volume.custom_box": False,
    }
    if z[0] < 0 or (origin == "lowerleft" and min(x[0], y[0]) < 0):
        # a host makes it no smaller than size and origin do
        box = {}
        lengths = [(width, origin == "center"), (depth, origin == "center"), (height, False)]
        for letter, (low, high), (length, is_centred) in zip("xyz", limits, lengths):
            start = -length / 2 if is_centred else 0.0
            box[f"{letter}_min"] = min(low, start)
            box[f"{letter}_max"] = max(high, start + length)
        values["volume.custom_box"] = box
    return values


def _speeds(model: Model) -> dict[str, Any]:
    axes = _axes(model)
    values = {}
    for letter in "XYZ":
        speed = _real(axes.get(letter, {}).get("speed"))
        if speed:
            values[f"axes.{letter.lower()}.speed"] = round(speed)
    extruders = map(mapping, array(mapping(model.get("move")).get("extruders")))
    feeding = [speed for extruder in extruders if (speed := _real(extruder.get("speed")))]
    if feeding:
        values["axes.e.speed"] = round(min(feeding))
    return values


def _tools(model: Model) -> dict[str, Any]:
    tools = Machine(model).tools
    if not tools:
        return {}
    heaters = [tuple(array(tool.get("heaters"))) for tool in tools.values()]
    is_shared = len(heaters) > 1 and bool(heaters[0]) and len(set(heaters)) == 1
    # numbers may leave gaps, and the host counts from 0
    reachable = [number for number in tools if number < MOST_EXTRUDERS]
    count = {"extruder.count": max(reachable) + 1} if reachable else {}
    return {**count, "extruder.sharedNozzle": is_shared}


def _heaters(model: Model) -> dict[str, Any]:
    if "heat" not in model:
        return {}
    machine = Machine(model)
    return {
        "heatedBed": machine.slot("bedHeaters") is not None,
        "heatedChamber": machine.slot("chamberHeaters") is not None,
    }


def _real(value: Any) -> float | None:
    return float(value) if type(value) in (int, float) else None
