"""A report of temperatures as members of the model, for while it can't be asked for."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ..views.machine import Machine, array, mapping
from ..wire.report import Entry

SLOTS = {"B": "bedHeaters", "C": "chamberHeaters"}

WITHOUT_TARGET = ("fault", "offline", "tuning")
"""States of a heater in which a report's target says nothing of its own."""


def members_of(report: list[Entry], model: Mapping[str, Any]) -> dict[int, dict[str, Any]]:
    """Return what a report tells of each heater that the model has, by the heater's index."""
    heaters = array(mapping(model.get("heat")).get("heaters"))
    members: dict[int, dict[str, Any]] = {}
    for entry in report:
        for index, (current, target) in zip(_heaters(entry, model), entry.pairs):
            if isinstance(index, int) and 0 <= index < len(heaters):
                heater = mapping(heaters[index])
                if "current" in heater:
                    members[index] = {"current": current, **_target(heater, target)}
    return members


def patch_of(members: Mapping[int, Mapping[str, Any]], model: Mapping[str, Any]) -> dict[str, Any]:
    """Return those members in the form of a live reply, in which nothing else changes."""
    heaters = array(mapping(model.get("heat")).get("heaters"))
    patched = [
        dict(members.get(index, {})) if isinstance(heater, dict) else heater
        for index, heater in enumerate(heaters)
    ]
    return {"heat": {"heaters": patched}}


def _heaters(entry: Entry, model: Mapping[str, Any]) -> Iterator[Any]:
    if entry.kind == "T":
        yield from array(mapping(Machine(model).tools.get(entry.number)).get("heaters"))
        return
    slots = array(mapping(model.get("heat")).get(SLOTS[entry.kind]))
    if entry.number < len(slots):
        yield slots[entry.number]


def _target(heater: Mapping[str, Any], target: float) -> dict[str, Any]:
    """Return state and temperatures that fit a target, which is that of the heater's state.

    M104 and M109 set both temperatures of a tool, M140 and the like switch on what was off.
    """
    state = heater.get("state")
    if state in WITHOUT_TARGET:
        return {}
    if state == "standby":
        if target == heater.get("standby"):
            return {}
        if target == heater.get("active"):
            return {"state": "active"}
        return {"active": target, "standby": target}
    if state == "active":
        return {} if target == heater.get("active") else {"active": target}
    return {"state": "active", "active": target} if target > 0 else {}
