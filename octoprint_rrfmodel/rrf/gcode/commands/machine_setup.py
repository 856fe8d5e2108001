"""Lines that set up, tune and try a machine."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from ...views.machine import Machine, array, mapping
from ...wire.gcode_words import axis_word, jog_line, number, numbers, quoted
from .. import forms
from . import things
from .outcome import Request, bad, forbidden
from .parameters import is_number, listed, missing, sendable, shown
from .parameters import number as any_number

SHAPERS = ("none", "mzv", "zvd", "zvdd", "zvddd", "ei2", "ei3")
"""Names of M593 (3.4 AxisShaper.cpp); what it calls custom has more numbers than these."""

CONDITIONS = ("disabled", "tooHigh", "tooLow")
"""Of a heater's monitor, in the order of M143's numbers, which begin with -1."""

PROBINGS = {"measure": "G30{} S-1", "set_z": "G30{}"}
"""What comes of probing where the head is: the height is told, or Z is what the probe says."""

RETURN_SPEED = 6000.0
"""In mm/min, to a place that was kept: the last feed rate may be that of filament."""

MONITORS_SINCE = (3, 1)
TOOL_TUNING_SINCE = (3, 2)
VARIABLES_SINCE = (3, 3)
SHAPERS_SINCE = (3, 4)
STRIPS_SINCE = (3, 5)

_NUMBER = any_number()
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*", re.ASCII)


def _needs(machine: Machine, since: tuple[int, int]) -> None:
    """Refuse what came with a later firmware."""
    if machine.version < since:
        raise forbidden("needs_firmware", version=".".join(map(str, since)))


def pressure_advance(request: Request) -> Sequence[str]:
    """M572."""
    return [f"M572 D{request.values['extruder']} S{number(request.values['seconds'])}"]


def input_shaping(request: Request) -> Sequence[str]:
    """M593; what is left out stays."""
    values = request.values
    _needs(request.machine, SHAPERS_SINCE)
    words = [f'M593 P"{values["type"]}"']
    for letter, name in (("F", "frequency"), ("S", "damping")):
        if values[name] is not None:
            words.append(f"{letter}{number(values[name])}")
    return [" ".join(words)]


def motor_current(request: Request) -> Sequence[str]:
    """M906 of an axis, or of all extruders, the others of which keep theirs."""
    values, milliamps = request.values, request.values["milliamps"]
    axis, extruder = values["axis"], values["extruder"]
    if (axis is None) == (extruder is None):
        raise bad("one_of", known=listed(["axis", "extruder"]))
    if axis is not None:
        return [f"M906 {axis_word(axis, number(milliamps))}"]
    drives = array(mapping(request.machine.model.get("move")).get("extruders"))
    told: list[Any] = [mapping(drive).get("current") for drive in drives] or [None] * (extruder + 1)
    told[extruder] = milliamps
    if not all(map(is_number, told)):
        raise forbidden("currents_unknown")
    return [f"M906 E{numbers(told)}"]


def save_parameters(request: Request) -> Sequence[str]:
    """M500: what it keeps is the firmware's to say."""
    return ["M500"]


def heater_tuning(request: Request) -> Sequence[str]:
    """M303: of a tool, where it is the tool's first heater, so that its fans count too."""
    machine, heater = request.machine, request.values["heater"]
    target = things.temperature("temperature", request.values["temperature"], machine, heater)
    owners = [
        place
        for place, tool in sorted(machine.tools.items())
        if array(tool.get("heaters"))[:1] == [heater]
    ]
    is_of_tool = bool(owners) and machine.version >= TOOL_TUNING_SINCE
    return [f"M303 {f'T{owners[0]}' if is_of_tool else f'H{heater}'} S{number(target)}"]


def heater_monitor(request: Request) -> Sequence[str]:
    """M143; one that is disabled needs no limit."""
    values = request.values
    _needs(request.machine, MONITORS_SINCE)
    words = [f"M143 H{values['heater']} P{values['monitor']}"]
    condition = CONDITIONS.index(values["condition"]) - 1
    if condition >= 0:
        if values["limit"] is None:
            raise missing("limit")
        words.append(f"S{number(values['limit'])} A{values['action']}")
    return [" ".join([*words, f"C{condition}"])]


def _probe_word(values: Mapping[str, Any]) -> str:
    # firmware without several probes has no K
    return f" K{values['probe']}" if values["probe"] else ""


def probe(request: Request) -> Sequence[str]:
    """G30 where the head is."""
    return [PROBINGS[request.values["action"]].format(_probe_word(request.values))]


def probe_height(request: Request) -> Sequence[str]:
    """G31 Z: the height of the nozzle at which the probe triggers."""
    values = request.values
    return [f"G31{_probe_word(values)} Z{number(values['height'])}"]


def output(request: Request) -> Sequence[str]:
    """M42."""
    return [f"M42 P{request.values['output']} S{number(request.values['value'])}"]


def led(request: Request) -> Sequence[str]:
    """M150: the first LEDs of a strip."""
    _needs(request.machine, STRIPS_SINCE)
    values = request.values
    return [
        f"M150 E{values['strip']} R{values['red']} U{values['green']} B{values['blue']}"
        f" P{values['brightness']} S{values['count']} F0"
    ]


def read_value(name: str, value: Any, machine: Machine) -> Any:
    """Return what a variable may be given: a number, a truth value or a text."""
    if isinstance(value, bool):
        return value
    return _NUMBER(name, value, machine) if is_number(value) else sendable(name, value)


def variable(request: Request) -> Sequence[str]:
    """``set global.``: one that a macro has made."""
    values, machine = request.values, request.machine
    _needs(machine, VARIABLES_SINCE)
    name, value = values["name"], values["value"]
    known = mapping(machine.model.get("global"))
    if not _NAME.fullmatch(name) or (known and name not in known):
        raise bad("no_such_variable", value=shown(name), known=listed(sorted(known)))
    return [f"set global.{name} = {_expression(value)}"]


def _expression(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return quoted(value)
    return number(value)


def restore_point(request: Request) -> Sequence[str]:
    """G60, and the way back: all axes that are told, or those that are named."""
    values, machine = request.values, request.machine
    point = values["point"]
    if values["action"] == "save":
        return [f"G60 S{point}"]
    axes = values["axes"] or tuple(things.axes_of(machine) or {})
    if not axes:
        raise bad("not_letters", parameter="axes")
    unhomed = machine.unhomed("".join(axes))
    if unhomed:
        raise forbidden("not_homed", axes=", ".join(unhomed))
    words = [f"R{point}", *forms.axis_words(dict.fromkeys(axes, 0))]
    return [jog_line(words, False, RETURN_SPEED)]


def resume_after_power_loss(request: Request) -> Sequence[str]:
    """M916."""
    return ["M916"]


def firmware_update(request: Request) -> Sequence[str]:
    """M997: with what lies on the card; 0 is the main board, others go by their CAN address."""
    board = request.values["board"]
    return [f"M997 B{board}" if board else "M997 S0"]
