"""Tools, heaters of all kinds, and fans: selecting, targets, waiting.

RRF 3.5 GCodes2.cpp:1759 (M104), 2225 (M140), 2342 (M190), 3776 (M568), Tool.cpp:788.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Optional

from .channel import Channel, Outcome, Running
from .command import Command, GCodeError
from .moves import standstill
from .thermal import OFF_BELOW

if TYPE_CHECKING:
    from .board import Board

MACRO_SECONDS = 1.5
"""Simulated time of each of tfree, tpre and tpost."""
SLOTS = {
    140: ("bedHeaters", "Bed"),
    141: ("chamberHeaters", "Chamber"),
    190: ("bedHeaters", "Bed"),
    191: ("chamberHeaters", "Chamber"),
}
"""M-code → list of heaters in ``heat``, and what messages call it."""


def tools(board: Board) -> List[Dict[str, Any]]:
    """Return the tools there are, in the order of their numbers."""
    return [tool for tool in board.data.get("tools") or () if tool is not None]


def tool_numbered(board: Board, number: Optional[int]) -> Optional[Dict[str, Any]]:
    return next((tool for tool in tools(board) if tool["number"] == number), None)


def _tool_meant(board: Board, number: Optional[int]) -> Dict[str, Any]:
    """Return the tool of that number, the current one, or the lowest-numbered."""
    if number is None:
        found = board.current_tool() or next(iter(tools(board)), None)
    else:
        found = tool_numbered(board, number)
    if found is None:
        raise GCodeError("Invalid tool number")
    return found


def set_temperatures(
    board: Board, tool: Dict[str, Any], name: str, values: Iterable[float]
) -> None:
    """Store ``active`` or ``standby`` of a tool's heaters; too hot or too cold is an error."""
    values = list(values)
    for position, index in enumerate(tool.get("heaters") or ()):
        value = float(values[min(position, len(values) - 1)])
        heater = board.thermal.heater(index)
        if heater is not None and value > OFF_BELOW:
            if not float(heater["min"]) < value < float(heater["max"]):
                raise GCodeError("Requested temperature out of range")
        if position < len(tool[name]):
            tool[name][position] = 0.0 if value <= OFF_BELOW else value
        # a heater that is off stays off (RRF 3.5 Heater.cpp:615)
        board.thermal.set_target(index, name, value)


def set_tool_heaters(board: Board, tool: Dict[str, Any], state: str) -> None:
    """Switch a tool's heaters to that state with the tool's own targets."""
    for position, index in enumerate(tool.get("heaters") or ()):
        for name in ("active", "standby"):
            if position < len(tool[name]):
                board.thermal.set_target(index, name, tool[name][position])
        board.thermal.set_state(index, state)


def select(board: Board, channel: Channel, number: int, macros: int = 7) -> Running:
    """Change to a tool, running tfree, tpre and tpost; an unknown number deselects."""
    yield standstill(board)
    old, new = board.current_tool(), tool_numbered(board, number)
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


def _announce(board: Board, old: Optional[Dict[str, Any]], new: Optional[Dict[str, Any]]) -> None:
    state = board.data["state"]
    state["previousTool"] = old["number"] if old else -1
    state["nextTool"] = new["number"] if new else -1
    board.bump("state", "tools")


def select_tool(board: Board, channel: Channel, command: Command) -> Outcome:
    """T: selects, T-1 deselects, without a number tells which is selected."""
    if command.number is None:
        tool = board.current_tool()
        return f"Tool {tool['number']} is selected" if tool else "No tool is selected"
    return select(board, channel, command.number, command.integer("P", 7) or 0)


def set_tool_target(board: Board, channel: Channel, command: Command) -> Outcome:
    """M104: both temperatures of the tool; the current one heats, another goes to standby."""
    values = command.floats("S") or command.floats("R")
    if values is None:
        return None
    _heat_tool(board, _tool_meant(board, command.integer("T")), values)
    return None


def _heat_tool(board: Board, tool: Dict[str, Any], values: List[float]) -> None:
    set_temperatures(board, tool, "active", values)
    set_temperatures(board, tool, "standby", values)
    is_current = tool is board.current_tool()
    tool["state"] = "active" if is_current else "standby"
    set_tool_heaters(board, tool, "active" if is_current else "standby")


def set_and_wait(board: Board, channel: Channel, command: Command) -> Running:
    """M109: waits for the moves, selects the tool if none is, sets and waits."""
    yield standstill(board)
    tool = _tool_meant(board, command.integer("T"))
    if board.current_tool() is None:
        yield from select(board, channel, tool["number"])
    may_cool = "R" in command
    values = command.floats("R") if may_cool else command.floats("S")
    if values is not None:
        _heat_tool(board, tool, values)
    yield _heated(board, tool.get("heaters") or (), may_cool)


def _heated(board: Board, heaters: Iterable[int], may_cool: bool = True):
    """Return the condition that the heaters are there, or that M108 has cancelled waiting."""
    indexes, before = list(heaters), board.thermal.cancelled_waits
    return lambda: (
        board.thermal.are_at_target(indexes, may_cool) or board.thermal.cancelled_waits != before
    )


def cancel_waits(board: Board, channel: Channel, command: Command) -> Outcome:
    """M108: ends all temperature waits of all channels."""
    board.thermal.cancelled_waits += 1
    return None


def wait_for_heaters(board: Board, channel: Channel, command: Command) -> Running:
    """M116: all heaters, or those of tool P, heaters H, chambers C."""
    yield standstill(board)
    indexes: List[int] = []
    if "P" in command:
        indexes += (tool_numbered(board, command.integer("P")) or {}).get("heaters") or []
    if "H" in command:
        indexes += [int(index) for index in command.floats("H") or ()]
    if "C" in command:
        slots = board.data["heat"].get("chamberHeaters") or []
        wanted = command.floats("C") if command.raw["C"][0] else range(len(slots))
        indexes += [slots[int(slot)] for slot in wanted or () if int(slot) < len(slots)]
    if not indexes:
        indexes = list(range(len(board.thermal.heaters)))
    yield _heated(board, indexes)


def tool_settings(board: Board, channel: Channel, command: Command) -> Outcome:
    """M568 and G10: active S, standby R, state A; G10 also the tool's offsets."""
    if command.letter == "G" and ("L" in command or "P" not in command):
        return _workplace_offsets(board, command)
    if "P" not in command and not board.firmware.at_least(3, 4):
        raise GCodeError("missing parameter 'P'")
    tool = _tool_meant(board, command.integer("P"))
    changed = False
    for letter, name in (("S", "active"), ("R", "standby")):
        values = command.floats(letter)
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


def _set_tool_state(board: Board, tool: Dict[str, Any], state: int) -> None:
    names = ("off", "standby", "active")
    if not 0 <= state < len(names):
        raise GCodeError("Invalid heater state")
    set_tool_heaters(board, tool, names[state])
    if state:
        tool["state"] = names[state]


def _set_offsets(board: Board, tool: Dict[str, Any], command: Command) -> bool:
    changed = False
    for index, axis in enumerate(board.motion.axes):
        if axis["letter"] in command and index < len(tool["offsets"]):
            tool["offsets"][index] = command.float(axis["letter"]) or 0.0
            changed = True
    if changed:
        board.bump("tools")
    return changed


def _workplace_offsets(board: Board, command: Command) -> Outcome:
    """Set the offsets of a coordinate system: ``G10 L2 P1 X..`` absolute, L20 from here."""
    mode, place = command.integer("L", 2), (command.integer("P", 1) or 1) - 1
    for axis in board.motion.axes:
        value = command.float(axis["letter"])
        offsets = axis.get("workplaceOffsets") or []
        if value is not None and 0 <= place < len(offsets):
            offsets[place] = axis["machinePosition"] - value if mode == 20 else value
            board.bump("move")
    return None


def slot_target(board: Board, channel: Channel, command: Command) -> Outcome:
    """M140 and M141: S active, R standby, at or below -273 off; without either a report."""
    member, called = SLOTS[command.number]
    slot = command.integer("P", 0) or 0
    slots = board.data["heat"].get(member) or []
    if "H" in command and slot < len(slots):
        slots[slot] = command.integer("H", -1)
        board.bump("heat")
    index = slots[slot] if 0 <= slot < len(slots) else -1
    heater = board.thermal.heater(index)
    active, standby = command.float("S"), command.float("R")
    if heater is None:
        if (active or 0.0) > 0 or (standby or 0.0) > 0:
            raise GCodeError(f"No {called.lower()} heater has been configured for slot {slot}")
        return None
    if active is None and standby is None:
        if "H" in command:
            return None
        return f"{called} heater {index} (slot {slot}) is currently at {heater['current']:.1f}°C"
    for name, value in (("active", active), ("standby", standby)):
        if value is not None:
            if value > OFF_BELOW and not float(heater["min"]) < value < float(heater["max"]):
                raise GCodeError("Requested temperature out of range")
            board.thermal.set_target(index, name, value)
    if active is not None and active > OFF_BELOW:
        board.thermal.set_state(index, "active")
    return None


def slot_wait(board: Board, channel: Channel, command: Command) -> Running:
    """M190 and M191: as M140 and M141, then waits."""
    yield standstill(board)
    may_cool = "R" in command
    target = command.float("R") if may_cool else command.float("S")
    member, called = SLOTS[command.number]
    slots = board.data["heat"].get(member) or []
    slot = command.integer("P", 0) or 0
    index = slots[slot] if 0 <= slot < len(slots) else -1
    if board.thermal.heater(index) is None:
        if (target or 0.0) > 0:
            raise GCodeError(f"No {called.lower()} heater has been configured for slot {slot}")
        return
    if target is not None:
        board.thermal.set_target(index, "active", target)
        board.thermal.set_state(index, "active" if target > OFF_BELOW else "off")
    yield _heated(board, [index], may_cool)


def bed_standby(board: Board, channel: Channel, command: Command) -> Outcome:
    """M144: the bed to standby, with S1 to active."""
    slots = board.data["heat"].get("bedHeaters") or []
    slot = command.integer("P", 0) or 0
    if slot < len(slots):
        board.thermal.set_state(slots[slot], "active" if command.integer("S", 0) else "standby")
    return None


def reset_fault(board: Board, channel: Channel, command: Command) -> Outcome:
    """M562: ends the fault of heater P, of all without P; the heater is off then."""
    wanted = command.integer("P")
    for index, heater in enumerate(board.thermal.heaters):
        if heater is not None and wanted in (None, index) and heater["state"] == "fault":
            heater["state"] = "off"
            if heater["current"] >= 1000 or heater["current"] < -50:
                heater["current"] = 25.0
    return None


def set_fan(board: Board, channel: Channel, command: Command) -> Outcome:
    """M106: S up to 1 is a fraction, above it /255; without P the fans of the current tool."""
    fans = board.data.get("fans") or []
    if "P" in command:
        numbers = [command.integer("P", 0) or 0]
    else:
        tool = board.current_tool()
        numbers = (tool.get("fans") if tool else None) or ([0] if fans else [])
    speed = command.float("S")
    for number in numbers:
        fan = fans[number] if 0 <= number < len(fans) else None
        if fan is None:
            raise GCodeError(f"Fan number {number} not found")
        if "C" in command:
            fan["name"] = command.string("C")
            board.bump("fans")
        for letter, member in (("L", "min"), ("X", "max"), ("B", "blip")):
            if letter in command:
                fan[member] = command.float(letter)
                board.bump("fans")
        if speed is not None:
            fan["requestedValue"] = max(0.0, min(1.0, speed / 255 if speed > 1 else speed))
    if not command.raw and numbers and fans:
        return f"Fan {numbers[0]} speed: {round(fans[numbers[0]]['requestedValue'] * 100)}%"
    return None


def fan_off(board: Board, channel: Channel, command: Command) -> Outcome:
    """M107."""
    tool = board.current_tool()
    for number in (tool.get("fans") if tool else None) or [0]:
        if number < len(board.data.get("fans") or ()):
            board.data["fans"][number]["requestedValue"] = 0.0
    return None


def define_tool(board: Board, channel: Channel, command: Command) -> Outcome:
    """M563: renames tool P by S, makes or removes (D-1) one."""
    number = command.integer("P")
    if number is None:
        raise GCodeError("missing parameter 'P'")
    tool = tool_numbered(board, number)
    if tool is None:
        raise GCodeError(f"Tool {number} not found")
    if "S" in command:
        tool["name"] = command.string("S")
    for letter, member in (("F", "fans"), ("H", "heaters"), ("D", "extruders")):
        if letter in command:
            tool[member] = [int(value) for value in command.floats(letter) or () if value >= 0]
    board.bump("tools")
    return None


TABLE = {
    "G10": tool_settings,
    "M104": set_tool_target,
    "M106": set_fan,
    "M107": fan_off,
    "M108": cancel_waits,
    "M109": set_and_wait,
    "M116": wait_for_heaters,
    "M140": slot_target,
    "M141": slot_target,
    "M144": bed_standby,
    "M190": slot_wait,
    "M191": slot_wait,
    "M562": reset_fault,
    "M563": define_tool,
    "M568": tool_settings,
    "T": select_tool,
}
