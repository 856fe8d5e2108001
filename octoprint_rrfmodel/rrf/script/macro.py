"""A macro file of the machine's, run with the parameters that a command gives it."""

from __future__ import annotations

import re

from ..gcode.commands.outcome import bad
from ..gcode.commands.parameters import sendable, shown
from ..wire.gcode_words import quoted
from .steps import Operation, Step
from .words import Command

_NUMBER = re.compile(r"-?(?:[0-9]+\.?[0-9]*|\.[0-9]+)", re.ASCII)

OWN = "GMNPT"
"""Letters that mean something to M98 itself or would begin another command."""


def run(command: Command, path: str) -> Step:
    """Return the step that runs a macro; parameters have one letter there, and few letters."""
    words = []
    for name, value in command.given.items():
        if len(name) != 1 or not name.isalpha() or name in OWN:
            raise bad("macro_letters", command=shown(command.name), parameter=shown(name))
        sendable(name, value)
        words.append(f"{name}{value if _NUMBER.fullmatch(value) else quoted(value)}")
    return Operation("macro", {"path": path}, "".join(f" {word}" for word in words))
