"""What a command is asked with, and why it may be refused."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from ...views.machine import Machine


class Situation(NamedTuple):
    """What the model can't tell: the host's side."""

    is_connected: bool
    is_rrf: bool
    """Whether the printer has said that it runs RepRapFirmware."""
    octoprint_prints: bool
    """Whether the host streams a print of its own, going on or paused."""
    octoprint_is_paused: bool
    """Whether that print is paused."""
    answers_boxes: bool
    """Whether the firmware takes an answer to the message box that waits on this line."""
    box_is_answered: bool = False
    """Whether the model may still show a box that was just answered."""
    line_is_held: bool = False
    """Whether a box holds the line that nobody can answer over it: the host can't end its print."""


class Refusal(NamedTuple):
    """Nothing is sent; why, as a code and the values that belong into its sentence."""

    status: int
    """As in HTTP: 400 malformed or out of range, 404 unknown, 409 forbidden by the state."""
    code: str
    values: Mapping[str, str]


class Refused(Exception):
    """Carries a ``Refusal`` out of whatever finds it."""

    def __init__(self, status: int, code: str, values: Mapping[str, str]) -> None:
        super().__init__(code)
        self.refusal = Refusal(status, code, values)


class Request(NamedTuple):
    """A command with parameters that were read, those left out as their default."""

    values: Mapping[str, Any]
    machine: Machine
    situation: Situation


def bad(code: str, **values: str) -> Refused:
    """Return the exception for what is malformed, or out of the range that the model gives."""
    return Refused(400, code, values)


def unknown(code: str, **values: str) -> Refused:
    """Return the exception for a thing that does not exist."""
    return Refused(404, code, values)


def forbidden(code: str, **values: str) -> Refused:
    """Return the exception for what the printer's state forbids."""
    return Refused(409, code, values)
