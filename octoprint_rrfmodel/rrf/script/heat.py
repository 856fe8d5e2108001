"""Klipper's commands about heaters and fans."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from ..gcode import forms, operations, switch_off
from ..gcode.commands import things
from ..gcode.commands.outcome import forbidden
from ..views.machine import M568_SETS_TOOLS, array, mapping, numbers_of
from .places import extruder_number, number_of, thing_of
from .steps import At, Lines, Operation, Row, Step
from .words import Command

HEATERS = ("extruder", "heater_bed", "heater_generic")
"""Kinds of objects that can be given a temperature."""

SLOTS: tuple[tuple[str, forms.Slots], ...] = (
    ("bedHeaters", "bed"),
    ("chamberHeaters", "chamber"),
)
"""As the model and as lines call what has slots."""

_TOOL = re.compile(r"(?:extruder|tool)([0-9]*)")
"""The number of the tool in the name of one of its heaters; the first tool has none."""


def _set_heater(command: Command, at: At) -> Sequence[Step]:
    command.takes("HEATER", "TARGET")
    name, thing = thing_of(at, command.text("HEATER"), *HEATERS)
    heater = getattr(thing, "heater", thing)
    index = number_of(heater, "heat", "heaters", at=at)
    target = command.number("TARGET", 0.0)
    if target:
        things.temperature("TARGET", target, at.machine, index)
    for slot, kind in SLOTS:
        if at.view.slot(slot) is heater:
            return [_lines(operations.heat_slot(at.machine, kind, target))]
    return [_heat_tool(at, name, index, target)]


def _heat_tool(at: At, name: str, heater: int, target: float) -> Step:
    """Return what heats one heater of a tool; the tool's others keep what they have."""
    # tools may share heaters, and each has its own temperature for one
    number = int(_TOOL.findall(name)[0] or 0)
    tool = at.view.tools[number]
    heaters = array(tool.get("heaters"))
    active = numbers_of(tool.get("active"))
    if len(heaters) < 2 or len(active) != len(heaters) or at.machine.version < M568_SETS_TOOLS:
        return _lines(operations.heat_tool(at.machine, number, target))
    wanted = [target if index == heater else each for index, each in zip(heaters, active)]
    state = forms.tool_state_word("active" if any(wanted) else "off")
    return Lines((f"{forms.tool_temperatures_line(at.machine, number, wanted)} {state}",))


def _lines(outcome: operations.Outcome) -> Lines:
    if isinstance(outcome, operations.Refused):
        raise forbidden("macro_cannot")
    return Lines(outcome.lines)


def _all_off(command: Command, at: At) -> Sequence[Step]:
    command.takes()
    lines = tuple(off.line for off in switch_off.all_off(at.machine))
    return [Lines(lines)] if lines else []


def _set_fan(command: Command, at: At) -> Sequence[Step]:
    command.takes("FAN", "SPEED")
    _, fan = thing_of(at, command.text("FAN"), "fan_generic", "fan")
    number = number_of(fan, "fans", at=at)
    return [Operation("fan", {"fan": number, "speed": command.number("SPEED")})]


def _select(command: Command, at: At) -> Sequence[Step]:
    command.takes("EXTRUDER")
    number = extruder_number(at, command.text("EXTRUDER"))
    return [Operation("select_tool", {"tool": number})]


def _tune(command: Command, at: At) -> Sequence[Step]:
    command.takes("HEATER", "TARGET", "WRITE_FILE", "METHOD")
    _, thing = thing_of(at, command.text("HEATER"), *HEATERS)
    index = number_of(getattr(thing, "heater", thing), "heat", "heaters", at=at)
    target = command.number("TARGET")
    return [Operation("heater_tuning", {"heater": index, "temperature": target})]


def _has_heaters(at: At) -> bool:
    return bool(array(at.view.heat.get("heaters")))


def _has_fans(at: At) -> bool:
    return any(map(mapping, array(at.view.model.get("fans"))))


def _has_tools(at: At) -> bool:
    tools: Mapping[int, Any] = at.view.tools
    return bool(tools)


ROWS = (
    Row("SET_HEATER_TEMPERATURE", _set_heater, "Set the temperature of a heater", _has_heaters),
    Row("TURN_OFF_HEATERS", _all_off, "Switch all heaters off", _has_heaters),
    Row("SET_FAN_SPEED", _set_fan, "Set the speed of a fan, 0 to 1", _has_fans),
    Row("ACTIVATE_EXTRUDER", _select, "Select a tool (T)", _has_tools),
    Row("PID_CALIBRATE", _tune, "Tune a heater (M303)", _has_heaters),
)
