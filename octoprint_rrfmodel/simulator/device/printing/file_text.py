"""What the firmware says of files and folders, the same over USB and over the network.

RRF 3.5 RepRap.cpp:1865-2030 and GetFileInfoResponse, GetThumbnailResponse.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Callable, NamedTuple

from ...firmware import Firmware
from ...model.om import ModelText, encoded, quoted
from ...model.tree import ObjectModel
from ..card import Card, Entry
from .fileinfo import file_info

LIST_BYTES = 2600
"""Text length at which a listing over USB goes on with ``next``: the buffers aren't endless."""
MANY = 1 << 30
NOT_MOUNTED, NO_FOLDER = 1, 2
SLOT = "0:"
"""How the paths of the only card begin."""
HIDDEN = "."

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
"""Members of a file's information in the order they are printed."""

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

THUMBNAIL_FIELDS = ("width", "height", "format", "offset", "size")
"""Members of a thumbnail in the order they are printed (seen in firmware)."""

HEIGHTS = ("height", "firstLayerHeight", "layerHeight")
"""Printed with decimals even where they are 0."""


class Piece(NamedTuple):
    """A part of a thumbnail's base64 text, and where the next one begins, 0 behind the last."""

    data: str
    following: int
    error: int


class Page(NamedTuple):
    """What of a folder is listed."""

    asked: str
    """The folder as it was asked for."""
    path: str
    first: int = 0
    most: int = LIST_BYTES
    """Length of the text from which on the rest is for another page."""
    entries: int = MANY
    """Most entries."""


class FolderText:
    """Folders of the card as text, in pages where they are long."""

    def __init__(self, card: Card):
        self._card = card

    def error(self, path: str) -> int:
        """Return why that folder can't be listed, 0 where it can."""
        if not self._card.is_mounted or not path.startswith(SLOT):
            return NOT_MOUNTED
        return 0 if self._card.has_folder(path) else NO_FOLDER

    def plain(self, path: str) -> str:
        """Return a line for each name."""
        return "".join(f"{entry.name}\n" for entry in self._entries(path))

    def names(self, page: Page, marks: bool = True) -> str:
        """Return names as JSON, those of folders with an asterisk where they are marked."""
        return self._text(page, lambda entry: _name(entry, marks), ',"err":0')

    def details(self, page: Page) -> str:
        """Return names, sizes and dates as JSON."""
        return self._text(page, _detail, "")

    def _entries(self, path: str) -> list[Entry]:
        entries = self._card.entries(path) if self._card.is_mounted else []
        return [entry for entry in entries if not entry.name.startswith(HIDDEN)]

    def _text(self, page: Page, part: Callable[[Entry], str], tail: str) -> str:
        text = f'{{"dir":{quoted(page.asked)},"first":{page.first},"files":['
        error = self.error(page.path)
        if error:
            # an error names no page to go on with (seen in firmware)
            return f'{text}],"err":{error}}}'
        parts, following = [part(entry) for entry in self._entries(page.path)], 0
        for index in range(page.first, len(parts)):
            taken = index - page.first
            if taken and (len(text) >= page.most or taken >= page.entries):
                following = index
                break
            text += ("," if index > page.first else "") + parts[index]
        return f'{text}],"next":{following}{tail}}}'


def _name(entry: Entry, marks: bool) -> str:
    return quoted(("*" if marks and entry.is_folder else "") + entry.name)


def _detail(entry: Entry) -> str:
    kind = "d" if entry.is_folder else "f"
    return (
        f'{{"type":"{kind}","name":{quoted(entry.name)},"size":{entry.size},"date":"{entry.date}"}}'
    )


class FileText:
    """Information about print files as JSON."""

    def __init__(self, model: ObjectModel, model_text: ModelText, firmware: Firmware):
        self._model = model
        self._model_text = model_text
        self._has_model = firmware.has_model
        self._release = firmware.release

    def text_of(self, shown: str, path: str, card: Card, duration: int | None = None) -> str | None:
        """Return what is known of a file, ``None`` without one.

        ``shown`` is the name that it is told by, the one asked for (seen in firmware); ``duration``
        the time that the file being printed has taken.
        """
        info = self._information(shown, path, card)
        return None if info is None else self._members(info, duration, is_old=not self._has_model)

    def network_text(
        self, shown: str, path: str, card: Card, duration: int | None = None
    ) -> str | None:
        """Return the same in the form of ``rr_fileinfo``.

        Up to 3.3 a name is told only of the file being printed; 3.4 turns the sides of thumbnails
        around and says nothing where there are none.
        """
        info = self._information(shown, path, card)
        if info and (3, 4) <= self._release < (3, 5):
            turned = [
                {**picture, "width": picture["height"], "height": picture["width"]}
                for picture in info.get("thumbnails") or ()
            ]
            info["thumbnails"] = turned or None
        return (
            None if info is None else self._members(info, duration, is_old=self._release < (3, 4))
        )

    def _information(self, shown: str, path: str, card: Card) -> dict[str, Any] | None:
        found = card.name_of(path)
        content = card.read(found) if found else None
        if found is None or content is None:
            return None
        info = self._model.members_of(file_info(path, content, card.date(found)), "job.file")
        return {**info, "fileName": shown}

    def refusal(self, name: str) -> str:
        """Return what is said where there is no such file."""
        return f'{{"err":1,"fileName":{quoted(name)}}}' if self._has_model else '{"err":1}'

    def _members(self, info: dict[str, Any], duration: int | None, *, is_old: bool) -> str:
        extra = "" if duration is None else f'"printDuration":{duration}'
        if info.get("thumbnails"):
            info = {**info, "thumbnails": [_in_order(one) for one in info["thumbnails"]]}
        decimals = self._model_text.decimals["job"]["file"]
        text = '{"err":0'
        for field in OLD_FIELDS if is_old else FIELDS:
            if field not in info or info[field] is None and field != "generatedBy":
                continue
            before = f"{extra}," if extra and field == "thumbnails" else ""
            text += f",{before}{quoted(field)}:{_shown(field, info[field], decimals)}"
        if extra and is_old:
            text += f',{extra},"fileName":{quoted(info["fileName"])}'
        return text + "}"


def _in_order(thumbnail: dict[str, Any]) -> dict[str, Any]:
    return {name: thumbnail[name] for name in THUMBNAIL_FIELDS if name in thumbnail}


def _shown(field: str, value: Any, decimals: Mapping[str, Any]) -> str:
    if field in HEIGHTS and not value:
        return "0.00"
    return encoded("" if value is None else value, decimals.get(field))


def piece_of_thumbnail(content: bytes, start: int, most: int) -> Piece:
    """Return a piece of a thumbnail's text, whole lines as far as there is room."""
    data, position = "", start
    while len(data) < most:
        if position >= len(content):
            return Piece(data, 0, 1)
        line = content[position:].split(b"\n", 1)[0]
        before, position = position, position + len(line) + 1
        letters = line.rstrip(b"\r").lstrip(b"; \t")
        if b" " in letters:
            # the end, or what can't be base64
            return Piece(data, 0, 0)
        room = most - len(data)
        if len(letters) > room:
            position = before + line.index(letters) + room
        data += letters[:room].decode("latin-1")
    return Piece(data, position, 0)
