"""Beds, chambers, fans, and waiting for temperatures (RRF 3.5 GCodes2.cpp:2225, 2342)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ..device.thermal import OFF_BELOW
from ..line.channel import Channel, Condition, Outcome, Running
from ..text.command import Command, GCodeError
from .moves import standstill

if TYPE_CHECKING:
    from ..core import Core

SLOTS = {
    140: ("bedHeaters", "Bed"),
    141: ("chamberHeaters", "Chamber"),
    190: ("bedHeaters", "Bed"),
    191: ("chamberHeaters", "Chamber"),
}
"""M-code → list of heaters in ``heat``, and what messages call it."""


def check_range(heater: dict[str, Any], value: float) -> None:
    if not float(heater["min"]) < value < float(heater["max"]):
        raise GCodeError("Requested temperature out of range")


def heated(board: Core, heaters: Iterable[int], may_cool: bool = True) -> Condition:
    """Return the condition that the heaters are there, or that M108 has cancelled waiting."""
    indexes, before = list(heaters), board.thermal.cancelled_waits
    return lambda: (
        board.thermal.are_at_target(indexes, may_cool) or board.thermal.cancelled_waits != before
    )


def cancel_waits(board: Core, channel: Channel, command: Command) -> Outcome:
    """M108: ends all temperature waits of all channels."""
    board.thermal.cancelled_waits += 1
    return None


def wait_for_heaters(board: Core, channel: Channel, command: Command) -> Running:
    """M116: all heaters, or those of tool P, heaters H, chambers C."""
    yield standstill(board)
    indexes: list[int] = []
    if "P" in command:
        indexes += (board.tool(command.integer("P")) or {}).get("heaters") or []
    if "H" in command:
        indexes += [int(index) for index in command.numbers("H") or ()]
    if "C" in command:
        slots = board.data["heat"].get("chamberHeaters") or []
        wanted = command.numbers("C") if command.raw["C"][0] else range(len(slots))
        indexes += [slots[int(slot)] for slot in wanted or () if 0 <= int(slot) < len(slots)]
    if not indexes:
        indexes = list(range(len(board.thermal.heaters)))
    yield heated(board, indexes)


def slot_target(board: Core, channel: Channel, command: Command) -> Outcome:
    """M140 and M141: S active, R standby, at or below -273 off; without either a report."""
    member, called = SLOTS[command.number or 0]
    slot = command.integer("P", 0) or 0
    slots = board.data["heat"].get(member) or []
    if "H" in command and 0 <= slot < len(slots):
        slots[slot] = command.integer("H", -1)
        board.bump("heat")
    index = slots[slot] if 0 <= slot < len(slots) else -1
    heater = board.thermal.heater(index)
    active, standby = command.number_of("S"), command.number_of("R")
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
            if value > OFF_BELOW:
                check_range(heater, value)
            board.thermal.set_target(index, name, value)
    if active is not None and active > OFF_BELOW:
        board.thermal.set_state(index, "active")
    return None


def slot_wait(board: Core, channel: Channel, command: Command) -> Running:
    """M190 and M191: as M140 and M141, then waits."""
    yield standstill(board)
    may_cool = "R" in command
    target = command.number_of("R") if may_cool else command.number_of("S")
    member, called = SLOTS[command.number or 0]
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
    yield heated(board, [index], may_cool)


def bed_standby(board: Core, channel: Channel, command: Command) -> Outcome:
    """M144: the bed to standby, with S1 to active."""
    slots = board.data["heat"].get("bedHeaters") or []
    slot = command.integer("P", 0) or 0
    if 0 <= slot < len(slots):
        board.thermal.set_state(slots[slot], "active" if command.integer("S", 0) else "standby")
    return None


def reset_fault(board: Core, channel: Channel, command: Command) -> Outcome:
    """M562: ends the fault of heater P, of all without P; the heater is off then."""
    wanted = command.integer("P")
    for index, heater in enumerate(board.thermal.heaters):
        if heater is not None and wanted in (None, index) and heater["state"] == "fault":
            heater["state"] = "off"
            if heater["current"] >= 1000 or heater["current"] < -50:
                heater["current"] = 25.0
    return None


def set_fan(board: Core, channel: Channel, command: Command) -> Outcome:
    """M106: S up to 1 is a fraction, above it /255; without P the fans of the current tool."""
    fans = board.data.get("fans") or []
    if "P" in command:
        numbers = [command.integer("P", 0) or 0]
    else:
        tool = board.current_tool()
        numbers = (tool.get("fans") if tool else None) or ([0] if fans else [])
    speed = command.number_of("S")
    for number in numbers:
        fan = fans[number] if 0 <= number < len(fans) else None
        if fan is None:
            raise GCodeError(f"Fan number {number} not found")
        if "C" in command:
            fan["name"] = command.string("C")
            board.bump("fans")
        for letter, member in (("L", "min"), ("X", "max"), ("B", "blip")):
            if letter in command:
                fan[member] = command.number_of(letter)
                board.bump("fans")
        if speed is not None:
            fan["requestedValue"] = max(0.0, min(1.0, speed / 255 if speed > 1 else speed))
    if not command.raw and numbers and fans:
        return f"Fan {numbers[0]} speed: {round(fans[numbers[0]]['requestedValue'] * 100)}%"
    return None


def fan_off(board: Core, channel: Channel, command: Command) -> Outcome:
    """M107."""
    tool = board.current_tool()
    for number in (tool.get("fans") if tool else None) or [0]:
        if 0 <= number < len(board.data.get("fans") or ()):
            board.data["fans"][number]["requestedValue"] = 0.0
    return None


TABLE = {
    "M106": set_fan,
    "M107": fan_off,
    "M108": cancel_waits,
    "M116": wait_for_heaters,
    "M140": slot_target,
    "M141": slot_target,
    "M144": bed_standby,
    "M190": slot_wait,
    "M191": slot_wait,
    "M562": reset_fault,
}
