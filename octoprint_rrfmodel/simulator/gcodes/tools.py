"""Tools, heaters of all kinds, and fans: selecting, targets, waiting.

RRF 3.5 GCodes2.cpp:1759 (M104), 2225 (M140), 2342 (M190), 3776 (M568), Tool.cpp:788.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ..device.thermal import OFF_BELOW
from ..line.channel import Channel, Outcome, Running
from ..text.command import Command, GCodeError
from .heaters import check_range, heated
from .moves import standstill

if TYPE_CHECKING:
    from ..core import Core

MACRO_SECONDS = 1.5
"""Simulated time of each of tfree, tpre and tpost."""


def _tool_meant(board: Core, number: int | None) -> dict[str, Any]:
    """Return the tool of that number, the current one, or the lowest-numbered."""
    if number is None:
        found = board.current_tool() or next(iter(board.tools()), None)
    else:
        found = board.tool(number)
    if found is None:
        raise GCodeError("Invalid tool number")
    return found


def _reaches(board: Core, tool: dict[str, Any], index: int, name: str) -> bool:
    """Return whether a tool's target goes to its heater while another tool may be the current one.

    RRF 3.3 Tool.cpp, SetToolHeaterActiveOrStandbyTemperature; 2.05 the same.
    """
    current = board.current_tool()
    if current is None or current is tool:
        return True
    last = board.thermal.standby_tools.get(index, tool["number"])
    return name == "standby" and last == tool["number"]


def set_temperatures(board: Core, tool: dict[str, Any], name: str, values: Iterable[float]) -> None:
    """Store ``active`` or ``standby`` of a tool's heaters; too hot or too cold is an error."""
    values = list(values)
    for position, index in enumerate(tool.get("heaters") or ()):
        value = float(values[min(position, len(values) - 1)])
        heater = board.thermal.heater(index)
        if heater is not None and value > OFF_BELOW:
            check_range(heater, value)
        if position < len(tool[name]):
            tool[name][position] = 0.0 if value <= OFF_BELOW else value
        # a heater that is off stays off (RRF 3.5 Heater.cpp:615)
        if _reaches(board, tool, index, name):
            board.thermal.set_target(index, name, value)


def set_tool_heaters(board: Core, tool: dict[str, Any], state: str) -> None:
    """Switch a tool's heaters to that state with the tool's own targets.

    Those that another tool uses, being the current one, are left alone (RRF 3.3 Tool.cpp,
    HeatersToActiveOrStandby and HeatersToOff).
    """
    current = board.current_tool()
    used = () if current is None or current is tool else current.get("heaters") or ()
    for position, index in enumerate(tool.get("heaters") or ()):
        if index in used:
            continue
        for name in ("active", "standby"):
            if position < len(tool[name]):
                board.thermal.set_target(index, name, tool[name][position])
        board.thermal.set_state(index, state)
        if state == "standby":
            board.thermal.standby_tools[index] = tool["number"]


def select(board: Core, channel: Channel, number: int, macros: int = 7) -> Running:
    """Change to a tool, running tfree, tpre and tpost; an unknown number deselects."""
    yield standstill(board)
    old, new = board.current_tool(), board.tool(number)
    state = board.data["state"]
    if old is new:
        return
    board.is_changing_tool = True
    _announce(board, old, new)
    try:
        with board.running_macro(channel):
            if old is not None:
                if macros & 1:
                    yield board.after(MACRO_SECONDS)
                old["state"] = "standby"
                set_tool_heaters(board, old, "standby")
                state["currentTool"] = -1
            if new is not None:
                if macros & 2:
                    yield board.after(MACRO_SECONDS)
                new["state"] = "active"
                set_tool_heaters(board, new, "active")
                state["currentTool"] = new["number"]
                if macros & 4:
                    yield board.after(MACRO_SECONDS)
    finally:
        board.is_changing_tool = False
    _announce(board, new, new)


def _announce(board: Core, old: dict[str, Any] | None, new: dict[str, Any] | None) -> None:
    state = board.data["state"]
    state["previousTool"] = old["number"] if old else -1
    state["nextTool"] = new["number"] if new else -1
    board.bump("state", "tools")


def select_tool(board: Core, channel: Channel, command: Command) -> Outcome:
    """T: selects, T-1 deselects, without a number tells which is selected."""
    if command.number is None:
        tool = board.current_tool()
        return f"Tool {tool['number']} is selected" if tool else "No tool is selected"
    return select(board, channel, command.number, command.integer("P", 7) or 0)


def set_tool_target(board: Core, channel: Channel, command: Command) -> Outcome:
    """M104: both temperatures of the tool; the current one heats, another goes to standby."""
    values = command.numbers("S") or command.numbers("R")
    if values is None:
        return None
    _heat_tool(board, _tool_meant(board, command.integer("T")), values)
    return None


def _heat_tool(board: Core, tool: dict[str, Any], values: list[float]) -> None:
    set_temperatures(board, tool, "active", values)
    set_temperatures(board, tool, "standby", values)
    is_current = tool is board.current_tool()
    tool["state"] = "active" if is_current else "standby"
    set_tool_heaters(board, tool, "active" if is_current else "standby")


def set_and_wait(board: Core, channel: Channel, command: Command) -> Running:
    """M109: waits for the moves, selects the tool if none is, sets and waits."""
    yield standstill(board)
    tool = _tool_meant(board, command.integer("T"))
    if board.current_tool() is None:
        yield from select(board, channel, tool["number"])
    may_cool = "R" in command
    values = command.numbers("R") if may_cool else command.numbers("S")
    if values is not None:
        _heat_tool(board, tool, values)
    yield heated(board, tool.get("heaters") or (), may_cool)


def tool_settings(board: Core, channel: Channel, command: Command) -> Outcome:
    """M568 and G10: active S, standby R, state A; G10 also the tool's offsets."""
    if command.letter == "G" and ("L" in command or "P" not in command):
        return _workplace_offsets(board, command)
    if "P" not in command and not board.firmware.at_least(3, 4):
        raise GCodeError("missing parameter 'P'")
    tool = _tool_meant(board, command.integer("P"))
    changed = False
    for letter, name in (("S", "active"), ("R", "standby")):
        values = command.numbers(letter)
        if values is not None:
            set_temperatures(board, tool, name, values)
            changed = True
    if command.letter == "G":
        changed = _set_offsets(board, tool, command) or changed
    state = command.integer("A") if command.letter == "M" else None
    if state is not None:
        changed = True
        _set_tool_state(board, tool, state)
    if changed:
        return None
    pairs = "/".join(
        " ".join(f"{value:.1f}" for value in tool[name]) or "0.0" for name in ("active", "standby")
    )
    return f"Tool {tool['number']}: active/standby temperature(s) {pairs}"


def _set_tool_state(board: Core, tool: dict[str, Any], state: int) -> None:
    names = ("off", "standby", "active")
    if not 0 <= state < len(names):
        raise GCodeError("Invalid heater state")
    set_tool_heaters(board, tool, names[state])
    if state:
        tool["state"] = names[state]


def _set_offsets(board: Core, tool: dict[str, Any], command: Command) -> bool:
    changed = False
    for index, axis in enumerate(board.motion.axes):
        if axis["letter"] in command and index < len(tool["offsets"]):
            tool["offsets"][index] = command.number_of(axis["letter"]) or 0.0
            changed = True
    if changed:
        board.bump("tools")
    return changed


def _workplace_offsets(board: Core, command: Command) -> Outcome:
    """Set the offsets of a coordinate system: ``G10 L2 P1 X..`` absolute, L20 from here."""
    mode, place = command.integer("L", 2), (command.integer("P", 1) or 1) - 1
    for axis in board.motion.axes:
        value = command.number_of(axis["letter"])
        offsets = axis.get("workplaceOffsets") or []
        if value is not None and 0 <= place < len(offsets):
            offsets[place] = axis["machinePosition"] - value if mode == 20 else value
            board.bump("move")
    return None


def define_tool(board: Core, channel: Channel, command: Command) -> Outcome:
    """M563: renames tool P by S, makes or removes (D-1) one."""
    number = command.integer("P")
    if number is None:
        raise GCodeError("missing parameter 'P'")
    tool = board.tool(number)
    if tool is None:
        raise GCodeError(f"Tool {number} not found")
    if "S" in command:
        tool["name"] = command.string("S")
    for letter, member in (("F", "fans"), ("H", "heaters"), ("D", "extruders")):
        if letter in command:
            tool[member] = [int(value) for value in command.numbers(letter) or () if value >= 0]
    board.bump("tools")
    return None


TABLE = {
    "G10": tool_settings,
    "M104": set_tool_target,
    "M109": set_and_wait,
    "M563": define_tool,
    "M568": tool_settings,
    "T": select_tool,
}
