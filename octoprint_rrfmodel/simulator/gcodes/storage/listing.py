"""M20: what is in a folder of the card (RRF 3.5 RepRap.cpp:1865-2030)."""

from __future__ import annotations

from ...device.card import Card, Entry
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome
from ...line.switches import FaultSwitches
from ...model.om import OUT_OF_BUFFERS, quoted
from ...text.command import Command
from ...text.serial_line import Kind, Reply

LIST_BYTES = 2600
"""Text length at which a listing goes on with ``next``: the buffers aren't endless."""
NOT_MOUNTED, NO_FOLDER = 1, 2
SLOT = "0:"
"""How the paths of the only card begin."""


class Listing:
    """Lists folders, in pages where they are long."""

    def __init__(self, card: Card, faults: FaultSwitches):
        self._card = card
        self._faults = faults

    def rows(self) -> Rows:
        return {
            "M20": Row(self._list_files),
        }

    def _list_files(self, channel: Channel, command: Command) -> Outcome:
        """M20: S0 names, S2 JSON names, S3 JSON with sizes and dates."""
        kind = command.integer("S", 0) or 0
        asked = _folder(command)
        path = self._card.path_of(asked)
        if kind not in (2, 3):
            entries = self._card.entries(path) if self._card.is_mounted else ()
            names = "".join(f"{entry.name}\n" for entry in entries)
            text = names or "NONE\n"
            return Reply(text, Kind.FILE_LIST) if channel.is_marlin else Reply(text, Kind.LONG)
        first = command.integer("R", 0) or 0
        error = 0
        if not self._card.is_mounted or not path.startswith(SLOT):
            error = NOT_MOUNTED
        elif not self._card.has_folder(path):
            error = NO_FOLDER
        text = (self._names if kind == 2 else self._details)(asked, path, first, error)
        if self._faults.has_no_buffers_for(text):
            text = OUT_OF_BUFFERS
        return Reply(text + "\n", Kind.LONG)

    def _names(self, asked: str, path: str, first: int, error: int) -> str:
        if error:
            return _refused(asked, first, error)
        parts = [quoted(("*" if e.is_folder else "") + e.name) for e in self._card.entries(path)]
        head = f'{{"dir":{quoted(asked)},"first":{first},"files":['
        return _page(head, parts, first, ',"err":0')

    def _details(self, asked: str, path: str, first: int, error: int) -> str:
        if error:
            return _refused(asked, first, error)
        parts = [_detail(entry) for entry in self._card.entries(path)]
        return _page(f'{{"dir":{quoted(asked)},"first":{first},"files":[', parts, first, "")


def _folder(command: Command) -> str:
    """Return the folder as asked for, with a slash at the end only if it came with one."""
    return command.loose_string("P") or "0:/gcodes/"


def _refused(asked: str, first: int, error: int) -> str:
    """Return an error, which names no page to go on with (seen in firmware)."""
    return f'{{"dir":{quoted(asked)},"first":{first},"files":[],"err":{error}}}'


def _page(head: str, parts: list[str], first: int, tail: str) -> str:
    """Return a listing that stops at :data:`LIST_BYTES` and says where it goes on."""
    text, following = head, 0
    for index in range(first, len(parts)):
        if index > first and len(text) >= LIST_BYTES:
            following = index
            break
        text += ("," if index > first else "") + parts[index]
    return f'{text}],"next":{following}{tail}}}'


def _detail(entry: Entry) -> str:
    kind = "d" if entry.is_folder else "f"
    return (
        f'{{"type":"{kind}","name":{quoted(entry.name)},"size":{entry.size},"date":"{entry.date}"}}'
    )
