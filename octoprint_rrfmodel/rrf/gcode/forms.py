"""Lines that go to a board: each form of G-code stands here once.

What may go out at all is decided elsewhere, in ``operations`` and ``commands``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal

from ..views.machine import HAS_EXPRESSIONS, M568_SETS_TOOLS, Machine, array
from ..wire.gcode_words import axis_word, number, numbers

OFF = "-273.15"
"""A temperature that switches a heater off (3.5 Tool.cpp:788); 0 leaves it active."""

TOOL_STATES = ("off", "standby", "active")
"""States of a tool's heaters, in the order of M568's numbers."""

Slots = Literal["bed", "chamber"]
"""What has slots for heaters."""

SLOT_CODES: Mapping[Slots, str] = {"bed": "M140", "chamber": "M141"}
"""What has slots to the command that sets the temperatures of one."""


def axis_words(values: Mapping[str, float]) -> list[str]:
    """Return a word for each axis; lower-case letters are axes of their own."""
    return [axis_word(letter, number(value)) for letter, value in values.items()]


def home_line(axes: Iterable[str]) -> str:
    """Return the line that homes the axes, all of them where none is named."""
    return " ".join(["G28", *map(axis_word, axes)])


def select_line(tool: int) -> str:
    """Return the line that selects a tool; -1 is none."""
    return f"T{tool}"


WORKPLACES = 9
"""Coordinate systems, G54 to G59.3."""


def workplace_line(workplace: int) -> str:
    """Return the line that chooses a workplace, counted from 1.

    >>> workplace_line(1), workplace_line(6), workplace_line(9)
    ('G54', 'G59', 'G59.3')
    """
    return f"G{53 + workplace}" if workplace < 7 else f"G59.{workplace - 6}"


def set_zero_line(axes: Iterable[str], workplace: int) -> str:
    """Return the line that makes the present place of the axes zero in a workplace."""
    return f"G10 L20 P{workplace} {' '.join(axis_words(dict.fromkeys(axes, 0)))}"


def speed_factor_line(percent: float) -> str:
    """Return the line that sets the factor of all speeds."""
    return f"M220 S{number(percent)}"


def extrusion_factor_line(extruder: int, percent: float) -> str:
    """Return the line that sets the factor of one extruder.

    Without D it would be the current tool's, and an error where none is selected.
    """
    return f"M221 D{extruder} S{number(percent)}"


def current_extrusion_factor_line(percent: float) -> str:
    """Return the line that sets the factor of whatever tool will be the current one by then."""
    return f"M221 S{number(percent)}"


def tool_temperatures_line(
    machine: Machine,
    tool: int,
    active: Sequence[float] | None = None,
    standby: Sequence[float] | None = None,
) -> str:
    """Return the line that sets temperatures of a tool's heaters, and switches none on or off.

    From 3.3 on that is M568 (3.5 GCodes2.cpp:3776), before G10.
    """
    words = ["M568" if machine.version >= M568_SETS_TOOLS else "G10", f"P{tool}"]
    for letter, temperatures in (("S", active), ("R", standby)):
        if temperatures is not None:
            words.append(f"{letter}{numbers(temperatures)}")
    return " ".join(words)


def tool_state_line(tool: int, state: str) -> str:
    """Return the line that gives a tool's heaters a state, on firmware with M568."""
    return f"M568 P{tool} {tool_state_word(state)}"


def tool_state_word(state: str) -> str:
    """Return the word of M568 that gives a state, behind temperatures or alone."""
    return f"A{TOOL_STATES.index(state)}"


def tool_off_line(machine: Machine, tool: Mapping[str, Any]) -> str:
    """Return the line that switches a tool's heaters off."""
    name = tool["number"]
    if machine.version >= M568_SETS_TOOLS:
        return tool_state_line(name, "off")
    off = _off_except_those_of(machine.current_tool, tool)
    return f"G10 P{name} S{off} R{off}"


def _off_except_those_of(current: Mapping[str, Any] | None, tool: Mapping[str, Any]) -> str:
    """Return temperatures that switch a tool's heaters off, 0 for one that the current tool uses.

    G10 would switch that off too (2.05 Tool.cpp, SetToolHeaterStandbyTemperature); M568 doesn't.
    """
    is_other = current is not None and current.get("number") != tool.get("number")
    others = array(current.get("heaters")) if current is not None and is_other else []
    own = array(tool.get("heaters")) or [None]
    return ":".join("0" if index in others else OFF for index in own)


def slot_temperatures_line(
    kind: Slots, slot: int, active: float | None = None, standby: float | None = None
) -> str:
    """Return the line that sets temperatures of a slot.

    The active one also switches the heater on (3.5 GCodes2.cpp:2225).
    """
    words = [SLOT_CODES[kind], f"P{slot}"]
    for letter, temperature in (("S", active), ("R", standby)):
        if temperature is not None:
            words.append(f"{letter}{number(temperature)}")
    return " ".join(words)


def slot_off_line(machine: Machine, kind: Slots, slot: int) -> str:
    """Return the line that switches the heater of a slot off.

    A host that looks for S would take the temperature in it for a target, so it stands in an
    expression, or behind another command where the firmware has none.
    """
    code = SLOT_CODES[kind]
    if machine.version >= HAS_EXPRESSIONS:
        return f"{code} P{slot} S{{{OFF}}}"
    return f"M120 {code} P{slot} S{OFF} M121"
