"""M36: what the firmware reads from a file without printing it (RRF 3.5 RepRap.cpp)."""

from __future__ import annotations

from typing import Any

from ...device.card import Card
from ...device.fileinfo import file_info
from ...device.job import Job
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome
from ...model.om import ModelText, encoded, quoted, with_decimals
from ...model.tree import ObjectModel
from ...text.command import BareError, Command, GCodeError
from ...text.serial_line import Kind, Reply

THUMBNAIL_BYTES = 1024
"""Letters of a thumbnail in one answer to M36.1 (3.5 RepRap.cpp)."""

FIELDS = (
    "fileName",
    "size",
    "lastModified",
    "height",
    "firstLayerHeight",
    "layerHeight",
    "numLayers",
    "printTime",
    "simulatedTime",
    "filament",
    "thumbnails",
    "generatedBy",
)
"""Members of M36 in the order they are printed."""

OLD_FIELDS = (
    "size",
    "lastModified",
    "height",
    "firstLayerHeight",
    "layerHeight",
    "printTime",
    "simulatedTime",
    "filament",
    "generatedBy",
)
"""The same before 3.1, where a name is told only of the file being printed, as the last member."""

HEIGHTS = ("height", "firstLayerHeight", "layerHeight")
"""Printed with decimals even where they are 0."""


class Information:
    """Tells about files, and gives their thumbnails."""

    def __init__(
        self,
        *,
        model: ObjectModel,
        card: Card,
        job: Job,
        model_text: ModelText,
        has_model: bool = True,
    ):
        self._model = model
        self._card = card
        self._job = job
        self._model_text = model_text
        self._has_model = has_model

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
        shown = name
        if name:
            path = self._card.path_of(name)
            found = self._card.name_of(path)
            extra = ""
        else:
            found = self._job.path if self._job.is_printing else None
            path = shown = found or ""
            extra = f'"printDuration":{int(self._job.duration)}'
        content = self._card.read(found) if found else None
        if found is None or content is None:
            return f'{{"err":1,"fileName":{quoted(name)}}}' if self._has_model else '{"err":1}'
        info = self._model.members_of(file_info(path, content, self._card.date(found)), "job.file")
        info["fileName"] = shown
        return Reply(self._text_of(info, extra) + "}\n", Kind.LONG)

    def _text_of(self, info: dict[str, Any], extra: str) -> str:
        """Return the members; the name is the one asked for (seen in firmware)."""
        shown = with_decimals(info, self._model_text.decimals["job"]["file"])
        text = '{"err":0'
        for field in FIELDS if self._has_model else OLD_FIELDS:
            if field not in shown or shown[field] is None and field != "generatedBy":
                continue
            before = f"{extra}," if extra and field == "thumbnails" else ""
            text += f",{before}{quoted(field)}:{_shown(field, shown[field])}"
        if extra and not self._has_model:
            text += f',{extra},"fileName":{quoted(info["fileName"])}'
        return text

    def _thumbnail(self, channel: Channel, command: Command) -> Outcome:
        """M36.1: a piece of a thumbnail's text, whole lines as far as there is room.

        3.5 RepRap.cpp, GetThumbnailResponse; 3.4 and later.
        """
        if "P" not in command:
            raise BareError("M36: missing parameter 'P'")
        if "S" not in command:
            raise BareError("M36: missing parameter 'S'")
        name, start = command.string("P") or "", command.integer("S", 0) or 0
        content = self._card.read(self._card.path_of(name))
        head = f'{{"thumbnail":{{"fileName":{quoted(name)},"offset":{start},'
        if content is None:
            return Reply(f'{head}"err":1}}}}\n', Kind.LONG)
        data, position, error = "", start, 0
        while len(data) < THUMBNAIL_BYTES:
            line = content[position:].split(b"\n", 1)[0]
            if position >= len(content):
                position, error = 0, 1
                break
            before, position = position, position + len(line) + 1
            letters = line.rstrip(b"\r").lstrip(b"; \t")
            if b" " in letters:
                # the end, or what can't be base64
                position = 0
                break
            room = THUMBNAIL_BYTES - len(data)
            if len(letters) > room:
                position = before + line.index(letters) + room
            data += letters[:room].decode("latin-1")
        return Reply(f'{head}"data":"{data}","next":{position},"err":{error}}}}}\n', Kind.LONG)


def _shown(field: str, value: Any) -> str:
    if field in HEIGHTS and not value:
        return "0.00"
    return encoded("" if value is None else value)
