"""Uploads: written beside the file, checked, and put in its place (RRF 3.5
UploadingNetworkResponder.cpp; seen in firmware).
"""

from __future__ import annotations

import datetime
import re
import zlib

from ..clock import Clock
from ..device.card import Card
from ..device.job import Job
from ..device.printing.file_text import SLOT
from ..line.output import Output
from ..model.tree import ObjectModel

PART = ".part"
LONGEST_PATH = 120
"""Bytes of a path with the ending of the unfinished file."""
SPEED_TEST = ".dummy"
_DATE = re.compile(r"(\d+)-(\d+)-(\d+)T(\d+):(\d+):(\d+)")
_HEX = re.compile(r"[0-9a-fA-F]*")


def moment_of(text: str | None) -> datetime.datetime | None:
    """Return a time as clients send it, whose digits need no padding; ``None`` for no time."""
    found = _DATE.match(text or "")
    if found is None:
        return None
    year, month, day, hour, minute, second = map(int, found.groups())
    try:
        return datetime.datetime(year, month, day, hour, minute, second)
    except ValueError:
        return None


def card_date(moment: datetime.datetime) -> str:
    """Return a time as the card keeps it, in steps of two seconds."""
    return moment.replace(second=moment.second // 2 * 2, microsecond=0).isoformat()


class CardWriter:
    """The parts of the board that uploads end in."""

    def __init__(self, *, card: Card, job: Job, model: ObjectModel, output: Output, clock: Clock):
        self.card = card
        self._job = job
        self._model = model
        self._output = output
        self._clock = clock

    def now(self) -> str:
        """Return the board's time as the card keeps it."""
        return card_date(datetime.datetime.fromisoformat(self._clock.date_time()))

    def tell(self, text: str) -> None:
        """Say to everybody that an upload has failed."""
        self._output.text(f"Error: {text}\n")

    def put_in_place(self, part: str, path: str) -> None:
        """Give the unfinished file its name; whether that goes well is nobody's answer."""
        if path.lower() == (self._job.printed_path or "").lower():
            self.tell(f"Failed to rename file or directory {part} to {path}")
            return
        self.card.delete(path)
        self.card.rename(part, path)
        self.changed()

    def changed(self) -> None:
        """Announce that there is something new on the card."""
        self._model.volumes_changed(True)


class Upload:
    """One file on its way, as its request describes it."""

    def __init__(
        self, writer: CardWriter, name: str, *, size: int, time: str | None, crc: str | None
    ):
        self._writer = writer
        self.size = size
        self._crc = None if crc is None else int((_HEX.match(crc) or [""])[0] or "0", 16)
        self._moment = moment_of(time)
        self.is_swallowed = not name or name.endswith(SPEED_TEST)
        self._path = writer.card.path_of(name, SLOT)
        self._part = self._path + PART
        self._received = bytearray()
        self.is_possible = (
            self.is_swallowed
            or writer.card.is_mounted
            and writer.card.may_be(self._path)
            and not writer.card.has_folder(self._path)
            and len(self._part.encode("utf-8", "surrogateescape")) <= LONGEST_PATH
        )
        if self.is_possible and not self.is_swallowed:
            date = card_date(self._moment) if self._moment else writer.now()
            writer.card.store(self._part, b"", date)

    @property
    def is_complete(self) -> bool:
        return len(self._received) >= self.size

    def receive(self, data: bytes) -> None:
        """Take bytes; two uploads of one name write into one file."""
        self._received += data
        if not self.is_swallowed:
            self._writer.card.add(self._part, data)

    def abandon(self) -> None:
        """Forget what has come."""
        if not self.is_swallowed:
            self._writer.card.delete(self._part)

    def finish(self) -> bool:
        """Put the file in its place; return whether its size and checksum are right."""
        if self.is_swallowed:
            return True
        problem = self._problem()
        if problem:
            self.abandon()
            self._writer.tell(problem)
            return False
        self._writer.put_in_place(self._part, self._path)
        return True

    def _problem(self) -> str:
        length, crc = len(self._received), zlib.crc32(self._received)
        if length != self.size:
            return f"Uploaded file size is different ({length} vs. expected {self.size} bytes)"
        if self._crc is not None and crc != self._crc & 0xFFFFFFFF:
            return f"Uploaded file CRC is different ({crc:08x} vs. expected {self._crc:08x})"
        return ""
