"""What can be asked of a board over its network: requests as paths, answers in a line's form."""

from __future__ import annotations

import re
from typing import Any
from urllib.parse import quote

from .request import FileRequest, ListRequest, ModelRequest, PieceRequest

_NAME = r"[A-Za-z0-9_]+(?:\[[0-9]*\])*"

_CLEAN_KEY = re.compile(rf"(?:#?{_NAME}(?:\.{_NAME})*)?")
"""Keys that any firmware survives: up to 3.5 what can't be evaluated may reset the board."""

_CLEAN_FLAGS = re.compile(r"[A-Za-z0-9]*")

LONGEST_LINE = 240
"""Bytes of a command that may wait in the board's input of 255 with room for a stop behind it."""

LONGEST_PATH = 115
"""Bytes of a file's path that can be uploaded: the board puts ``.part`` behind it."""


def path_of(request: str, /, **parameters: Any) -> str:
    """Return the path of a request: ``rr_gcode?gcode=G28``.

    >>> path_of("gcode", gcode="G1 X+1")
    '/rr_gcode?gcode=G1%20X%2B1'
    """
    told = "&".join(f"{key}={quote(str(value), safe='')}" for key, value in parameters.items())
    return f"/rr_{request}?{told}" if told else f"/rr_{request}"


def request_path(request: Any) -> str | None:
    """Return the path that asks what a request asks, ``None`` for what isn't asked this way."""
    if isinstance(request, ModelRequest):
        is_clean = _CLEAN_KEY.fullmatch(request.key) and _CLEAN_FLAGS.fullmatch(request.flags)
        return path_of("model", key=request.key, flags=request.flags) if is_clean else None
    if isinstance(request, ListRequest):
        return path_of("filelist", dir=request.folder, first=request.first)
    if isinstance(request, FileRequest):
        return path_of("fileinfo", name=request.path)
    if isinstance(request, PieceRequest):
        return path_of("thumbnail", name=request.path, offset=request.offset)
    return None


def line_form(request: Any, text: str) -> str:
    """Return an answer as the same question over a line has it."""
    text = text.strip()
    return f'{{"thumbnail":{text}}}' if isinstance(request, PieceRequest) else text
