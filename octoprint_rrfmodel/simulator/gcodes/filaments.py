"""M701, M702, M703: the filament of the current tool (RRF 3.5 GCodes.cpp:4227-4263)."""

from __future__ import annotations

from typing import Any

from ..device.card import Card
from ..device.motion import Motion
from ..interpreter.macros import Macros
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome, Running
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError


class Filaments:
    """Loads and unloads filament by the macros of its folder."""

    def __init__(self, *, model: ObjectModel, motion: Motion, card: Card, macros: Macros):
        self._model = model
        self._motion = motion
        self._card = card
        self._macros = macros

    def rows(self) -> Rows:
        return {
            "M701": Row(self._load_filament),
            "M702": Row(self._unload_filament),
            "M703": Row(self._configure_filament),
        }

    def _extruder_of_tool(self) -> dict[str, Any]:
        tool = self._model.current_tool()
        if tool is None:
            raise GCodeError("No tool selected")
        drive = tool.get("filamentExtruder", -1)
        if not 0 <= drive < len(self._motion.extruders):
            raise GCodeError("The current tool has no filament drive")
        extruder: dict[str, Any] = self._motion.extruders[drive]
        return extruder

    def _load_filament(self, channel: Channel, command: Command) -> Outcome:
        """M701: runs load.g of that filament, for the current tool."""
        extruder = self._extruder_of_tool()
        name = command.string("S")
        if name is None:
            loaded = extruder["filament"]
            return (
                f"Loaded filament in the selected tool: {loaded}"
                if loaded
                else "No filament loaded"
            )
        if extruder["filament"]:
            raise GCodeError("Unload the current filament before attempting to load another one")
        if not self._card.has_folder(f"0:/filaments/{name}"):
            raise GCodeError("Filament configuration directory not found")
        return self._filament_macro(channel, extruder, name, f"0:/filaments/{name}/load.g", name)

    def _unload_filament(self, channel: Channel, command: Command) -> Outcome:
        """M702."""
        extruder = self._extruder_of_tool()
        name = extruder["filament"]
        if not name:
            return None
        return self._filament_macro(channel, extruder, "", f"0:/filaments/{name}/unload.g", name)

    def _configure_filament(self, channel: Channel, command: Command) -> Outcome:
        """M703."""
        extruder = self._extruder_of_tool()
        name = extruder["filament"]
        if not name:
            return None
        return self._filament_macro(channel, extruder, name, f"0:/filaments/{name}/config.g", name)

    def _filament_macro(
        self, channel: Channel, extruder: dict[str, Any], after: str, path: str, name: str
    ) -> Running:
        yield self._motion.has_stopped
        yield from self._macros.file(channel, path)
        if extruder["filament"] != after:
            extruder["filament"] = after
            self._model.bump("move")
