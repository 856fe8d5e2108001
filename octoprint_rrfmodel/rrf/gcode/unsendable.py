"""Commands that a host had better not send over USB: the line would hang, or warn for nothing.

``ROWS`` is the table: command, condition, why with the source. Lines with nothing but a comment
belong here too (3.5 GCodes2.cpp:4931), but a host that counts acknowledgements strips comments.
"""

from __future__ import annotations

import re
from typing import Callable, NamedTuple

from ..views.machine import Machine
from ..views.warnings import loses_boxes
from ..wire.gcode_words import texts

_QUOTED = re.compile(r'"(?:[^"]|"")*"')

_MODE = re.compile(r"S\s*(?P<mode>\S+)")
"""The mode of M291; group ``mode`` is what stands behind the letter."""

_PLAIN_MODES = ("0", "1")
"""Message boxes that nothing waits for."""


class Row(NamedTuple):
    """One line of the table."""

    name: str
    """As the setting that switches it off is called."""
    gcodes: tuple[str, ...]
    hits: Callable[[str, Machine], bool]
    """Whether a command, without the texts in it, is one of those on that machine."""
    is_told: bool
    """Whether a person has to know that it wasn't sent."""
    pauses: bool
    """Whether a person was to act there, so that a print must not go on by itself."""
    reason: str
    """Why, with the source."""


def _always(command: str, machine: Machine) -> bool:
    return True


def without_texts(command: str) -> str:
    """Return a command with nothing between its quotes."""
    return _QUOTED.sub('""', command)


def waits_for_answer(command: str) -> bool:
    """Return whether an M291, without the texts in it, opens a box that wants an answer."""
    mode = _MODE.search(command)
    return mode is not None and mode["mode"] not in _PLAIN_MODES


def _waits_for_ever(command: str, machine: Machine) -> bool:
    return waits_for_answer(command) and loses_boxes(machine.version)


def _is_unacknowledged(command: str, machine: Machine) -> bool:
    parameters = command[len("M111") :].strip()
    return not parameters or "P" in parameters.upper()


ROWS = (
    Row(
        "message_box",
        ("M291",),
        _waits_for_ever,
        True,
        True,
        "From 3.5.0 to 3.6.0 M292 does not reach a box that USB has opened, and the channel waits"
        " for ever (Duet3D/RepRapFirmware #1141).",
    ),
    Row(
        "debug_table",
        ("M111",),
        _is_unacknowledged,
        True,
        False,
        "Without parameters and with P there is no ok (3.5 GCodes2.cpp:1914, :1931).",
    ),
    Row(
        "probes",
        ("M113", "M154", "M155", "M410"),
        _always,
        False,
        False,
        "No firmware has them: each earns a warning (3.3 to 3.6).",
    ),
)

PAUSES = frozenset(("M25", "M226", "M600", "M601"))
"""Places at which a file on the card pauses its job. Of a channel that prints no file the firmware
takes none of them (seen in 3.5.3), so that a file that a host streams would go on, in the old
colour for example; there they pause the host's print."""

PAUSE_ROW = "file_pause"
"""As the setting that switches that off is called."""

CHANGES_FILAMENT = "M600"

GCODES = frozenset(gcode for row in ROWS for gcode in row.gcodes)

_BY_GCODE = {gcode: row for row in ROWS for gcode in row.gcodes}


def unsendable(command: str, gcode: str, machine: Machine) -> Row | None:
    """Return the row because of which a command is better not sent, ``None`` for others."""
    row = _BY_GCODE.get(gcode)
    return row if row is not None and row.hits(without_texts(command), machine) else None


def text_of_box(command: str) -> str:
    """Return what a message box would say, the command itself where that is no plain text."""
    return texts(command).get("P", command)
