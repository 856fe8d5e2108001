"""Beds, chambers, and waiting for temperatures (RRF 3.5 GCodes2.cpp:2225, 2342)."""

from __future__ import annotations

from typing import Any

from ..device.motion import Motion
from ..device.thermal import OFF_BELOW, Thermal
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome, Running
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError

SLOTS = {
    140: ("bedHeaters", "Bed"),
    141: ("chamberHeaters", "Chamber"),
    190: ("bedHeaters", "Bed"),
    191: ("chamberHeaters", "Chamber"),
}
"""M-code → list of heaters in ``heat``, and what messages call it."""


class Heaters:
    """Sets heaters that belong to no tool, and waits for all kinds."""

    def __init__(self, model: ObjectModel, motion: Motion, thermal: Thermal):
        self._model = model
        self._motion = motion
        self._thermal = thermal

    def rows(self) -> Rows:
        return {
            "M108": Row(self._cancel_waits),
            "M116": Row(self._wait_for_heaters),
            "M140": Row(self._slot_target),
            "M141": Row(self._slot_target),
            "M144": Row(self._bed_standby),
            "M190": Row(self._slot_wait),
            "M191": Row(self._slot_wait),
            "M562": Row(self._reset_fault),
        }

    def _cancel_waits(self, channel: Channel, command: Command) -> Outcome:
        """M108: ends all temperature waits of all channels."""
        self._thermal.cancel_waits()
        return None

    def _wait_for_heaters(self, channel: Channel, command: Command) -> Running:
        """M116: all heaters, or those of tool P, heaters H, chambers C."""
        yield self._motion.has_stopped
        indexes: list[int] = []
        if "P" in command:
            indexes += (self._model.tool(command.integer("P")) or {}).get("heaters") or []
        if "H" in command:
            indexes += [int(index) for index in command.numbers("H") or ()]
        if "C" in command:
            slots = self._model.data["heat"].get("chamberHeaters") or []
            wanted = command.numbers("C") if command.raw["C"][0] else range(len(slots))
            indexes += [slots[int(slot)] for slot in wanted or () if 0 <= int(slot) < len(slots)]
        if not indexes:
            indexes = list(range(len(self._thermal.heaters)))
        yield self._thermal.awaited(indexes)

    def _slot_target(self, channel: Channel, command: Command) -> Outcome:
        """M140 and M141: S active, R standby, at or below -273 off; without either a report."""
        member, called = SLOTS[command.number or 0]
        slot = command.integer("P", 0) or 0
        slots = self._model.data["heat"].get(member) or []
        if "H" in command and 0 <= slot < len(slots):
            slots[slot] = command.integer("H", -1)
            self._model.bump("heat")
        index = slots[slot] if 0 <= slot < len(slots) else -1
        heater = self._thermal.heater(index)
        active, standby = command.number_of("S"), command.number_of("R")
        if heater is None and "H" not in command:
            wants = (active or 0.0) > 0 or (standby or 0.0) > 0
            if wants and index >= 0:
                raise GCodeError(f"Heater {index} not found")
            text = f"No {called.lower()} heater has been configured for slot {slot}"
            if wants:
                raise GCodeError(text)
            return text if active is None and standby is None else None
        if heater is None:
            return None
        if active is None and standby is None:
            if "H" in command:
                return None
            return (
                f"{called} heater {index} (slot {slot}) is currently at {heater['current']:.1f}°C"
            )
        for name, value in (("active", active), ("standby", standby)):
            if value is not None:
                if value > OFF_BELOW:
                    _check_range(heater, index, value)
                self._thermal.set_target(index, name, value)
        if active is not None and active > OFF_BELOW:
            self._thermal.set_state(index, "active")
            self._thermal.check_fault(index)
        return None

    def _slot_wait(self, channel: Channel, command: Command) -> Running:
        """M190 and M191: as M140 and M141, then waits."""
        yield self._motion.has_stopped
        may_cool = "R" in command
        target = command.number_of("R") if may_cool else command.number_of("S")
        member, _ = SLOTS[command.number or 0]
        slots = self._model.data["heat"].get(member) or []
        slot = command.integer("P", 0) or 0
        index = slots[slot] if 0 <= slot < len(slots) else -1
        if self._thermal.heater(index) is None:
            # a wait for a heater that isn't there is no error (seen in firmware)
            return
        if target is not None:
            self._thermal.set_target(index, "active", target)
            self._thermal.set_state(index, "active" if target > OFF_BELOW else "off")
        yield self._thermal.awaited([index], may_cool)

    def _bed_standby(self, channel: Channel, command: Command) -> Outcome:
        """M144: the bed to standby, with S1 to active."""
        slots = self._model.data["heat"].get("bedHeaters") or []
        slot = command.integer("P", 0) or 0
        if 0 <= slot < len(slots):
            self._thermal.set_state(slots[slot], "active" if command.integer("S", 0) else "standby")
        return None

    def _reset_fault(self, channel: Channel, command: Command) -> Outcome:
        """M562: ends the fault of heater P, of all without P; the heater is off then."""
        wanted = command.integer("P")
        for index, heater in enumerate(self._thermal.heaters):
            if heater is not None and wanted in (None, index) and heater["state"] == "fault":
                heater["state"] = "off"
                if heater["current"] >= 1000 or heater["current"] < -50:
                    heater["current"] = 25.0
        return None


def _check_range(heater: dict[str, Any], index: int, value: float) -> None:
    """Raise the error of a temperature that the heater may not have; its limit is allowed."""
    if value > float(heater["max"]):
        raise GCodeError(f"Temperature too high for heater {index}")
    if value < float(heater["min"]):
        raise GCodeError(f"Temperature too low for heater {index}")
