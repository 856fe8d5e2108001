"""A command as lines, or why there are none: its parameters read, its states looked at."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ...views.machine import Machine
from ..operations import Lines
from . import parameters
from .outcome import Refusal, Refused, Request, Situation, bad
from .states import WITHOUT_MACHINE, forbid
from .table import COMMANDS

LINE_BYTES = 255
OLD_LINE_BYTES = 200
"""Longest line that the firmware reads, from 3.4 on and before (3.4 GCodeBuffer.h)."""

LONG_LINES_SINCE = (3, 4)

_BY_NAME = {command.name: command for command in COMMANDS}


def translate(
    name: str, given: Mapping[str, Any], machine: Machine, situation: Situation
) -> Lines | Refusal:
    """Return the lines of a command, or why nothing is to be sent; never raises.

    What is malformed is told before what the printer's state forbids. ``refresh`` and ``recover``
    have no lines: somebody else does them.
    """
    try:
        return Lines(tuple(_lines(name, given, machine, situation)))
    except Refused as refused:
        return refused.refusal


def _lines(
    name: str, given: Mapping[str, Any], machine: Machine, situation: Situation
) -> Sequence[str]:
    command = _BY_NAME.get(name) if isinstance(name, str) else None
    if command is None:
        raise bad("unknown_command", command=parameters.shown(name), known=_names())
    values = parameters.values_of(name, command.parameters, given, machine)
    request = Request(values, machine, situation)
    states = (*(WITHOUT_MACHINE if command.needs_machine else ()), *command.forbidden)
    try:
        lines = command.lines(request)
    except Refused as refused:
        if refused.refusal.status == 409:
            # the state that says most comes first
            forbid(request, *states)
        raise
    most = LINE_BYTES if machine.version >= LONG_LINES_SINCE else OLD_LINE_BYTES
    if any(len(line.encode("utf-8")) > most for line in lines):
        raise bad("line_too_long", most=str(most))
    forbid(request, *states)
    return lines


def _names() -> str:
    return parameters.listed(sorted(_BY_NAME))
