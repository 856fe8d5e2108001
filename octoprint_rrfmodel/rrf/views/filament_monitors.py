"""View: what the filament monitors say of what the current tool is fed with."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from .board_warnings import Found
from .machine import Machine, array, mapping

Model = Mapping[str, Any]

FEEDING = frozenset(("ok", "noDataReceived", "noMonitor", "", None))
"""Words of ``sensors.filamentMonitors[].status`` that say nothing bad of the filament; a monitor
that has just been switched on has received no data."""

ONLY_OWN_PRINTS = 1
"""``sensors.filamentMonitors[].enableMode`` of a monitor that acts only while the board itself
prints (M591 S1; told from 3.5 on)."""


def _monitors(model: Model) -> Iterator[tuple[int, Mapping[str, Any]]]:
    """Yield each filament monitor that is on and watches what the current tool is fed with."""
    tool = Machine(model).current_tool
    fed = None if tool is None else tool.get("extruders")
    for number, monitor in enumerate(array(mapping(model.get("sensors")).get("filamentMonitors"))):
        monitor = mapping(monitor)
        # 0 is off, 1 while printing, 2 always; before 3.5 a truth value
        is_on = monitor.get("enableMode", monitor.get("enabled"))
        if is_on and (not isinstance(fed, list) or number in fed):
            yield number, monitor


def unfed(model: Model) -> Iterator[Found]:
    """Yield each monitor that says something against feeding."""
    for number, monitor in _monitors(model):
        status = monitor.get("status")
        if not isinstance(status, (str, type(None))) or status not in FEEDING:
            yield Found((number,))


def only_own_prints(model: Model) -> Iterator[Found]:
    """Yield each monitor that acts only while the board itself prints."""
    for number, monitor in _monitors(model):
        if monitor.get("enableMode") == ONLY_OWN_PRINTS:
            yield Found((number,))
