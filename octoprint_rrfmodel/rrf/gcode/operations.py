"""Printer operations by intent: what a host wants of a machine, as lines or why not.

Each takes the view of the machine first, whether it looks at it or not, then plain values in RRF's
words: axis letters as ``move.axes`` spells them, tool numbers, mm, mm/min, degrees, percent.
A host that has said it in G-code goes through ``recognition``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple, Union

from ..views.machine import M568_SETS_TOOLS, Machine, array, numbers_of
from ..wire.gcode_words import extrude_line, jog_line, number
from . import forms


class Refused(NamedTuple):
    """Nothing goes out, and a person has to know why."""

    code: str
    detail: str = ""


class Lines(NamedTuple):
    """What goes out instead, perhaps nothing, and the target that it gives a heater."""

    lines: tuple[str, ...] = ()
    heater: str = ""
    """``tool1``, ``bed``, ``chamber``: whose target the host can't see in the lines itself."""
    target: float = 0.0


NOTHING = Lines()
"""Nothing goes out, and nobody has to know."""

Outcome = Union[Lines, Refused]


def jog(
    machine: Machine, moves: Mapping[str, float], relative: bool, speed: float | None = None
) -> Outcome:
    """Return one line that moves axes by, or to, so many mm; refused where one isn't homed."""
    unhomed = machine.unhomed("".join(moves))
    if unhomed:
        return Refused("not_homed", unhomed)
    return Lines((jog_line(forms.axis_words(moves), relative, speed),))


def home(machine: Machine, axes: Iterable[str] = ()) -> Outcome:
    """Return the line that homes axes, all of them where none is named."""
    return Lines((forms.home_line(axes),))


def extrude(machine: Machine, amount: float, speed: float | None = None) -> Outcome:
    """Return one line that extrudes mm of filament; refused without a tool or with a cold one."""
    tool = machine.current_tool
    if tool is None and machine.knows_tools and machine.is_current:
        return Refused("no_tool_selected")
    if tool is not None and machine.is_cold(tool):
        return Refused("too_cold", str(tool["number"]))
    return Lines((extrude_line([amount], speed),))


def select(machine: Machine, tool: int) -> Outcome:
    """Return the line that selects a tool; refused where it would deselect all without a word."""
    if machine.knows_tools and tool not in machine.tools:
        return Refused("no_such_tool", str(tool))
    return Lines((forms.select_line(tool),))


def heat_tool(machine: Machine, tool: int | None, target: float) -> Outcome:
    """Return the lines that heat a tool, with 0 switch it off; refused where it isn't there.

    ``None`` is the one that M104 without T means: only the firmware knows which that will be while
    another is being selected.
    """
    if tool is None and not machine.is_current:
        return Lines((f"M104 S{number(target)}",))
    meant = machine.default_tool if tool is None else machine.tools.get(tool)
    if meant is None:
        if not machine.knows_tools:
            chosen = "" if tool is None else f" T{tool}"
            return Lines((f"M104 S{number(target)}{chosen}",))
        return Refused("no_such_tool", "" if tool is None else str(tool))
    heat = _heat_with_m568 if machine.version >= M568_SETS_TOOLS else _heat_with_m104
    return Lines(heat(machine, meant, target), f"tool{meant['number']}", target)


def _heat_with_m568(machine: Machine, tool: Mapping[str, Any], target: float) -> tuple[str, ...]:
    name = tool["number"]
    # the model may not tell how many heaters it has
    active = [target] * (len(array(tool.get("heaters"))) or 1)
    state = forms.tool_state_word("active" if target else "off")
    return (f"{forms.tool_temperatures_line(machine, name, active)} {state}",)


def _heat_with_m104(machine: Machine, tool: Mapping[str, Any], target: float) -> tuple[str, ...]:
    if not target:
        return (forms.tool_off_line(machine, tool),)
    name, standby = tool["number"], numbers_of(tool.get("standby"))
    line = f"M104 T{name} S{number(target)}"
    current = machine.current_tool
    if current is not None and current["number"] == name and standby:
        # M104 has set the standby temperature too
        return line, forms.tool_temperatures_line(machine, name, standby=standby)
    return (line,)


def heat_slot(machine: Machine, kind: forms.Slots, target: float) -> Outcome:
    """Return the line that heats a bed or chamber, with 0 switches it off; refused without one.

    It is the first slot with a heater.
    """
    slot = machine.slot(f"{kind}Heaters")
    if slot is None:
        return Refused(f"no_{kind}")
    if target:
        line = forms.slot_temperatures_line(kind, slot, target)
    else:
        line = forms.slot_off_line(machine, kind, slot)
    return Lines((line,), kind, target)


def speed_factor(machine: Machine, percent: float) -> Outcome:
    """Return the line that sets the factor of all speeds, to hosts also the feed rate."""
    return Lines((forms.speed_factor_line(percent),))


def extrusion_factor(machine: Machine, percent: float) -> Outcome:
    """Return a line for each extruder of the current tool; refused without one.

    To hosts that factor is also the flow rate. Which tool it will be only the firmware knows while
    one is being selected.
    """
    tool = machine.current_tool
    if not machine.is_current:
        return Lines((forms.current_extrusion_factor_line(percent),))
    if tool is None:
        return Refused("no_tool_selected")
    extruders = numbers_of(tool.get("extruders"))
    return Lines(tuple(forms.extrusion_factor_line(int(each), percent) for each in extruders))
