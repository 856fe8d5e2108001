"""Metrics of the machine as a whole, its tools, spindles and filament monitors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from ..views.filament_monitors import FEEDING
from ..views.machine import mapping
from ..views.state_words import MONITORS, SPINDLES, STATUSES, TOOLS
from .metric import (
    GAUGE,
    Metric,
    Model,
    Sample,
    Sources,
    at,
    each,
    indexed,
    infos,
    numeric,
    one,
    states,
    states_of,
    tools,
)

AT_WORK = frozenset(
    (
        *("homing", "heating", "probing", "calibrating", "tool_change", "macro", "filament"),
        *("pausing", "resuming", "cancelling", "waiting", "saving"),
    )
)
"""What the line is doing while the machine isn't idle, in the words of the plugin's state."""

BAD_UP_TIME = 1e12
"""Seconds from which on an up-time is nonsense."""

_monitors = indexed("sensors.filamentMonitors")


def _spindles(model: Model) -> Iterator[tuple[str, Mapping[str, Any]]]:
    for index, spindle in indexed("spindles")(model):
        if spindle.get("state") != "unconfigured":
            yield index, spindle


def _enabled_monitors(sources: Sources) -> Iterator[Sample]:
    for index, monitor in _monitors(sources.model):
        # before 3.5 a truth value, since then 0 off, 1 while printing, 2 always
        mode = monitor.get("enableMode", monitor.get("enabled"))
        yield (index,), mode > 0 if isinstance(mode, (bool, int)) else None


def _monitor_errors(sources: Sources) -> Iterator[Sample]:
    for index, monitor in _monitors(sources.model):
        status = monitor.get("status")
        yield (index,), status not in FEEDING if isinstance(status, str) else None


def _up_time(sources: Sources) -> Iterator[Sample]:
    seconds, thousandths = at(sources.model, "state.upTime"), at(sources.model, "state.msUpTime")
    if numeric(seconds) and abs(seconds) < BAD_UP_TIME:
        part = thousandths / 1000 if type(thousandths) is int and 0 <= thousandths < 1000 else 0
        yield (), seconds + part


def _box_is_open(sources: Sources) -> Iterator[Sample]:
    state = mapping(sources.model.get("state"))
    if "messageBox" in state:
        yield (), state["messageBox"] is not None


def _status(sources: Sources) -> Iterator[Sample]:
    status = at(sources.model, "state.status")
    # a model from before the command that the line waits for
    is_old = status == "idle" and at(sources.status, "doing.what") in AT_WORK
    return states_of("busy" if is_old else status, STATUSES)


METRICS = (
    Metric(
        "rrf_status",
        GAUGE,
        "Status of the machine: 1 for the word that holds.",
        ("status",),
        _status,
    ),
    Metric("rrf_up_time_seconds", GAUGE, "Time since the board's last reset.", (), _up_time),
    Metric("rrf_message_box_open", GAUGE, "Whether a message box is open.", (), _box_is_open),
    Metric(
        "rrf_current_tool",
        GAUGE,
        "Number of the selected tool, -1 for none.",
        (),
        one("state.currentTool"),
    ),
    Metric(
        "rrf_atx_power",
        GAUGE,
        "Whether the power supply is switched on.",
        (),
        one("state.atxPower"),
    ),
    Metric("rrf_tool_info", GAUGE, "Name of a tool.", ("tool", "name"), infos(tools, "name")),
    Metric(
        "rrf_tool_state",
        GAUGE,
        "State of a tool: 1 for the word that holds.",
        ("tool", "state"),
        states(tools, TOOLS, "state"),
    ),
    Metric(
        "rrf_spindle_state",
        GAUGE,
        "State of a spindle: 1 for the word that holds.",
        ("spindle", "state"),
        states(_spindles, SPINDLES[1:], "state"),
    ),
    Metric(
        "rrf_spindle_speed_rpm",
        GAUGE,
        "Speed of a spindle in revolutions a minute.",
        ("spindle",),
        each(_spindles, "current"),
    ),
    Metric(
        "rrf_spindle_active_rpm",
        GAUGE,
        "Speed that a spindle was set to, in revolutions a minute.",
        ("spindle",),
        each(_spindles, "active"),
    ),
    Metric(
        "rrf_filament_monitor_enabled",
        GAUGE,
        "Whether a filament monitor is switched on.",
        ("extruder",),
        _enabled_monitors,
    ),
    Metric(
        "rrf_filament_monitor_state",
        GAUGE,
        "What a filament monitor says: 1 for the word that holds.",
        ("extruder", "state"),
        states(_monitors, MONITORS, "status"),
    ),
    Metric(
        "rrf_filament_error",
        GAUGE,
        "Whether a filament monitor says that an extruder isn't fed.",
        ("extruder",),
        _monitor_errors,
    ),
)
