"""M20: what is in a folder of the card (RRF 3.5 RepRap.cpp:1865-2030)."""

from __future__ import annotations

from ...device.card import Card
from ...device.printing.file_text import FolderText, Page
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome
from ...line.switches import FaultSwitches
from ...model.om import OUT_OF_BUFFERS
from ...text.command import Command
from ...text.serial_line import Kind, Reply

NAMES, DETAILS = 2, 3
"""``S`` of M20; any other lists plain names."""


class Listing:
    """Lists folders, in pages where they are long."""

    def __init__(self, card: Card, folders: FolderText, faults: FaultSwitches):
        self._card = card
        self._folders = folders
        self._faults = faults

    def rows(self) -> Rows:
        return {
            "M20": Row(self._list_files),
        }

    def _list_files(self, channel: Channel, command: Command) -> Outcome:
        """M20: S0 names, S2 JSON names, S3 JSON with sizes and dates."""
        kind = command.integer("S", 0) or 0
        # as asked for, with a slash at the end only if it came with one
        asked = command.loose_string("P") or "0:/gcodes/"
        path = self._card.path_of(asked)
        if kind not in (NAMES, DETAILS):
            text = self._folders.plain(path) or "NONE\n"
            return Reply(text, Kind.FILE_LIST) if channel.is_marlin else Reply(text, Kind.LONG)
        page = Page(asked, path, command.integer("R", 0) or 0)
        text = self._folders.names(page) if kind == NAMES else self._folders.details(page)
        if self._faults.has_no_buffers_for(text):
            text = OUT_OF_BUFFERS
        return Reply(text + "\n", Kind.LONG)
