"""View: what a person has to know now, each thing as a code and the numbers that belong to it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple


class Alert(NamedTuple):
    """One thing that is wrong, as long as it is."""

    code: str
    numbers: tuple[int, ...] = ()


def alerts(model: Mapping[str, Any]) -> list[Alert]:
    """Return what the model shows to be wrong, the worst first.

    ``halted``: after an emergency stop. ``off``: no supply voltage for the motors (3.5
    Platform.cpp:1522). ``heater_fault`` with the heater's number.
    """
    found = []
    state = model.get("state")
    status = state.get("status") if isinstance(state, dict) else None
    if status in ("halted", "off"):
        found.append(Alert(status))
    heat = model.get("heat")
    heaters = heat.get("heaters") if isinstance(heat, dict) else None
    for number, heater in enumerate(heaters if isinstance(heaters, list) else ()):
        if isinstance(heater, dict) and heater.get("state") == "fault":
            found.append(Alert("heater_fault", (number,)))
    return found
