"""What can be asked of Duet Software Framework (DSF): paths, and answers in a board's form."""

from __future__ import annotations

import json
import re
from typing import Any
from urllib.parse import quote

MODEL_SOCKET = "/machine"

CODE = "/machine/code"

MOVE = "/machine/file/move"

NO_FOLDER, NO_FILE = 2, 1
"""``err`` of a board for a folder, and a file, that isn't there."""

_AT_ONCE = re.compile(r"\s*[Mm](?:108|112|122|292|999)(?![0-9])")

_MOMENT = re.compile(r"[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}")


def machine_path(request: str, path: str = "", /, **parameters: Any) -> str:
    """Return the path of a request, with the one of a file or folder that it is about.

    That is decoded twice (DSF MachineController.cs), so it is encoded twice.

    >>> machine_path("file", "0:/a+b.g")
    '/machine/file/0%253A%252Fa%252Bb.g'
    """
    about = f"/{quote(quote(path, safe=''), safe='')}" if path else ""
    told = "&".join(f"{key}={quote(str(value), safe='')}" for key, value in parameters.items())
    return f"/machine/{request}{about}{f'?{told}' if told else ''}"


def is_at_once(line: str) -> bool:
    """Return whether DSF takes a command past what runs (DSF SimpleCode.cs)."""
    return _AT_ONCE.match(line) is not None


def page_form(folder: str, text: str) -> str:
    """Return a list of a folder as a board has it; of what is none nothing is made better."""
    entries = _decoded(text)
    if not isinstance(entries, list):
        return text
    files = [_entry(each) for each in entries if isinstance(each, dict)]
    return json.dumps({"dir": folder, "first": 0, "files": files, "next": 0})


def no_folder(folder: str) -> str:
    """Return what a board says of a folder that isn't there."""
    return json.dumps({"dir": folder, "first": 0, "files": [], "err": NO_FOLDER})


def _entry(told: dict[str, Any]) -> dict[str, Any]:
    # folders have no size, and dates a fraction and a zone
    return {"size": 0, **told, "date": moment(told.get("date")) or ""}


def info_form(path: str, text: str) -> str:
    """Return what is read from a print file as a board has it."""
    told = _decoded(text)
    if not isinstance(told, dict):
        return text
    known = {name: value for name, value in told.items() if value is not None}
    known["lastModified"] = moment(told.get("lastModified"))
    if isinstance(told.get("thumbnails"), list):
        known["thumbnails"] = [
            {name: value for name, value in each.items() if name != "data"}
            for each in told["thumbnails"]
            if isinstance(each, dict)
        ]
    return json.dumps({"err": 0, **known, "fileName": path})


def no_file(path: str) -> str:
    """Return what a board says of a file that isn't there."""
    return json.dumps({"err": NO_FILE, "fileName": path})


def piece_form(path: str, offset: int, text: str) -> str:
    """Return the thumbnail that begins at a place, whole, as the answer about a piece of it."""
    told = _decoded(text)
    pictures = told.get("thumbnails") if isinstance(told, dict) else None
    for each in pictures if isinstance(pictures, list) else ():
        data = each.get("data") if isinstance(each, dict) else None
        if isinstance(data, str) and each.get("offset") == offset:
            piece = {"fileName": path, "offset": offset, "data": data, "next": 0, "err": 0}
            return json.dumps({"thumbnail": piece})
    return json.dumps({"thumbnail": {"fileName": path, "offset": offset, "err": NO_FILE}})


def moment(date: Any) -> str | None:
    """Return a date as a board tells it, by the clock of the place; ``None`` for what is none.

    >>> moment("2026-11-29T09:00:16.1234567+01:00")
    '2026-11-29T09:00:16'
    """
    found = _MOMENT.match(date) if isinstance(date, str) else None
    return found[0] if found else None


def _decoded(text: str) -> Any:
    try:
        return json.loads(text)
    except (ValueError, RecursionError):
        return None
