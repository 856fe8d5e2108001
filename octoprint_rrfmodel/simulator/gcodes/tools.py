"""Tools: selecting them, their temperatures and offsets.

RRF 3.5 GCodes2.cpp:1759 (M104), 2225 (M140), 2342 (M190), 3776 (M568), Tool.cpp:788.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from ..clock import Clock
from ..device.motion import Motion
from ..device.thermal import OFF_BELOW, Thermal, check_range
from ..firmware import Firmware
from ..interpreter.macros import Macros
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome, Running
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError

ONE_LOOP = 0.001
"""A wait takes at least one turn of the firmware's main loop."""


class Tools:
    """Selects tools and sets what belongs to them."""

    def __init__(
        self,
        *,
        model: ObjectModel,
        motion: Motion,
        thermal: Thermal,
        clock: Clock,
        macros: Macros,
        firmware: Firmware,
    ):
        self._model = model
        self._motion = motion
        self._thermal = thermal
        self._clock = clock
        self._macros = macros
        self._firmware = firmware

    def rows(self) -> Rows:
        return {
            "G10": Row(self._tool_settings),
            "M104": Row(self._set_tool_target),
            "M109": Row(self._set_and_wait),
            "M563": Row(self._define_tool),
            "M568": Row(self._tool_settings, since=(3, 3)),
            "T": Row(self._select_tool),
        }

    def _tool_meant(self, number: int | None) -> dict[str, Any]:
        """Return the tool of that number, the current one, or the lowest-numbered."""
        if number is None:
            found = self._model.current_tool() or next(iter(self._model.tools()), None)
        else:
            found = self._model.tool(number)
        if found is None:
            raise GCodeError("Invalid tool number")
        return found

    def _reaches(self, tool: dict[str, Any], index: int, name: str) -> bool:
        """Return whether a target goes to its heater while another tool may be the current one.

        RRF 3.3 Tool.cpp, SetToolHeaterActiveOrStandbyTemperature; 2.05 the same.
        """
        current = self._model.current_tool()
        if current is None or current is tool:
            return True
        last = self._thermal.standby_tools.get(index, tool["number"])
        return name == "standby" and last == tool["number"]

    def _set_temperatures(self, tool: dict[str, Any], name: str, values: Iterable[float]) -> None:
        """Store ``active`` or ``standby`` of a tool's heaters; too hot or too cold is an error."""
        values = list(values)
        for position, index in enumerate(tool.get("heaters") or ()):
            value = float(values[min(position, len(values) - 1)])
            heater = self._thermal.heater(index)
            if heater is not None and value > OFF_BELOW:
                check_range(heater, value)
            if position < len(tool[name]):
                tool[name][position] = 0.0 if value <= OFF_BELOW else value
            # a heater that is off stays off (RRF 3.5 Heater.cpp:615)
            if self._reaches(tool, index, name):
                self._thermal.set_target(index, name, value)

    def _set_tool_heaters(self, tool: dict[str, Any], state: str) -> None:
        """Switch a tool's heaters to that state with the tool's own targets.

        Those that another tool uses, being the current one, are left alone (RRF 3.3 Tool.cpp,
        HeatersToActiveOrStandby and HeatersToOff).
        """
        current = self._model.current_tool()
        used = () if current is None or current is tool else current.get("heaters") or ()
        for position, index in enumerate(tool.get("heaters") or ()):
            if index in used:
                continue
            for name in ("active", "standby"):
                if position < len(tool[name]):
                    self._thermal.set_target(index, name, tool[name][position])
            self._thermal.set_state(index, state)
            if state == "standby":
                self._thermal.standby_tools[index] = tool["number"]

    def _select(self, channel: Channel, number: int, macros: int = 7) -> Running:
        """Change to a tool, running tfree, tpre and tpost; an unknown number deselects."""
        yield self._motion.has_stopped
        old, new = self._model.current_tool(), self._model.tool(number)
        state = self._model.data["state"]
        if old is new:
            return
        activity = self._macros.activity
        activity.is_changing_tool = True
        self._announce(old, new)
        try:
            with activity.running_macro(channel):
                if old is not None:
                    if macros & 1:
                        yield from self._change_macro(channel, "tfree", old["number"])
                    old["state"] = "standby"
                    self._set_tool_heaters(old, "standby")
                    state["currentTool"] = -1
                if new is not None:
                    if macros & 2:
                        yield from self._change_macro(channel, "tpre", new["number"])
                    new["state"] = "active"
                    self._set_tool_heaters(new, "active")
                    state["currentTool"] = new["number"]
                    if macros & 4:
                        yield from self._change_macro(channel, "tpost", new["number"])
        finally:
            activity.is_changing_tool = False
        self._announce(new, new)

    def _change_macro(self, channel: Channel, name: str, number: int) -> Running:
        """Run the tool's own file, or that of all tools (RRF 3.5 GCodes4.cpp)."""
        return self._macros.system(channel, f"{name}{number}.g", f"{name}.g")

    def _announce(self, old: dict[str, Any] | None, new: dict[str, Any] | None) -> None:
        state = self._model.data["state"]
        state["previousTool"] = old["number"] if old else -1
        state["nextTool"] = new["number"] if new else -1
        self._model.bump("state", "tools")

    def _select_tool(self, channel: Channel, command: Command) -> Outcome:
        """T: selects, T-1 deselects, without a number tells which is selected."""
        if command.number is None:
            tool = self._model.current_tool()
            return f"Tool {tool['number']} is selected" if tool else "No tool is selected"
        return self._select(channel, command.number, command.integer("P", 7) or 0)

    def _set_tool_target(self, channel: Channel, command: Command) -> Outcome:
        """M104: both temperatures of the tool; the current one heats, another goes to standby."""
        values = command.numbers("S") or command.numbers("R")
        if values is None:
            return None
        self._heat_tool(self._tool_meant(command.integer("T")), values)
        return None

    def _heat_tool(self, tool: dict[str, Any], values: list[float]) -> None:
        self._set_temperatures(tool, "active", values)
        self._set_temperatures(tool, "standby", values)
        is_current = tool is self._model.current_tool()
        tool["state"] = "active" if is_current else "standby"
        self._set_tool_heaters(tool, "active" if is_current else "standby")
        for index in tool.get("heaters") or ():
            self._thermal.check_fault(index)

    def _set_and_wait(self, channel: Channel, command: Command) -> Running:
        """M109: waits for the moves, selects the tool if none is, sets and waits."""
        yield self._motion.has_stopped
        tool = self._tool_meant(command.integer("T"))
        if self._model.current_tool() is None:
            yield from self._select(channel, tool["number"])
        may_cool = "R" in command
        values = command.numbers("R") if may_cool else command.numbers("S")
        if values is not None:
            self._heat_tool(tool, values)
        yield self._clock.after(ONE_LOOP)
        yield self._thermal.awaited(tool.get("heaters") or (), may_cool)

    def _tool_settings(self, channel: Channel, command: Command) -> Outcome:
        """M568 and G10: active S, standby R, state A; G10 also the tool's offsets."""
        if command.letter == "G" and ("L" in command or "P" not in command):
            return self._workplace_offsets(command)
        if "P" not in command and not self._firmware.at_least(3, 4):
            raise GCodeError("missing parameter 'P'")
        tool = self._tool_meant(command.integer("P"))
        changed = False
        for letter, name in (("S", "active"), ("R", "standby")):
            values = command.numbers(letter)
            if values is not None:
                self._set_temperatures(tool, name, values)
                changed = True
        if command.letter == "G":
            changed = self._set_offsets(tool, command) or changed
        state = command.integer("A") if command.letter == "M" else None
        if state is not None:
            changed = True
            self._set_tool_state(tool, state)
        if changed:
            return None
        pairs = "/".join(
            " ".join(f"{value:.1f}" for value in tool[name]) or "0.0"
            for name in ("active", "standby")
        )
        return f"Tool {tool['number']}: active/standby temperature(s) {pairs}"

    def _set_tool_state(self, tool: dict[str, Any], state: int) -> None:
        names = ("off", "standby", "active")
        if not 0 <= state < len(names):
            raise GCodeError("Invalid heater state")
        self._set_tool_heaters(tool, names[state])
        if state:
            tool["state"] = names[state]

    def _set_offsets(self, tool: dict[str, Any], command: Command) -> bool:
        changed = False
        for index, axis in enumerate(self._motion.axes):
            if axis["letter"] in command and index < len(tool["offsets"]):
                tool["offsets"][index] = command.number_of(axis["letter"]) or 0.0
                changed = True
        if changed:
            self._model.bump("tools")
        return changed

    def _workplace_offsets(self, command: Command) -> Outcome:
        """Set the offsets of a coordinate system: ``G10 L2 P1 X..`` absolute, L20 from here."""
        mode, place = command.integer("L", 2), (command.integer("P", 1) or 1) - 1
        for axis in self._motion.axes:
            value = command.number_of(axis["letter"])
            offsets = axis.get("workplaceOffsets") or []
            if value is not None and 0 <= place < len(offsets):
                offsets[place] = axis["machinePosition"] - value if mode == 20 else value
                self._model.bump("move")
        return None

    def _define_tool(self, channel: Channel, command: Command) -> Outcome:
        """M563: renames tool P by S, makes or removes (D-1) one."""
        number = command.integer("P")
        if number is None:
            raise GCodeError("missing parameter 'P'")
        tool = self._model.tool(number)
        if tool is None:
            raise GCodeError(f"Tool {number} not found")
        if "S" in command:
            tool["name"] = command.string("S")
        for letter, member in (("F", "fans"), ("H", "heaters"), ("D", "extruders")):
            if letter in command:
                tool[member] = [int(value) for value in command.numbers(letter) or () if value >= 0]
        self._model.bump("tools")
        return None
