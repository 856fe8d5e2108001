"""M115: what board and firmware this is."""

from __future__ import annotations

from ...firmware import Firmware
from ...hardware.boards import Mainboard
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome
from ...text.command import Command


class Identity:
    """Tells the names of the board."""

    def __init__(self, firmware: Firmware, mainboard: Mainboard):
        self._firmware = firmware
        self._mainboard = mainboard

    def rows(self) -> Rows:
        return {"M115": Row(self._identify)}

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
