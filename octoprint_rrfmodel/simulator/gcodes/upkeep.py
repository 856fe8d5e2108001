"""What keeps a machine in order: M500, M916, M997."""

from __future__ import annotations

from ..clock import Clock
from ..device.card import SYSTEM, Card
from ..device.restart import Restart
from ..interpreter.macros import Macros
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome, Running
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError
from ..text.serial_line import NO_REPLY, Reply

OVERRIDE = f"{SYSTEM}/config-override.g"
RESUME = "resurrect.g"
FIRMWARE = "0:/firmware"
UPDATE_SECONDS = 2.0


class Upkeep:
    """Saves, resumes after the power was gone, and updates firmware."""

    def __init__(
        self, *, model: ObjectModel, card: Card, macros: Macros, clock: Clock, restart: Restart
    ):
        self._model = model
        self._card = card
        self._macros = macros
        self._clock = clock
        self._restart = restart

    def rows(self) -> Rows:
        return {
            "M500": Row(self._save),
            "M916": Row(self._resume),
            "M997": Row(self._update),
        }

    def _save(self, channel: Channel, command: Command) -> Outcome:
        """M500: writes what ``config.g`` reads back with M501 (seen in firmware)."""
        lines = self._card.lines(f"{SYSTEM}/config.g") or []
        if not any(line.strip().startswith("M501") for line in lines):
            return Reply("Warning: M500: No M501 command was executed in config.g")
        heaters = [
            f"M307 H{index} R{heater['model']['heatingRate']:.3f}"
            for index, heater in enumerate(self._model.data["heat"]["heaters"])
            if heater is not None
        ]
        self._card.write(OVERRIDE, "\n".join(["; saved by M500", *heaters]) + "\n")
        return None

    def _resume(self, channel: Channel, command: Command) -> Running:
        """M916."""
        if self._card.lines(f"{SYSTEM}/{RESUME}") is None:
            raise GCodeError("No resume file found")
        with self._macros.running(channel):
            yield from self._macros.system(channel, RESUME)

    def _update(self, channel: Channel, command: Command) -> Outcome:
        """M997: of the main board there is no reply, as it restarts."""
        boards = self._model.data["boards"]
        address = command.integer("B", 0) or 0
        found = [board for board in boards[1:] if board.get("canAddress") == address]
        if address and not found:
            raise GCodeError(f"Board {address} does not exist or is not running")
        board = found[0] if found else boards[0]
        name = f"{FIRMWARE}/{board['firmwareFileName']}"
        if self._card.lines(name) is None:
            raise GCodeError(f'Firmware binary "{name}" not found')
        if found:
            return None
        self._clock.after_seconds(UPDATE_SECONDS, self._restart.power_cycle)
        return NO_REPLY
