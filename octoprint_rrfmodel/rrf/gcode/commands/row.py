"""The form of a row in the table of commands."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Callable, NamedTuple

from .outcome import Request
from .parameters import Parameter, Read
from .states import State


class Command(NamedTuple):
    """One line of the table."""

    name: str
    parameters: tuple[Parameter, ...]
    forbidden: tuple[State, ...]
    """States that forbid it, whatever it is asked with."""
    lines: Callable[[Request], Sequence[str]]
    """What goes out; raises ``Refused`` for what depends on several parameters."""
    source: str
    """Where the firmware says so."""
    needs_machine: bool = True
    """Whether it needs one that is connected and takes commands."""


def optional(name: str, read: Read, default: Any = None) -> Parameter:
    """Return a parameter that may be left out."""
    return Parameter(name, read, False, default)
