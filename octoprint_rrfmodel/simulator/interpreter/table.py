"""Command → function, for the whole board, and the rules that stand above all commands."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Callable, NamedTuple, Protocol

from ..device.activity import Activity
from ..firmware import Firmware, Release, is_within
from ..line.channel import Channel
from ..line.outcome import Outcome
from ..text.command import Command, GCodeError
from ..text.serial_line import NO_REPLY

Function = Callable[[Channel, Command], Outcome]


class Row(NamedTuple):
    """What a G-code does, and which releases know it."""

    function: Function
    since: Release | None = None
    """First release that knows it."""
    until: Release | None = None
    """First release that knows it no longer."""

    def is_known_to(self, release: Release) -> bool:
        return is_within(release, self.since, self.until)


Rows = Mapping[str, Row]
"""G-code → row. ``T`` stands for all tools, ``meta`` for all meta commands."""


class Group(Protocol):
    """G-codes that work on the same parts of a board."""

    def rows(self) -> Rows:
        """Return the rows of the table that these G-codes are."""


WITH_FRACTIONS = frozenset(
    ("G38", "G59", "M36", "M569", "M586", "M587", "M588", "M589", "M672", "M955", "M956")
)
"""Whose fractions mean something; any other makes a command one that isn't supported."""

UNKNOWN = "unknown"
"""Row of whatever has no other."""

WHILE_HALTED = frozenset(("M105", "M112", "M115", "M122", "M408", "M409", "M999"))
"""RRF 3.5 GCodes2.cpp:585."""


class GCodes:
    """The table that G-codes are registered in, for one firmware."""

    def __init__(self, firmware: Firmware, activity: Activity):
        self._firmware = firmware
        self._activity = activity
        self._rows: dict[str, Row] = {}

    def register(self, *groups: Group) -> None:
        """Add rows; a G-code that was in the table before means this from now on."""
        for group in groups:
            self._rows.update(group.rows())

    def names(self) -> list[str]:
        """Return the G-codes that there are functions for, in whichever release."""
        return sorted(self._rows.keys() - {UNKNOWN})

    def execute(self, channel: Channel, command: Command) -> Outcome:
        """Return what the command's function returns."""
        name, row = self._row_of(command)
        if command.letter == "Q":
            return NO_REPLY
        if self._activity.is_halted and name not in WHILE_HALTED:
            raise GCodeError("Machine is halted")
        if row is None or not row.is_known_to(self._firmware.release):
            row = self._rows[UNKNOWN]
        return row.function(channel, command)

    def _row_of(self, command: Command) -> tuple[str, Row | None]:
        """Return name and row; a fraction counts where it has a row of its own, as M36.1."""
        if command.letter in ("T", "meta"):
            return command.letter, self._rows.get(command.letter)
        if command.fraction >= 0 and command.name in self._rows:
            return command.name, self._rows[command.name]
        name = f"{command.letter}{command.number}"
        if command.fraction > 0 and name not in WITH_FRACTIONS:
            return name, None
        return name, self._rows.get(name)
