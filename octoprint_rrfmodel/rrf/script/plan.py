"""A whole script as steps: refused as a whole if any part of it is."""

from __future__ import annotations

from collections.abc import Sequence

from ..gcode.commands.outcome import bad, forbidden
from ..gcode.commands.parameters import shown
from . import macro, move
from .refusals import REFUSALS
from .steps import At, Given, Step
from .table import BY_NAME
from .words import Command, command_of


def planned(lines: Sequence[str], at: At) -> list[Step]:
    """Return the steps of a script in their order; raises ``Refused`` if one can't be."""
    steps: list[Step] = []
    place = 0
    while place < len(lines):
        command = command_of(lines[place])
        place += 1
        if command is None:
            steps.append(Given(lines[place - 1]))
        elif command.name == move.SAVE:
            inner, place = _kept(lines, place)
            found = move.moves(inner)
            steps.extend(move.kept(inner) if found is None else found)
        else:
            steps.extend(_steps(command, at))
    return steps


def _kept(lines: Sequence[str], place: int) -> tuple[list[str], int]:
    """Return the G-code up to RESTORE_GCODE_STATE, and the place behind that.

    On this line's stack there is no name, and what isn't taken down again would stay for ever.
    """
    inner: list[str] = []
    while place < len(lines):
        command = command_of(lines[place])
        place += 1
        if command is None:
            inner.append(lines[place - 1])
        elif command.name == move.RESTORE:
            if command.given.get("MOVE", "0") != "0":
                raise forbidden("macro_move_back", restore=move.RESTORE)
            return inner, place
        else:
            break
    raise bad("macro_unpaired", save=move.SAVE, restore=move.RESTORE)


def _steps(command: Command, at: At) -> Sequence[Step]:
    row = BY_NAME.get(command.name)
    path = at.macros.get(command.name)
    if path is not None and (row is None or row.gives_way):
        return [macro.run(command, path)]
    if row is not None:
        return row.steps(command, at)
    raise forbidden(REFUSALS.get(command.name, "macro_unknown"), command=shown(command.name))
