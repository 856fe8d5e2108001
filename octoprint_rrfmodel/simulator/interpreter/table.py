"""Command → function, for the whole board, and the rules that stand above all commands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Callable

from ..gcodes import (
    coordinates,
    filaments,
    files,
    heaters,
    homing,
    messagebox,
    meta,
    moves,
    reports,
    tools,
)
from ..gcodes import prints as jobcodes
from ..gcodes import system as settings
from ..line.channel import Channel, Outcome
from ..text.command import Command, GCodeError
from ..text.serial_line import Reply

if TYPE_CHECKING:
    from ..core import Core

Function = Callable[["Core", Channel, Command], Outcome]

MODULES = (
    settings,
    filaments,
    moves,
    coordinates,
    homing,
    tools,
    heaters,
    reports,
    files,
    jobcodes,
    messagebox,
    meta,
)

TABLE: dict[str, Function] = {}
for _module in MODULES:
    TABLE.update(_module.TABLE)

WHILE_HALTED = frozenset(("M105", "M112", "M115", "M122", "M408", "M409", "M999"))
"""RRF 3.5 GCodes2.cpp:585."""

SINCE = {
    "M568": (3, 3),
    "M36.1": (3, 4),
    "M73": (3, 3),
    "M409": (3, 1),
    "M486": (3, 1),
    "M601": (3, 1),
}
"""Command → first release that knows it."""

UNTIL = {"M38": (3, 5)}
"""Command → first release that knows it no longer."""


def key_of(command: Command) -> str:
    """Return the command's key in :data:`TABLE`; fractions other than M36.1 don't count."""
    if command.letter in ("T", "meta"):
        return command.letter
    return f"{command.letter}{command.number}"


def execute(board: Core, channel: Channel, command: Command) -> Outcome:
    """Return what the command's function returns; an unknown one is tried as a macro."""
    key = key_of(command)
    if board.is_halted and key not in WHILE_HALTED:
        raise GCodeError("Machine is halted")
    function = TABLE.get(key)
    since = SINCE.get("M36.1" if command.name == "M36.1" else key)
    until = UNTIL.get(key)
    release = board.firmware.release
    if (
        function is None
        or (since is not None and release < since)
        or (until is not None and release >= until)
    ):
        return _unknown(board, channel, command)
    return function(board, channel, command)


def _unknown(board: Core, channel: Channel, command: Command) -> Outcome:
    lines = board.card.lines(f"0:/sys/{command.name}.g")
    if lines is not None:
        return channel.macro(lines)
    return Reply(f"Warning: {command.name}: Command is not supported")
