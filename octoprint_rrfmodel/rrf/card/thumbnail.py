"""Pictures that slicers put into files: which of them to fetch, from which pieces, of what kind."""

from __future__ import annotations

import base64
import struct
import zlib
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

from ..wire.reply import MalformedReply, members_of
from .qoi import MAGIC as QOI
from .qoi import png_of

WIDEST = 320
"""Widest and highest picture that is fetched; slicers like 300 and 320."""

MOST_LETTERS = 120_000
"""Longest base64 text of a picture: a hundred pieces and more, each of them a question."""

PNG, JPEG = b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff"
"""How the pictures begin that a browser shows."""

JPEG_END = b"\xff\xd9"

FORMATS = ("png", "jpeg", "jpg", "qoi")
"""``thumbnails[].format`` (3.5 GCodeFileInfo.h)."""


class Thumbnail(NamedTuple):
    """Where in a file a picture is."""

    format: str
    width: int
    height: int
    offset: int
    size: int
    """Letters of its base64 text."""


class PrintFile(NamedTuple):
    """What ``M36`` and ``job.file`` tell of a file."""

    size: int
    date: str
    thumbnails: tuple[Thumbnail, ...]
    told: Mapping[str, Any] = MappingProxyType({})
    """All that is told."""


class Piece(NamedTuple):
    """An answer to ``M36.1``."""

    path: str
    offset: int
    data: str
    next: int
    """Place in the file to go on with, 0 at the end."""
    error: int


class Picture(NamedTuple):
    """A picture as a browser takes it."""

    kind: str
    data: bytes


def print_file(members: Any) -> PrintFile | None:
    """Return what is told of a file, ``None`` where it tells no name: there is none."""
    if not isinstance(members, dict) or not isinstance(members.get("fileName"), str):
        return None
    size, date = members.get("size"), members.get("lastModified")
    found = members.get("thumbnails")
    return PrintFile(
        size if type(size) is int else 0,
        date if isinstance(date, str) else "",
        tuple(_thumbnails(found if isinstance(found, list) else ())),
        members,
    )


def _thumbnails(found: Iterable[Any]) -> Iterable[Thumbnail]:
    for each in found:
        told = each if isinstance(each, dict) else {}
        thumbnail = Thumbnail._make(map(told.get, Thumbnail._fields))
        is_whole = all(type(number) is int and number > 0 for number in thumbnail[1:])
        if is_whole and thumbnail.format in FORMATS:
            yield thumbnail


def best(thumbnails: Iterable[Thumbnail]) -> Thumbnail | None:
    """Return the biggest picture that isn't too big, ``None`` where there is none."""
    fitting = [
        each
        for each in thumbnails
        if max(each.width, each.height) <= WIDEST and each.size <= MOST_LETTERS
    ]
    return max(fitting, key=lambda each: each.width * each.height, default=None)


def decode_file(text: str) -> tuple[str, PrintFile | None]:
    """Return the name and what an answer to ``M36`` tells, ``None`` where there is no file."""
    members = members_of(text)
    name = members.get("fileName", "")
    told = print_file(members) if members.get("err") == 0 else None
    return (name if isinstance(name, str) else ""), told


def decode_piece(text: str) -> Piece:
    """Return what an answer to ``M36.1`` says; raise ``MalformedReply`` if it can't be read."""
    inner = members_of(text).get("thumbnail")
    told = inner if isinstance(inner, dict) else {}
    known = {"data": "", "next": 0, "err": 0, **told}
    piece = Piece._make(map(known.get, ("fileName", "offset", "data", "next", "err")))
    kinds = (str, int, str, int, int)
    if any(type(value) is not kind for value, kind in zip(piece, kinds)):
        raise MalformedReply(f"no piece of a thumbnail: {text[:80]!r}")
    return piece


def picture(letters: str) -> Picture | None:
    """Return the picture that a base64 text is, ``None`` where it is none or is broken.

    PNG has checksums; of JPEG and QOI it is seen whether they are whole, not whether each byte is
    right.
    """
    try:
        data = base64.b64decode(letters, validate=True)
        if data.startswith(QOI):
            return Picture("image/png", png_of(data))
    except ValueError:
        return None
    if data.startswith(PNG) and _is_whole_png(data):
        return Picture("image/png", data)
    if data.startswith(JPEG) and data.rstrip(b"\0").endswith(JPEG_END):
        return Picture("image/jpeg", data)
    return None


def _is_whole_png(data: bytes) -> bool:
    """Return whether each chunk up to the last one has its checksum (PNG specification, 5.3)."""
    at = len(PNG)
    while at + 12 <= len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        end = at + 8 + length
        if data[end : end + 4] != struct.pack(">I", zlib.crc32(data[at + 4 : end])):
            return False
        if kind == b"IEND":
            return True
        at = end + 4
    return False
