"""View: the channels that commands come from, and which of them is the host's own line.

Its number and name depend on firmware, board and plug: 3.7 has two channels over USB, and a host
may be connected to a serial port of the board.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .machine import array, mapping

CARD = "File"
"""The channel of a print from the card."""

LINES = ("USB", "Aux")
"""How the names of channels begin that a host's line may be, the likelier first."""

NO_LINES = frozenset(
    (
        "HTTP",
        "Telnet",
        "File",
        "Trigger",
        "Queue",
        "LCD",
        "SBC",
        "Daemon",
        "Autopause",
        "File2",
        "Queue2",
    )
)
"""Channels that are no line (3.5 GCodeChannel.h); what newer firmware adds may be one."""


def channel_called(model: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    """Return the element of ``inputs`` of that name, an empty one where there is none."""
    return next((each for each in _channels(model) if each.get("name") == name), {})


def own_channel(model: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return the element of ``inputs`` that is the host's line, an empty one where none is.

    ``state.thisInput`` says so from 3.4 on, but not where a single-board computer answers. Then it
    is the one that shows the host's lines: the highest line number, among those of the USB first.
    """
    inputs = array(model.get("inputs"))
    number = mapping(model.get("state")).get("thisInput")
    if type(number) is int and 0 <= number < len(inputs):
        told = mapping(inputs[number])
        name = told.get("name")
        if isinstance(name, str) and name not in NO_LINES:
            return told
    for begin in LINES:
        found = [each for each in _channels(model) if str(each.get("name")).startswith(begin)]
        if found:
            return max(found, key=_line_number)
    return {}


def _channels(model: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    return [mapping(channel) for channel in array(model.get("inputs"))]


def _line_number(channel: Mapping[str, Any]) -> float:
    number: Any = channel.get("lineNumber")
    return number if type(number) is int else 0
