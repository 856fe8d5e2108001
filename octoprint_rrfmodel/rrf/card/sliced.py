"""What slicers write at the beginning of a print file: who made it, and its pictures.

The same text is what the firmware reads (3.5 FileInfoParser.cpp); here it is read of files that
never were on a card.
"""

from __future__ import annotations

import re
from typing import BinaryIO, NamedTuple

from .thumbnail import Thumbnail

MOST_BYTES = 2_000_000
"""How much of a file is looked at; its pictures come before its first moves."""

MOST_CODE = 50
"""Lines of G-code behind which no picture is looked for any more."""

MOST_PICTURES = 12

LONGEST_LINE = 1000

_BEGIN = re.compile(
    rb";\s*thumbnail(?:_(?P<format>JPG|PNG|QOI))?\s+begin\s+"
    rb"(?P<width>\d{1,4})[ x](?P<height>\d{1,4})\s+(?P<size>\d{1,7})\b"
)
"""Groups: the format where it isn't PNG, the sides, the letters of base64."""

_END = re.compile(rb";\s*thumbnail\w*\s+end\b")

_MADE_BY = re.compile(
    r"(?:generated (?:by|with)\s+)?(?P<name>[A-Za-z][\w()-]{0,40}(?: [A-Za-z(][\w()-]{0,40}){0,2}?)"
    r"[ ]+(?:version )?v?(?P<version>\d[\w.+-]{0,40})",
    re.IGNORECASE,
)
"""Groups: the slicer's name, its version."""

_GENERATED = re.compile(rb";.{0,40}?generated (?:by|with)\s+(?P<by>[^\r\n]{1,120})", re.IGNORECASE)

FORMATS = {b"": "png", b"PNG": "png", b"JPG": "jpeg", b"QOI": "qoi"}

KNOWN_AS = {"Cura_SteamEngine": "Cura", "Simplify3D(R)": "Simplify3D"}
"""Slicers that people know by another name."""


class Sliced(NamedTuple):
    """What a file's beginning tells."""

    slicer: str = ""
    version: str = ""
    thumbnails: tuple[Thumbnail, ...] = ()
    """``offset`` is where the line of the first letters begins."""


def slicer_of(text: str) -> tuple[str, str]:
    """Return name and version of the slicer that a text names, both empty for none.

    >>> slicer_of("PrusaSlicer 2.8.1 on 2024-11-04 at 19:20:11 UTC")
    ('PrusaSlicer', '2.8.1')
    """
    found = _MADE_BY.match(text.strip())
    if found is None:
        return "", ""
    return KNOWN_AS.get(found["name"], found["name"]), found["version"]


def sliced(file: BinaryIO) -> Sliced:
    """Return what the beginning of a file tells, which is open and read from its place on."""
    slicer = "", ""
    thumbnails: list[Thumbnail] = []
    code = 0
    while code < MOST_CODE and file.tell() < MOST_BYTES and len(thumbnails) < MOST_PICTURES:
        line = file.readline(LONGEST_LINE)
        if not line:
            break
        if not line.lstrip().startswith(b";"):
            code += bool(line.strip())
            continue
        begin = _BEGIN.match(line.lstrip())
        if begin is not None:
            thumbnail = Thumbnail(
                FORMATS[begin["format"] or b""],
                int(begin["width"]),
                int(begin["height"]),
                file.tell(),
                int(begin["size"]),
            )
            if _is_real(thumbnail):
                thumbnails.append(thumbnail)
        elif not slicer[0]:
            made = _GENERATED.match(line.lstrip())
            slicer = slicer_of(made["by"].decode("utf-8", "replace")) if made else slicer
    return Sliced(*slicer, tuple(thumbnails))


def letters_of(file: BinaryIO, thumbnail: Thumbnail) -> str:
    """Return the base64 text of a picture, as far as it is there."""
    file.seek(thumbnail.offset)
    letters = b""
    while len(letters) < thumbnail.size:
        line = file.readline(LONGEST_LINE).strip()
        if not line.startswith(b";") or _END.match(line):
            break
        letters += line[1:].strip()
    return letters[: thumbnail.size].decode("ascii", "replace")


def _is_real(thumbnail: Thumbnail) -> bool:
    is_some = thumbnail.width > 0 and thumbnail.height > 0 and thumbnail.size > 0
    return is_some and thumbnail.size <= MOST_BYTES
