"""Replies in the words that a host of the Marlin kind waits for.

``ROWS`` is the table: which reply, what it becomes, why. A reply that no row is about stays.
"""

from __future__ import annotations

import re
from typing import Callable, NamedTuple

from ..views.job import CardJob


class Situation(NamedTuple):
    """What the words depend on."""

    opened: tuple[str, int] | None = None
    """Alias and size of the file that was last asked for."""
    names_file: bool = False
    """Whether the host itself has asked for a file, and knows its name."""
    shows_print: bool = False
    """Whether the host shows a print from the card as going on."""
    shows_pause: bool = False
    """Whether it shows one as paused."""
    hides_print: bool = False
    """Whether the host must not hear of a print: it has ended it and the board still has to, or
    it would take it for one of another file."""
    cancels: bool = False
    """Whether the host itself is about to cancel it, and has told everybody so."""
    job: CardJob = CardJob()


Wording = Callable[["re.Match[str]", Situation], "str | None"]


class Row(NamedTuple):
    """One line of the table."""

    name: str
    """As the setting that switches it off is called."""
    begins: str
    """The first two characters of a line that this is about."""
    pattern: re.Pattern[str]
    say: Wording
    """Returns the line instead, ``None`` to leave it."""
    reason: str
    """Why, with the source."""


def _always(text: str) -> Wording:
    return lambda found, situation: text


UNLISTED = "// a file that is not in the list was opened"
"""In place of a reply about such a file: a comment to the host, without the reply's own words."""


DONE = "Done printing file"
CANCEL = "// action:cancel"
RESUMED = "// action:resumed"
"""What ends a print for the host, or goes on with it: in words that hosts of all kinds know."""

WITHHELD = "// how the print has ended comes next"
"""In place of what says that it has ended, and not how."""

KNOWN = "// the print has ended, as it was to"
"""The same of one that the host has ended by itself."""


def _opened(found: re.Match[str], situation: Situation) -> str | None:
    if situation.opened is None:
        return None if situation.names_file else UNLISTED
    alias, size = situation.opened
    return f"File opened: {alias} Size: {size}"


def _not_printing(found: re.Match[str], situation: Situation) -> str | None:
    job = situation.job
    if not situation.shows_print or situation.hides_print or not job.size:
        return None
    return f"SD printing byte {job.position}/{job.size}"


def _printing(found: re.Match[str], situation: Situation) -> str | None:
    return "Not SD printing." if situation.hides_print else None


def _position(found: re.Match[str], situation: Situation) -> str | None:
    return f"{found['axes']} E:{found['extruder']}"


def _done(found: re.Match[str], situation: Situation) -> str | None:
    if situation.cancels:
        return KNOWN
    return WITHHELD if situation.shows_print else None


def _finished(found: re.Match[str], situation: Situation) -> str | None:
    if situation.cancels:
        return None
    if situation.shows_pause:
        return RESUMED
    return DONE if situation.shows_print else None


def _cancelled(found: re.Match[str], situation: Situation) -> str | None:
    shows = situation.shows_print or situation.shows_pause
    return CANCEL if shows and not situation.cancels else None


ROWS = (
    Row(
        "mounted",
        "SD",
        re.compile(r"SD(HC)? card mounted in slot 0\b"),
        _always("SD card ok"),
        "M21 names the card's type and capacity (3.5 MassStorage.cpp:1118).",
    ),
    Row(
        "in_use",
        "Er",
        re.compile(r"Error: M2[12]: SD card (0 )?has open file\(s\)"),
        _always("SD card ok"),
        "While a file is printed the card is neither mounted anew nor released: it is there"
        " (3.5 MassStorage.cpp:1118-1205).",
    ),
    Row(
        "released",
        "SD",
        re.compile(r"SD card 0 may now be removed"),
        _always("SD card released"),
        "M22 (3.5 MassStorage.cpp:1205).",
    ),
    Row(
        "opened",
        "Fi",
        re.compile(r"File opened\s*$"),
        _opened,
        "M23 and M32 tell neither name nor size (3.5 GCodes2.cpp:1041); a host that shows a job"
        " has to know both. What its list doesn't have it can't take for its job: OctoPrint 2.0's"
        " connection would break at it.",
    ),
    Row(
        "not_printing",
        "No",
        re.compile(r"Not SD printing\.?\s*$"),
        _not_printing,
        "Three such answers to M27 and the host takes its job for cancelled; while the board"
        " still has one, being paused or about to end, that would be wrong.",
    ),
    Row(
        "printing",
        "SD",
        re.compile(r"SD printing byte \d+/\d+"),
        _printing,
        "A position that grows is a print of the selected file to the host: also the one that it"
        " has just cancelled, and one of another file that was started at the machine.",
    ),
    Row(
        "done",
        "Do",
        re.compile(r"Done printing file\b"),
        _done,
        "Comes first however a print has ended (3.5 GCodes.cpp:4431); to the host it is the end of"
        " one that went well, also behind a cancel.",
    ),
    Row(
        "finished",
        "Fi",
        re.compile(r"Finished printing file\b"),
        _finished,
        "Says that it went well. A host that shows a pause takes no end: it goes on first.",
    ),
    Row(
        "cancelled",
        "Ca",
        re.compile(r"Cancelled printing file\b"),
        _cancelled,
        "Says that it was ended at the machine or by the firmware, unless the host did that.",
    ),
    Row(
        "position",
        "X:",
        re.compile(r"(?P<axes>X:[^ ]+ Y:[^ ]+ Z:[^ ]+) (?!E)(?:[^ ]+ )+?E:(?P<extruder>[-.\d]+)"),
        _position,
        "M114 tells every visible axis between Z and E (3.5 GCodes.cpp:3332); a host that knows"
        " four of them finds no position.",
    ),
)

LIST_BEGINS, LIST_ENDS = "Begin file list", "End file list"
"""Around the names in the answer to a plain M20."""

BEGINNINGS = frozenset(row.begins for row in ROWS)
"""The first two characters of all lines that a row may be about: a look at them costs little."""

_ROWS_OF = {begins: [row for row in ROWS if row.begins == begins] for begins in BEGINNINGS}


def reword(
    line: str, situation: Callable[[], Situation], is_on: Callable[[str], bool] = lambda row: True
) -> str:
    """Return a reply in words that the host knows.

    ``is_on(row)`` says whether a row of the table is switched on; that and ``situation`` are asked
    for only if needed.
    """
    for row in _ROWS_OF.get(line[:2], ()):
        found = row.pattern.match(line)
        if found is not None:
            return is_on(row.name) and row.say(found, situation()) or line
    return line
