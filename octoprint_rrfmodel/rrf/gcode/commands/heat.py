"""Lines for heaters and fans."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Callable, Union

from ...views.machine import M568_SETS_TOOLS, Machine
from ...wire.gcode_words import number
from .. import forms
from . import things
from .outcome import Request, bad, forbidden
from .parameters import is_number, listed

Temperatures = Union[float, tuple[float, ...]]

TEMPERATURES = ("active", "standby")
"""What there is to set for tools, beds and chambers."""


def tool_temperatures(request: Request) -> Sequence[str]:
    """M568, before 3.3 G10: for each heater of the tool, and it switches none on or off."""
    machine, values = request.machine, request.values
    tool = values["tool"]
    wanted = {
        name: _for_each_heater(name, values[name], machine, tool)
        for name in TEMPERATURES
        if values[name] is not None
    }
    if not wanted:
        raise bad("nothing_to_do", known=listed(TEMPERATURES))
    return [forms.tool_temperatures_line(machine, tool, **wanted)]


def _for_each_heater(
    name: str, given: Temperatures, machine: Machine, number_of_tool: int
) -> list[float]:
    tool = machine.tools.get(number_of_tool, {})
    heaters = tool.get("heaters")
    if heaters == []:
        raise bad("no_heater", tool=str(number_of_tool))
    if not isinstance(heaters, list):
        # nobody knows which heaters it has
        heaters = [-1] * (len(given) if isinstance(given, tuple) else 1)
    wanted = given if isinstance(given, tuple) else (given,) * len(heaters)
    if len(wanted) != len(heaters):
        raise bad("wrong_count", parameter=name, count=str(len(heaters)))
    return [
        things.temperature(name, value, machine, index) for value, index in zip(wanted, heaters)
    ]


def tool_state(request: Request) -> Sequence[str]:
    """M568 A; before 3.3 only off, by temperatures below the coldest."""
    machine, number_of_tool = request.machine, request.values["tool"]
    state = request.values["state"]
    tool: dict[str, Any] = {"number": number_of_tool, **machine.tools.get(number_of_tool, {})}
    if tool.get("heaters") == []:
        raise bad("no_heater", tool=str(number_of_tool))
    if state == "off":
        return [forms.tool_off_line(machine, tool)]
    if machine.version < M568_SETS_TOOLS:
        raise forbidden("tool_state_firmware", version="3.3")
    return [forms.tool_state_line(number_of_tool, state)]


def slot_temperatures(kind: forms.Slots) -> Callable[[Request], Sequence[str]]:
    """Return the function for M140 or M141: temperatures first, the state last.

    S also switches the heater on (3.5 GCodes2.cpp:2225), so that whatever else is asked for comes
    after it.
    """

    def lines(request: Request) -> Sequence[str]:
        machine, values = request.machine, request.values
        slot = values["index"]
        heater = things.heater_of_slot(machine, f"{kind}Heaters", slot)
        wanted = {
            name: things.temperature(name, values[name], machine, heater)
            for name in TEMPERATURES
            if values[name] is not None
        }
        found = [forms.slot_temperatures_line(kind, slot, **wanted)] if wanted else []
        state = values["state"]
        if state is not None:
            found += _slot_state(kind, slot, state, request, heater)
        if not found:
            raise bad("nothing_to_do", known=listed([*TEMPERATURES, "state"]))
        return found

    return lines


def _slot_state(
    kind: forms.Slots, slot: int, state: str, request: Request, heater: int
) -> Sequence[str]:
    machine = request.machine
    if state == "off":
        return [forms.slot_off_line(machine, kind, slot)]
    if kind == "bed":
        return [f"M144 P{slot} S1" if state == "active" else f"M144 P{slot}"]
    if request.values["active"] is not None:
        return []
    # a chamber has no command that only switches it on
    target: Any = machine.heater(heater).get("active")
    if not is_number(target):
        raise forbidden("no_target")
    return [forms.slot_temperatures_line(kind, slot, target)]


def reset_heater_fault(request: Request) -> Sequence[str]:
    """M562."""
    return [f"M562 P{request.values['heater']}"]


def fan(request: Request) -> Sequence[str]:
    """M106: up to 1 the speed is a fraction."""
    return [f"M106 P{request.values['fan']} S{number(request.values['speed'])}"]
