"""M21 to M39: the card and its files over the serial line.

RRF 3.5 GCodes2.cpp:953-1030, MassStorage.cpp:1118-1205. None of the texts is
what OctoPrint waits for: sizes are missing, and no "SD card ok" is ever said.
"""

from __future__ import annotations

import hashlib
from functools import partial
from typing import Any

from ...clock import Clock
from ...device.card import Card
from ...device.job import Job
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome
from ...line.output import Output
from ...model.tree import ObjectModel
from ...text.command import Command, GCodeError
from ...text.serial_line import Kind, Reply


class Files:
    """Mounts the card, and writes and deletes files."""

    def __init__(self, *, model: ObjectModel, card: Card, job: Job, clock: Clock, output: Output):
        self._model = model
        self._card = card
        self._job = job
        self._clock = clock
        self._output = output

    def rows(self) -> Rows:
        return {
            "M21": Row(self._mount),
            "M22": Row(self._unmount),
            "M28": Row(self._start_upload),
            "M29": Row(self._end_upload),
            "M30": Row(self._delete),
            "M38": Row(self._file_hash, until=(3, 5)),
            "M39": Row(self._card_information),
        }

    def _mount(self, channel: Channel, command: Command) -> Outcome:
        """M21."""
        slot = command.integer("P", 0) or 0
        if slot:
            raise GCodeError(f"Cannot initialise SD card {slot}: Card not present")
        self._card.is_mounted = True
        self._model.volumes_changed(True)
        return "SDHC card mounted in slot 0, capacity 15.9Gb"

    def _unmount(self, channel: Channel, command: Command) -> Outcome:
        """M22."""
        slot = command.integer("P", 0) or 0
        if self._job.is_printing:
            raise GCodeError("SD card 0 has open file(s)")
        if not slot:
            self._card.is_mounted = False
            self._model.volumes_changed(False)
        return f"SD card {slot} may now be removed"

    def _start_upload(self, channel: Channel, command: Command) -> Outcome:
        """M28: every line until M29 goes to the file and gets no ok (RRF 3.5 GCodeInput.cpp:20)."""
        name = command.unquoted_text()
        if not name:
            raise GCodeError("missing filename")
        path = self._card.path_of(name)
        self._card.write(path, "", self._clock.date_time())
        channel.upload = partial(self._card.append, path)
        return Reply(f"Writing to file: {name}", Kind.UPLOAD)

    def _end_upload(self, channel: Channel, command: Command) -> Outcome:
        """M29."""
        if channel.upload is None:
            return None
        channel.upload = None
        self._model.volumes_changed(True)
        return "Done saving file."

    def _delete(self, channel: Channel, command: Command) -> Outcome:
        """M30."""
        name = command.unquoted_text()
        path = self._card.path_of(name)
        if not self._card.delete(path):
            self._output.text(f"Error: Failed to delete file {path}\n")
            raise GCodeError(f"Failed to delete file {path}")
        self._model.volumes_changed(True)
        return None

    def _file_hash(self, channel: Channel, command: Command) -> Outcome:
        """M38: the SHA1 of a file (compiled out in 3.5)."""
        name = command.unquoted_text()
        content = self._card.read(self._card.path_of(name))
        if content is None:
            raise GCodeError(f"Cannot open file {name}")
        return hashlib.sha1(content).hexdigest()

    def _card_information(self, channel: Channel, command: Command) -> Outcome:
        """M39: text, with S2 JSON."""
        volume: dict[str, Any] | None = (self._model.data.get("volumes") or [None])[0]
        if command.integer("S", 0) != 2:
            return (
                "SD card in slot 0: capacity 15.9Gb, partition size 15.9Gb, free space 15.7Gb, "
                "speed 20.0MBytes/sec, cluster size 32kb"
            )
        capacity = volume["capacity"] if volume else 0
        free = volume["freeSpace"] if volume else 0
        return Reply(
            f'{{"SDinfo":{{"slot":0,"present":1,"capacity":{capacity},"free":{free},'
            f'"speed":20000000,"clsize":32768}}}}\n',
            Kind.LONG,
        )
