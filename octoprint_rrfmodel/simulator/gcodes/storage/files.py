"""M21 to M39: the card and its files over the serial line.

RRF 3.5 GCodes2.cpp:953-1030, MassStorage.cpp:1118-1205. None of the texts is
what OctoPrint waits for: sizes are missing, and no "SD card ok" is ever said.
"""

from __future__ import annotations

import hashlib
from functools import partial

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

SLOTS = 2
GIGA = 1e9
CLUSTER = 32768


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
            "M470": Row(self._make_folder, since=(3, 4)),
            "M471": Row(self._rename, since=(3, 4)),
            "M472": Row(self._delete_path, since=(3, 5)),
        }

    def _mount(self, channel: Channel, command: Command) -> Outcome:
        """M21."""
        slot = command.integer("P", 0) or 0
        if slot:
            few = slot < SLOTS
            raise GCodeError("No SD card present" if few else "SD card number out of range")
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
        name = command.needed_name()
        path = self._card.path_of(name)
        self._card.write(path, "", self._clock.date_time())
        channel.upload = partial(self._card.append, path)
        return Reply(f"Writing to file: {name}", Kind.UPLOAD)

    def _end_upload(self, channel: Channel, command: Command) -> Outcome:
        """M29."""
        if channel.upload is None:
            return "GCode end-of-file being interpreted."
        channel.upload = None
        self._model.volumes_changed(True)
        return "Done saving file."

    def _delete(self, channel: Channel, command: Command) -> Outcome:
        """M30."""
        path = self._card.path_of(command.needed_name())
        if self._job.is_printing and path.lower() == (self._job.path or "").lower():
            self._output.text(f"Error: Cannot delete file {path} because it is open\n")
            raise GCodeError("delete failed")
        if not self._card.delete(path):
            raise GCodeError("delete failed")
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
        slot, is_json = command.integer("P", 0) or 0, command.integer("S", 0) == 2
        volumes = self._model.data.get("volumes") or []
        volume = volumes[slot] if slot < len(volumes) else None
        if volume is None or not volume["mounted"]:
            if is_json:
                return f'{{"SDinfo":{{"slot":{slot},"present":0}}}}'
            raise GCodeError(f"No SD card mounted in slot {slot}")
        capacity, free = volume["capacity"], volume["freeSpace"]
        size = volume.get("partitionSize") or capacity
        if is_json:
            return (
                f'{{"SDinfo":{{"slot":{slot},"present":1,"capacity":{capacity},'
                f'"partitionSize":{size},"free":{free},"speed":{volume["speed"]},'
                f'"clsize":{CLUSTER}}}}}'
            )
        return (
            f"SD card in slot {slot}: capacity {capacity / GIGA:.2f}GB, partition size "
            f"{size / GIGA:.2f}GB, free space {free / GIGA:.2f}GB, "
            f"speed {volume['speed'] / 1e6:.2f}MBytes/sec, cluster size {CLUSTER} bytes"
        )

    def _make_folder(self, channel: Channel, command: Command) -> Outcome:
        """M470."""
        asked = command.needed_string("P")
        path = self._card.path_of(asked)
        if self._card.has_folder(path):
            self._output.text(f"Error: Failed to create folder {asked}\n")
            raise GCodeError("failed to create folder")
        self._card.make_folder(path)
        self._model.volumes_changed(True)
        return None

    def _rename(self, channel: Channel, command: Command) -> Outcome:
        """M471: S the old name, T the new one; an existing file is kept unless D1."""
        old, new = command.needed_string("S"), command.needed_string("T")
        source, target = self._card.path_of(old), self._card.path_of(new)
        content = self._card.read(source)
        if content is None:
            self._output.text(f"Error: Failed to rename file {old}: file not found\n")
            raise GCodeError("rename failed")
        if self._card.read(target) is not None and command.integer("D", 0) != 1:
            there = target.partition(":")[2]
            self._output.text(f"Error: Failed to rename file or directory {old} to {there}\n")
            raise GCodeError("rename failed")
        date = self._card.date(source) or self._clock.date_time()
        self._card.delete(source)
        self._card.write(target, content.decode("utf-8", "surrogateescape"), date)
        self._model.volumes_changed(True)
        return None

    def _delete_path(self, channel: Channel, command: Command) -> Outcome:
        """M472: a file or an empty folder."""
        asked = command.needed_string("P")
        path = self._card.path_of(asked)
        if not self._card.delete(path):
            why = " because it is a folder and not empty" if self._card.has_folder(path) else ""
            self._output.text(f"Error: Failed to delete {asked}{why}\n")
            raise GCodeError("delete failed")
        self._model.volumes_changed(True)
        return None
