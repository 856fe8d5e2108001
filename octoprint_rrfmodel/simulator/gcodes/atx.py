"""M80 and M81: the ATX power supply."""

from __future__ import annotations

from typing import Any

from ..device.thermal import Thermal
from ..firmware import Firmware
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError


class Atx:
    """Switches the power supply."""

    def __init__(self, model: ObjectModel, thermal: Thermal, firmware: Firmware):
        self._model = model
        self._thermal = thermal
        self._firmware = firmware

    def rows(self) -> Rows:
        return {
            "M80": Row(self._power_on),
            "M81": Row(self._power_off),
        }

    def _state(self, command: Command) -> dict[str, Any]:
        """Return ``state`` of a board with a port for the supply, which C defines."""
        state: dict[str, Any] = self._model.data["state"]
        if "C" in command:
            state.update(atxPower=False, atxPowerPort=command.string("C"), deferredPowerDown=False)
        if state.get("atxPowerPort") is None and self._firmware.at_least(3, 4):
            raise GCodeError("No PS_ON port defined")
        return state

    def _power_on(self, channel: Channel, command: Command) -> Outcome:
        """M80: with C it sets the port up."""
        state = self._state(command)
        state["atxPower"] = True
        self._model.bump("state")
        return None

    def _power_off(self, channel: Channel, command: Command) -> Outcome:
        """M81: with S1 once everything has cooled down."""
        state = self._state(command)
        if command.integer("S", 0) == 1:
            state["deferredPowerDown"] = True
        else:
            state.update(atxPower=False, deferredPowerDown=False)
            self._thermal.all_off()
        self._model.bump("state")
        return None
