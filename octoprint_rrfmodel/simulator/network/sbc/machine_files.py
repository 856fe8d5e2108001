"""``/machine/file``, ``fileinfo`` and ``directory`` (DSF MachineController.cs)."""

from __future__ import annotations

import base64
import binascii
from collections.abc import Sequence
from typing import Any

from ...device.card import Card, Entry
from ...device.printing.file_text import SLOT, piece_of_thumbnail
from ...device.printing.fileinfo import file_info
from ..uploads import CardWriter, card_date, moment_of
from .machine_model import as_json
from .machine_request import (
    BYTES,
    CONFLICT,
    CREATED,
    DONE,
    NOT_FOUND,
    MachineAnswer,
    MachineRequest,
    MachineRow,
    json_answer,
    text_answer,
)

FRACTION_AND_ZONE = ".0000000+00:00"
"""What DSF's dates have behind those of the card."""
WHOLE = 1 << 30


def zoned(date: str | None) -> str | None:
    """Return a date of the card as DSF tells it."""
    return date and date + FRACTION_AND_ZONE


def listed(entry: Entry) -> dict[str, Any]:
    """Return an element of a list; folders have no size."""
    found: dict[str, Any] = {"type": "d" if entry.is_folder else "f", "name": entry.name}
    if not entry.is_folder:
        found["size"] = entry.size
    return {**found, "date": zoned(entry.date)}


class MachineFiles:
    """Files of the virtual card, and folders."""

    def __init__(self, writer: CardWriter):
        self._card: Card = writer.card
        self._writer = writer

    def _path(self, name: str) -> str:
        return self._card.path_of(name, SLOT)

    def _exists(self, path: str) -> bool:
        return self._card.name_of(path) is not None or self._card.has_folder(path)

    def _changed(self, answer: MachineAnswer) -> MachineAnswer:
        self._writer.changed()
        return answer

    def read(self, name: str) -> MachineAnswer:
        content = self._card.read(self._path(name))
        return NOT_FOUND if content is None else MachineAnswer(200, content, BYTES)

    def write(self, name: str, content: bytes, time: str | None) -> MachineAnswer:
        moment = moment_of(time)
        date = card_date(moment) if moment else self._writer.now()
        self._card.store(self._path(name), content, date)
        return self._changed(CREATED)

    def delete(self, name: str, *, is_tree: bool) -> MachineAnswer:
        path = self._path(name)
        if not self._exists(path):
            return NOT_FOUND
        is_done = self._card.delete_tree(path) if is_tree else self._card.delete(path)
        return self._changed(DONE) if is_done else text_answer("Directory not empty", 500)

    def move(self, old: str, new: str, *, is_forced: bool) -> MachineAnswer:
        """With force a missing source is none the worse."""
        source, target = self._path(old), self._path(new)
        if not self._exists(source):
            return DONE if is_forced else NOT_FOUND
        if self._exists(target) and source.lower() != target.lower():
            if not is_forced:
                return CONFLICT
            self._card.delete_tree(target)
        self._card.rename(source, target)
        return self._changed(DONE)

    def tell(self, name: str, wants_pictures: bool = False) -> MachineAnswer:
        """Return what is read from a print file."""
        path = self._path(name)
        content = self._card.read(path)
        if content is None:
            return NOT_FOUND
        info = file_info(path, content, zoned(self._card.date(path)))
        info["thumbnails"] = [
            {**one, "data": _picture(content, one["offset"]) if wants_pictures else None}
            for one in info["thumbnails"]
        ]
        return json_answer(as_json(info))

    def picture(self, name: str, offset: int) -> str | None:
        """Return a thumbnail as base64, ``None`` where none begins there."""
        content = self._card.read(self._path(name))
        return _picture(content, offset) if content and offset else None

    def entries(self, name: str) -> MachineAnswer:
        """Return a folder's list."""
        path = self._path(name)
        if not self._card.is_mounted or not self._card.has_folder(path):
            return NOT_FOUND
        return json_answer(as_json([listed(entry) for entry in self._card.entries(path)]))

    def make(self, name: str) -> MachineAnswer:
        self._card.make_folder(self._path(name))
        return self._changed(CREATED)


def _picture(content: bytes, offset: int) -> str | None:
    data = piece_of_thumbnail(content, offset, WHOLE).data
    try:
        base64.b64decode(data, validate=True)
    except binascii.Error:
        return None
    return data


class FileRequests:
    """The requests for them."""

    def __init__(self, files: MachineFiles):
        self._files = files

    def rows(self) -> Sequence[MachineRow]:
        files = self._files
        return (
            MachineRow("POST", "file/move", self._move),
            MachineRow("GET", "file", lambda request, rest: files.read(rest), takes_rest=True),
            MachineRow("PUT", "file", self._write, takes_rest=True),
            MachineRow("DELETE", "file", self._delete, takes_rest=True),
            MachineRow("GET", "fileinfo", self._tell, takes_rest=True),
            MachineRow(
                "GET", "directory", lambda request, rest: files.entries(rest), takes_rest=True
            ),
            MachineRow("PUT", "directory", lambda request, rest: files.make(rest), takes_rest=True),
        )

    def _write(self, request: MachineRequest, rest: str) -> MachineAnswer:
        return self._files.write(rest, request.body, request.parameter("timeModified"))

    def _delete(self, request: MachineRequest, rest: str) -> MachineAnswer:
        return self._files.delete(rest, is_tree=request.is_set("recursive"))

    def _move(self, request: MachineRequest, rest: str) -> MachineAnswer:
        fields = request.fields()
        is_forced = fields.get("force", "").lower() == "true"
        return self._files.move(fields.get("from", ""), fields.get("to", ""), is_forced=is_forced)

    def _tell(self, request: MachineRequest, rest: str) -> MachineAnswer:
        return self._files.tell(rest, request.is_set("readThumbnailContent"))
