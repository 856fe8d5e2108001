"""Lines for moving, extruding and choosing tools."""

from __future__ import annotations

from collections.abc import Sequence

from ...views.machine import Machine, array, mapping
from ...wire.gcode_words import axis_word, extrude_line, number
from .. import forms, operations
from . import things
from .outcome import Request, bad, forbidden
from .parameters import HUGE, is_number, missing, number_or, within

CLAMPED = 1.0
"""Millimetres to which the firmware cuts a relative baby step without a word (3.5
GCodes2.cpp, M290)."""

SLACK = 0.5
"""Millimetres by which a place may be beyond an axis before it is refused: positions are rounded,
and baby steps and compensation shift them. The firmware has the last word."""


def select_tool(request: Request) -> Sequence[str]:
    """T; -1 is no tool."""
    return [forms.select_line(request.values["tool"])]


def home(request: Request) -> Sequence[str]:
    """G28; without letters it homes every axis."""
    return [forms.home_line(request.values["axes"])]


def jog(request: Request) -> Sequence[str]:
    """One line with G1 in it."""
    values, machine = request.values, request.machine
    moves = values["axes"]
    if values["absolute"]:
        for letter, place in moves.items():
            _check_place(machine, letter, place)
    outcome = operations.jog(machine, moves, not values["absolute"], values["speed"])
    if isinstance(outcome, operations.Refused):
        raise forbidden(outcome.code, axes=", ".join(outcome.detail))
    return outcome.lines


def _check_place(machine: Machine, letter: str, place: float) -> None:
    """Refuse a place outside of an axis; places count from the workplace's zero."""
    axis = (things.axes_of(machine) or {}).get(letter, {})
    limits = [axis.get(name) for name in ("min", "max", "machinePosition", "userPosition")]
    # off after M564 S0, and there are no limits where the axis isn't homed
    limited = mapping(machine.model.get("move")).get("limitAxes") is not False
    if not machine.is_current:
        # another tool or workplace, or an axis just homed, has other limits
        return
    if not limited or axis.get("homed") is False or not all(map(is_number, limits)):
        return
    low, high, on_machine, shown = (float(limit or 0) for limit in limits)
    offset = on_machine - shown
    if not low - SLACK <= place + offset <= high + SLACK:
        raise bad("outside", axis=letter, low=number(low - offset), high=number(high - offset))


def extrude(request: Request) -> Sequence[str]:
    """One line with G1 E in it, for the tool that is selected."""
    machine, amounts = request.machine, request.values["amounts"]
    several = amounts if isinstance(amounts, tuple) else (amounts,)
    tool = machine.current_tool
    if tool is None:
        if machine.knows_tools and machine.is_current:
            raise forbidden("no_tool_selected")
    else:
        extruders = tool.get("extruders")
        count = len(extruders) if isinstance(extruders, list) else len(several)
        is_wrong = len(several) != count and machine.is_current
        if is_wrong and isinstance(amounts, tuple):
            raise bad("wrong_count", parameter="amounts", count=str(count))
        if machine.is_cold(tool, retracts=all(amount <= 0 for amount in several)):
            raise forbidden("too_cold", tool=str(tool["number"]))
    return [extrude_line(several, request.values["speed"])]


CNC = "CNC"
"""``state.machineMode`` in which spindles turn; set with M453."""


def spindle(request: Request) -> Sequence[str]:
    """M3, M4, M5.

    Beyond its limits the firmware takes the nearest speed that the spindle has (3.5 Spindle.cpp,
    SetRpm), which may be far from what was asked for.
    """
    machine, values = request.machine, request.values
    mode = mapping(machine.model.get("state")).get("machineMode")
    if mode != CNC and machine.is_current:
        raise forbidden("not_cnc")
    place, rpm = values["spindle"], values["rpm"]
    spindles = array(machine.model.get("spindles"))
    known = mapping(spindles[place]) if place < len(spindles) else {}
    if rpm:
        within("rpm", rpm, number_or(known.get("min"), 0), number_or(known.get("max"), HUGE))
    turns_back = values["direction"] == "reverse"
    if turns_back and known.get("canReverse") is False:
        raise bad("cannot_reverse", spindle=str(place))
    if not rpm:
        return [f"M5 P{place}"]
    return [f"{'M4' if turns_back else 'M3'} P{place} S{round(rpm)}"]


def tool_offsets(request: Request) -> Sequence[str]:
    """G10; the other axes keep theirs."""
    values = request.values
    return [f"G10 P{values['tool']} {' '.join(forms.axis_words(values['offsets']))}"]


def workplace(request: Request) -> Sequence[str]:
    """G54 to G59.3, counted from 1 as G10 does."""
    return [forms.workplace_line(request.values["workplace"])]


def set_zero(request: Request) -> Sequence[str]:
    """G10 L20: where the axes are now is zero in that workplace; the others keep theirs.

    Without one it is the workplace that is chosen, as far as that is known.
    """
    values, machine = request.values, request.machine
    axes = values["axes"] or tuple(things.axes_of(machine) or {})
    if not axes:
        raise bad("not_letters", parameter="axes")
    workplace = values["workplace"]
    if workplace is None:
        known = mapping(machine.model.get("move")).get("workplaceNumber")
        if not isinstance(known, int) or not machine.is_current:
            raise missing("workplace")
        workplace = known + 1
    return [forms.set_zero_line(axes, workplace)]


def babystep(request: Request) -> Sequence[str]:
    """M290; R0 makes the amount absolute."""
    axis, amount = request.values["axis"], request.values["amount"]
    if request.values["absolute"]:
        return [f"M290 R0 {axis_word(axis, number(amount))}"]
    if abs(amount) > CLAMPED:
        raise bad("out_of_range", parameter="amount", low=number(-CLAMPED), high=number(CLAMPED))
    return [f"M290 {axis_word(axis, number(amount))}"]


def speed_factor(request: Request) -> Sequence[str]:
    """M220."""
    return [forms.speed_factor_line(request.values["percent"])]


def extrusion_factor(request: Request) -> Sequence[str]:
    """M221; without D it would be the current tool's extruders."""
    return [forms.extrusion_factor_line(request.values["extruder"], request.values["percent"])]
