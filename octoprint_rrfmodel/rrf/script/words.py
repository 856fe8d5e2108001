"""One line of a script: a command of Klipper's with its parameters, or G-code."""

from __future__ import annotations

import math
import re
import shlex
from collections.abc import Mapping
from typing import NamedTuple

from ..gcode.commands.outcome import bad
from ..gcode.commands.parameters import shown
from ..klipper.macro_names import KEYWORDS

_NAMED = re.compile(r"([A-Za-z_][A-Za-z_][A-Za-z0-9_]*)(?:[ \t]+(.*))?", re.ASCII | re.DOTALL)
"""A command with a name: group 1 the name, group 2 what is behind it. A letter with a number
behind it is G-code, and so is one with an expression."""


class Command(NamedTuple):
    """A command of Klipper's; getters raise ``Refused`` for what is of the wrong kind."""

    name: str
    """In capitals."""
    given: Mapping[str, str]
    """Parameters, their names in capitals."""

    def text(self, name: str, otherwise: str | None = None) -> str:
        """Return a text; refused where it is missing and there is nothing instead."""
        value = self.given.get(name, otherwise)
        if value is None:
            raise bad("macro_misses", command=self.name, parameter=name)
        return value

    def number(self, name: str, otherwise: float | None = None) -> float:
        """Return a finite number; refused where it is missing and there is nothing instead."""
        if name not in self.given and otherwise is not None:
            return otherwise
        try:
            value = float(self.text(name))
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise bad("not_a_number", parameter=name)
        return value

    def takes(self, *names: str) -> None:
        """Refuse parameters that none of these is: what they ask for would not be done."""
        for name in self.given:
            if name not in names:
                raise bad("macro_parameter", command=self.name, parameter=shown(name))


def command_of(line: str) -> Command | None:
    """Return the command of Klipper's that a line is, ``None`` for G-code.

    >>> command_of('SET_HEATER_TEMPERATURE heater="extruder" target=200').given
    {'HEATER': 'extruder', 'TARGET': '200'}
    >>> command_of("G28 X"), command_of("T1"), command_of("set global.a = 1")
    (None, None, None)
    """
    matched = _NAMED.fullmatch(line)
    if matched is None or matched[1] in KEYWORDS:
        return None
    name, behind = matched[1].upper(), matched[2] or ""
    reader = shlex.shlex(behind, posix=True)
    reader.whitespace_split = True
    reader.commenters = ";#"
    reader.escape = ""
    given = {}
    try:
        for word in reader:
            key, equals, value = word.partition("=")
            if not equals or not key:
                raise ValueError(word)
            given[key.upper()] = value
    except ValueError:
        raise bad("macro_form", command=shown(name)) from None
    return Command(name, given)
