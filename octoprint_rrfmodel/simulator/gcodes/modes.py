"""Modes of the machine: M302, M451, M453, M561, G11."""

from __future__ import annotations

from functools import partial

from ..device.thermal import Thermal
from ..hardware.blank import NO_TAPER
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome
from ..model.tree import ObjectModel
from ..text.command import Command


class Modes:
    """Sets what moves and extrusion may do."""

    def __init__(self, model: ObjectModel, thermal: Thermal):
        self._model = model
        self._thermal = thermal

    def rows(self) -> Rows:
        return {
            "G11": Row(self._firmware_retraction),
            "M302": Row(self._cold_extrusion),
            "M450": Row(self._tell_mode),
            "M451": Row(partial(self._machine_mode, "FFF")),
            "M452": Row(partial(self._machine_mode, "Laser")),
            "M453": Row(partial(self._machine_mode, "CNC")),
            "M561": Row(self._identity_transform),
        }

    def _identity_transform(self, channel: Channel, command: Command) -> Outcome:
        """M561: bed compensation off."""
        compensation = self._model.data["move"]["compensation"]
        compensation.update(file=None, fadeHeight=NO_TAPER, meshDeviation=None)
        compensation["type"] = "none"
        if "liveGrid" in compensation:
            compensation["liveGrid"] = None
        self._model.bump("move")
        return None

    def _cold_extrusion(self, channel: Channel, command: Command) -> Outcome:
        """M302: S sets the temperature, P1 allows cold extrusion."""
        if not command.raw:
            heat = self._model.data["heat"]
            if self._thermal.cold_extrusion_allowed:
                return "Cold extrusion is allowed (use M302 P0 to forbid it)"
            return (
                "Cold extrusion is forbidden (use M302 P1 to allow it), min. extrusion temperature "
                f"{heat['coldExtrudeTemperature']:.1f}C, min. retraction temperature "
                f"{heat['coldRetractTemperature']:.1f}C"
            )
        for letter, member in (("S", "coldExtrudeTemperature"), ("R", "coldRetractTemperature")):
            value = command.number_of(letter)
            if value is not None:
                self._model.data["heat"][member] = value
                self._model.bump("heat")
        if "P" in command:
            self._thermal.cold_extrusion_allowed = command.integer("P", 0) == 1
        return None

    def _tell_mode(self, channel: Channel, command: Command) -> Outcome:
        """M450."""
        return f"PrinterMode:{self._model.data['state']['machineMode']}"

    def _machine_mode(self, mode: str, channel: Channel, command: Command) -> Outcome:
        """M451 and M453: the machine is a printer or a router."""
        self._model.data["state"]["machineMode"] = mode
        self._model.bump("state")
        return None

    def _firmware_retraction(self, channel: Channel, command: Command) -> Outcome:
        """G10 without parameters and G11."""
        tool = self._model.current_tool()
        if tool is not None and "isRetracted" in tool:
            tool["isRetracted"] = command.number == 10
        return None
