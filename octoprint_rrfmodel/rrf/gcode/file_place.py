"""Where a line stands in its file, from how many bytes a host has read up to its end."""

from __future__ import annotations

import os
from typing import NamedTuple

CHUNK = 1024 * 1024

LONGEST = 4096
"""Bytes of a line that are looked at."""


class Place(NamedTuple):
    """A line of a file."""

    command: str
    """As the host has it, without a comment."""
    path: str = ""
    position: int = 0
    """Where the next line begins."""


def text_at(place: Place) -> str | None:
    """Return the line as it stands in the file, ``None`` where that is no longer to be found.

    A host that miscounts bytes, of letters that it can't read for example, tells a wrong place.
    """
    try:
        with open(place.path, "rb") as file:
            position = min(place.position, os.path.getsize(place.path))
            begin = max(0, position - LONGEST)
            file.seek(begin)
            before = file.read(position - begin)
    except OSError:
        return None
    lines = before.decode("utf-8", "replace").lstrip("\ufeff").splitlines()
    text = lines[-1].strip() if lines else ""
    return text if text.startswith(place.command) else None


def line_number(place: Place) -> int | None:
    """Return the number of the line in its file, the first is 1; ``None`` where nobody knows."""
    if text_at(place) is None:
        return None
    count, left, last = 0, place.position, b""
    try:
        with open(place.path, "rb") as file:
            while left > 0:
                chunk = file.read(min(CHUNK, left))
                if not chunk:
                    break
                count += chunk.count(b"\n")
                left -= len(chunk)
                last = chunk[-1:]
    except OSError:
        return None
    return count if last == b"\n" else count + 1


def named(place: Place) -> str:
    """Return a line for a sentence: its number, where it is known, and what it says."""
    number = line_number(place)
    return place.command if number is None else f"{number}: {place.command}"
