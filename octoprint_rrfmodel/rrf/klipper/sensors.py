"""Filament monitors, outputs, endstops, probes, and macros with the global variables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from ..views.machine import array, mapping
from ..wire.gcode_words import quoted
from .macro_names import macro_names
from .printer import Model, Printer
from .sections import PIN
from .values import element, named, number, text, truth
from .view import Row, View, each, one, where

OF_PRINTS = ("PAUSE", "RESUME", "CANCEL_PRINT")
"""Macros that clients want to be there; what they do is Moonraker's."""

DETECTED = {
    "noFilament": False,
    "ok": True,
    "tooLittleMovement": True,
    "tooMuchMovement": True,
    "noDataReceived": True,
    "sensorError": True,
    "noMonitor": True,
}
"""Words of a monitor's ``status``; nothing but missing filament is reported as that."""

SEE_MOTION = frozenset(("laser", "rotatingMagnet"))
"""Types of monitors that measure how far filament moves."""


class Macro(NamedTuple):
    """A macro: what is sent for it, and the variables that clients see in it."""

    gcode: str
    variables: Mapping[str, Any] = {}


def _sensors(view: Printer, kind: str) -> list[Model]:
    return [mapping(sensor) for sensor in array(mapping(view.model.get("sensors")).get(kind))]


def _monitors(view: Printer) -> dict[str, Model]:
    drives = len(array(view.move.get("extruders")))
    return named(
        (f"extruder{index}" if index < drives else "", f"monitor{index}", monitor)
        for index, monitor in enumerate(_sensors(view, "filamentMonitors"))
        if monitor
    )


def _motion_monitors(view: Printer) -> dict[str, Model]:
    return {
        name: monitor
        for name, monitor in _monitors(view).items()
        if text(monitor.get("type")) in SEE_MOTION
    }


def _enabled(view: View, monitor: Model) -> bool:
    mode = monitor.get("enableMode", monitor.get("enabled"))
    return mode is True or (number(mode) or 0) > 0


_MONITOR = {
    "filament_detected": lambda view, monitor: DETECTED.get(text(monitor.get("status"))),
    "enabled": _enabled,
}


def _outputs(view: Printer) -> dict[str, Model]:
    outputs = array(view.state.get("gpOut"))
    return {
        f"gpOut{index}": mapping(output) for index, output in enumerate(outputs) if mapping(output)
    }


def _endstops(view: Printer) -> dict[str, int]:
    """Return for each axis with an endstop whether that is triggered."""
    states = []
    for letter, endstop in zip(view.axes, _sensors(view, "endstops")):
        triggered = truth(endstop.get("triggered"))
        if triggered is not None:
            # A and a are two axes
            states.append((letter.lower(), f"'{letter}", int(triggered)))
    return named(states)


def _probe(view: Printer) -> Any:
    """Return the first probe. Type 0 is none; M408 tells a value without a threshold then."""
    probe = element(mapping(view.model.get("sensors")).get("probes"), 0)
    return probe if probe.get("type") != 0 and "threshold" in probe else {}


def _is_triggered(view: View, probe: Model) -> bool | None:
    values = array(probe.get("value"))
    value, threshold = number(values[0]) if values else None, number(probe.get("threshold"))
    return None if value is None or threshold is None else value >= threshold


def _macros(view: View) -> Mapping[str, Any]:
    macros = {
        name: Macro(f"M98 P{quoted(path)}") for name, path in macro_names(view.host.macros).items()
    }
    variables = view.model.get("global")
    if isinstance(variables, Mapping):
        macros["globals"] = Macro("", variables)
    return macros


def _of_prints(view: View) -> Mapping[str, Any]:
    return {name: name for name in OF_PRINTS}


def _of_tools(view: View) -> Mapping[str, Any]:
    """Return for each tool what selects it, where there is a choice."""
    tools = sorted(view.tools)
    return {f"T{tool}": tool for tool in tools} if len(tools) > 1 else {}


def _renamed(name: str) -> dict[str, str]:
    """Return the section of a macro that clients need no button for, by which they know it."""
    return {"gcode": name, "rename_existing": f"BASE_{name}"}


ROWS = (
    Row("filament_switch_sensor X", each("filament_switch_sensor", _monitors), _MONITOR),
    Row("filament_motion_sensor X", each("filament_motion_sensor", _motion_monitors), _MONITOR),
    Row(
        "output_pin X",
        each("output_pin", _outputs),
        {"value": lambda view, output: number(output.get("pwm")) or 0.0},
        settings=lambda view, output: {"pin": PIN, "pwm": True},
    ),
    Row(
        "query_endstops",
        where("query_endstops", lambda view: any(_sensors(view, "endstops"))),
        {"last_query": lambda view, _: _endstops(view)},
    ),
    Row(
        "probe",
        where("probe", _probe),
        {
            "name": lambda view, _: "probe",
            "last_query": _is_triggered,
            "last_z_result": lambda view, probe: number(probe.get("lastStopHeight")),
        },
    ),
    Row("manual_probe", one("manual_probe"), {"is_active": lambda view, _: False}),
    Row(
        "gcode_macro PAUSE",
        each("gcode_macro", _of_prints),
        {},
        settings=lambda view, name: _renamed(name),
    ),
    Row(
        "gcode_macro TN",
        each("gcode_macro", _of_tools),
        {"active": lambda view, tool: view.state.get("currentTool") == tool},
        settings=lambda view, tool: _renamed(f"T{tool}"),
    ),
    Row(
        "gcode_macro X",
        each("gcode_macro", _macros),
        {},
        members=lambda macro: macro.variables,
        settings=lambda view, macro: {"gcode": macro.gcode},
    ),
)
