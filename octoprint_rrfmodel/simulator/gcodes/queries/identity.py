"""M115 and M122: what board and firmware this is, and how they are."""

from __future__ import annotations

from ...clock import Clock
from ...firmware import Firmware
from ...hardware.boards import Mainboard
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome
from ...model.tree import ObjectModel
from ...text.command import Command
from ...text.serial_line import Kind, Reply


class Identity:
    """Tells the names and the state of the board."""

    def __init__(
        self, *, model: ObjectModel, clock: Clock, firmware: Firmware, mainboard: Mainboard
    ):
        self._model = model
        self._clock = clock
        self._firmware = firmware
        self._mainboard = mainboard

    def rows(self) -> Rows:
        return {"M115": Row(self._identify), "M122": Row(self._diagnostics)}

    def _identify(self, channel: Channel, command: Command) -> Outcome:
        """M115: no Cap: lines in any version (RRF 3.5 GCodes2.cpp:1944-1984)."""
        firmware, mainboard = self._firmware, self._mainboard
        text = (
            f"FIRMWARE_NAME: {mainboard.firmware_name} FIRMWARE_VERSION: {firmware.version} "
            f"ELECTRONICS: {mainboard.electronics} FIRMWARE_DATE: {firmware.date}{firmware.time}"
        )
        if firmware.m115_date_twice:
            text += f" FIRMWARE_DATE: {firmware.date}{firmware.time}"
        return text

    def _diagnostics(self, channel: Channel, command: Command) -> Outcome:
        """M122: many lines; another part than 1 that isn't there says nothing."""
        if (command.integer("P", 0) or 0) > 1:
            return None
        firmware, mainboard = self._firmware, self._mainboard
        minutes, seconds = divmod(int(self._clock.up_time), 60)
        hours, minutes = divmod(minutes, 60)
        board_line = (
            f"{mainboard.firmware_name} version {firmware.version} ({firmware.date}) "
            f"running on {mainboard.electronics}"
        )
        lines = [
            "=== Diagnostics ===",
            board_line,
            f"Board ID: {mainboard.unique_id}",
            f"Used output buffers: 1 of {mainboard.buffers(firmware)} (17 max)",
            "=== RTOS ===",
            "Never used RAM 118392, free system stack 204 words",
            "=== Platform ===",
            f"Last reset {hours:02d}:{minutes:02d}:{seconds:02d} ago, cause: power up",
            "=== Storage ===",
            "Free file entries: 20",
            "=== Move ===",
            f"DMs created 125, segments created 0, maxWait 0ms, bed compensation in use: "
            f"{self._model.data['move']['compensation']['type']}",
            "=== GCodes ===",
        ]
        for gcode_input in self._model.data["inputs"]:
            if gcode_input is not None:
                lines.append(f"{gcode_input['name']} is {gcode_input['state']} in state(s) 0")
        return Reply("\n".join(lines), Kind.LONG)
