"""What a script comes to, step by step, and what that is decided from."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Callable, NamedTuple, Union

from ..klipper.view import View
from ..views.machine import Machine
from .words import Command


class Given(NamedTuple):
    """A line of G-code that somebody wrote, to be sent as it is."""

    line: str


class Lines(NamedTuple):
    """Lines that stand for a command of Klipper's."""

    lines: tuple[str, ...]


class Operation(NamedTuple):
    """A command of the plugin's own table (``rrf.gcode.commands``), checked by that."""

    name: str
    parameters: Mapping[str, Any]
    behind: str = ""
    """What goes behind its line."""


class Asked(NamedTuple):
    """A method of Moonraker's that does the same."""

    method: str
    params: Mapping[str, Any] = {}


class Restart(NamedTuple):
    """The board begins anew."""


Step = Union[Given, Lines, Operation, Asked, Restart]


class At(NamedTuple):
    """One moment, as scripts are understood in it."""

    view: View
    machine: Machine
    macros: Mapping[str, str]
    """Macro files by their names as commands, in capitals."""


class Row(NamedTuple):
    """A command of Klipper's; adding one is adding a row."""

    name: str
    steps: Callable[[Command, At], Sequence[Step]]
    """Raises ``Refused`` where it can't be."""
    help: str
    """One line, for ``printer.gcode.help``."""
    is_listed: Callable[[At], bool] = lambda at: True
    """Whether the machine has what the command is about."""
    gives_way: bool = False
    """Whether a macro of the machine's that has the same name is meant instead."""
