"""M36: what the firmware reads from a file without printing it (RRF 3.5 RepRap.cpp)."""

from __future__ import annotations

from ...device.card import Card
from ...device.job import Job
from ...device.printing.file_text import FileText, piece_of_thumbnail
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome
from ...model.om import quoted
from ...text.command import BareError, Command, GCodeError
from ...text.serial_line import Kind, Reply

THUMBNAIL_BYTES = 1024
"""Letters of a thumbnail in one answer to M36.1 (3.5 RepRap.cpp)."""


class Information:
    """Tells about files, and gives their thumbnails."""

    def __init__(self, card: Card, job: Job, files: FileText):
        self._card = card
        self._job = job
        self._files = files

    def rows(self) -> Rows:
        return {
            "M36": Row(self._tell),
            "M36.1": Row(self._thumbnail, since=(3, 4)),
        }

    def _tell(self, channel: Channel, command: Command) -> Outcome:
        """M36: file information; without a name of the file being printed."""
        if command.fraction > 0:
            raise GCodeError("Command is not supported")
        name = command.unquoted_text()
        path = self._card.path_of(name) if name else self._job.printed_path
        duration = None if name else int(self._job.duration)
        text = path and self._files.text_of(name or path, path, self._card, duration)
        if not text:
            return self._files.refusal(name)
        return Reply(text + "\n", Kind.LONG)

    def _thumbnail(self, channel: Channel, command: Command) -> Outcome:
        """M36.1: a piece of a thumbnail's text (3.4 and later)."""
        if "P" not in command:
            raise BareError("M36: missing parameter 'P'")
        if "S" not in command:
            raise BareError("M36: missing parameter 'S'")
        name, start = command.string("P") or "", command.integer("S", 0) or 0
        content = self._card.read(self._card.path_of(name))
        head = f'{{"thumbnail":{{"fileName":{quoted(name)},"offset":{start},'
        if content is None:
            return Reply(f'{head}"err":1}}}}\n', Kind.LONG)
        piece = piece_of_thumbnail(content, start, THUMBNAIL_BYTES)
        text = f'"data":"{piece.data}","next":{piece.following},"err":{piece.error}}}}}\n'
        return Reply(head + text, Kind.LONG)
