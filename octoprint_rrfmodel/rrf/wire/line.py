"""Where in a received line the board's JSON is; nothing is decoded here unless it must be.

Messages without a line end of their own glue to the next line, before or behind the JSON
(RepRapFirmware 3.5 Platform.cpp:1396, FileStore.cpp:78), so a line is searched, not compared.
"""

from __future__ import annotations

import json
import re
from typing import Any, NamedTuple

MODEL_REPLY = '{"key":'
NO_BUFFERS = '{"err":-1}'
STATUS_REPLY = '{"status":'
CONFIG_REPLY = '{"axisMins":'
LIST_REPLY = '{"dir":'
FILE_REPLY = '{"err":0,"fileName":'
OLD_FILE_REPLY = '{"err":0,"size":'
"""The same before 3.1, which names the file last, and only where it is the one being printed."""

NO_FILE_REPLY = '{"err":1'
THUMBNAIL_REPLY = '{"thumbnail":'

FILE_REPLIES = (FILE_REPLY, OLD_FILE_REPLY, NO_FILE_REPLY, THUMBNAIL_REPLY)

REPLY_STARTS = (
    MODEL_REPLY,
    STATUS_REPLY,
    NO_BUFFERS,
    CONFIG_REPLY,
    LIST_REPLY,
    *FILE_REPLIES,
)
"""How M409, M408 S0..S4, a reply short of buffers, M408 S5, M20 S2 and S3, M36, M36 of no file, and
M36.1 begin."""

_NOT_INSIDE = r'(?<!":)(?<!":\[)(?<!\},)'
"""Not behind what an object stands behind in another JSON: M36 and M20 answer with some, too."""

_NUMBER = r'(?:"line":[0-9]{1,10},)?'
"""Current firmware (3.6.2 and newer, Duet3D/RepRapFirmware #1178) puts the number of the command
into the answer to a numbered one, mostly as the first member; its place isn't promised."""

_TOLD = (FILE_REPLY, OLD_FILE_REPLY)

_STARTS = (*(start[1:] for start in REPLY_STARTS if start not in _TOLD), '"err":-1,"line":')
"""What a reply begins with behind its brace, and perhaps behind that member."""

_START = re.compile(
    rf"{_NOT_INSIDE}\{{{_NUMBER}(?:"
    + "|".join(map(re.escape, _STARTS))
    + rf'|"err":0,{_NUMBER}"(?:fileName|size)":)'
)
"""The start of a reply that isn't a part of something else."""

_NAME = '"line"'

_LINE = re.compile(r'"line":([0-9]{1,10})(?=([,}]))')
"""The member with the command's number, and what stands behind it."""

_LAST_LINE = re.compile(r'"line":[0-9]{1,10}(?:,"[a-z]+":[0-9]+)?\}$')
"""The same as the last member or the last but one, as before ``next``."""

_BEHIND_OBJECT = re.compile(r"\}[^,\]}]")
"""An object's end and a character that can't stand behind it in JSON, unless in a text."""

_TEXT_OR_BRACE = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"?|[{}]')
"""A JSON string, to its end or that of all, or a brace that is in none."""

_SCAN: Any = json.JSONDecoder(strict=False).scan_once  # type: ignore[attr-defined]

_LEVELS = {"{": 1, "}": -1}


VOLTAGE_WARNING = "Warning: "
"""How a message begins that has no line end of its own (RepRapFirmware 3.5 Platform.cpp:1396)."""

_GLUED_OK = re.compile(r"Warning: .* event \([0-9.]+V\)(?=ok\b)")
"""Such a message in front of an acknowledgement."""


class Found(NamedTuple):
    """A reply in a line, and what stands around it."""

    reply: str
    """The JSON text, or as much of it as has come."""
    rest: str
    """The line without it, stripped; a glued ``ok`` comes first. Empty for a whole line."""
    number: int | None = None
    """Line number of the command that it answers, where the firmware tells it; no longer a part
    of ``reply``."""

    @property
    def is_of_a_file(self) -> bool:
        """Whether it answers M36 or M36.1, which others than the plugin ask too."""
        return self.reply.startswith(FILE_REPLIES)


def find_reply(line: str) -> Found | None:
    """Return the board's JSON in ``line``, or ``None`` where there is none.

    ``'Warning: VIN under-voltage event (11.0V){"key":"","flags":"f","result":{}}\\n'`` gives the
    object as ``reply`` and the warning as ``rest``. A reply that was cut off reaches to the end
    of the line, except for an ``ok`` that stands there: that one is OctoPrint's.
    """
    start = _start(line)
    if start < 0:
        return None
    text = line[start:].rstrip()
    before = line[:start].strip("\0 \t\r\n")
    if not before and text[-1] == "}" and not _BEHIND_OBJECT.search(text):
        reply, number = _without_number(text)
        return Found(reply, "", number)
    end = _end(text)
    after = text[end:].strip("\0 \t")
    if after.startswith("ok"):
        rest = f"{after} {before}" if before else after
    else:
        rest = f"{before} {after}" if before and after else before or after
    reply, number = _without_number(text[:end])
    return Found(reply, rest, number)


def without_warning(line: str) -> str:
    """Return the line from the ``ok`` on where a message is glued before one, else the line.

    ``'Warning: VIN under-voltage event (11.0V)ok T0:21.3 /0.0'`` gives ``'ok T0:21.3 /0.0'``.
    """
    found = _GLUED_OK.match(line)
    return line[found.end() :] if found else line


def _start(line: str) -> int:
    """Return where the first reply of a line starts, -1 where none does."""
    if line.startswith(REPLY_STARTS):
        return 0
    found = _START.search(line)
    return found.start() if found else -1


def _without_number(text: str) -> tuple[str, int | None]:
    """Return a reply without its member ``line``, and what that says; others are below it."""
    if _NAME not in text:
        return text, None
    # where it stands in fact comes first: this runs for each reply of a print
    start = 1 if text.startswith(_NAME, 1) else text.rfind(_NAME)
    if start > 1 and not _LAST_LINE.match(text, start):
        start = _member(text)
    found = _LINE.match(text, start) if start >= 0 else None
    if found is None:
        return text, None
    if found[2] == ",":
        return text[:start] + text[found.end() + 1 :], int(found[1])
    return text[: start - 1] + text[found.end() :], int(found[1])


def _member(text: str) -> int:
    """Return where the member ``line`` of the outermost object begins, -1 where it has none."""
    level = 0
    for found in _TEXT_OR_BRACE.finditer(text):
        if level == 1 and found[0] == _NAME and text.startswith(":", found.end()):
            return found.start()
        level += _LEVELS.get(found[0], 0)
    return -1


def _end(text: str) -> int:
    """Return where the object that ``text`` starts with ends; for a cut one, where all ends."""
    try:
        end: int = _SCAN(text, 0)[1]
        return end
    except (StopIteration, ValueError, RecursionError):
        pass
    # broken somewhere, or with a nan in it: whole all the same if its braces are balanced
    level = 0
    for found in _TEXT_OR_BRACE.finditer(text):
        level += _LEVELS.get(found[0], 0)
        if level == 0:
            return found.end()
    return len(text) - 2 if text.endswith("ok") else len(text)
