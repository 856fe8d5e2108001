"""Lines that answer the message box."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Callable

from ...views.machine import Machine, array, mapping
from ...views.told_box import is_told
from ...wire.gcode_words import number, quoted
from .outcome import Request, bad, forbidden
from .parameters import HUGE, is_number, number_or, sendable, whole_number, within

VALUES_SINCE = (3, 5)
"""From here on M292 takes the number of a box and a value (3.5 GCodes7.cpp)."""

LARGEST_INTEGER = 2**31 - 1

NAME = "value"

Box = Mapping[str, Any]


def _limits(box: Box, low: float, high: float) -> tuple[float, float]:
    """Return the limits of a box's value, where it has none those given."""
    return number_or(box.get("min"), low), number_or(box.get("max"), high)


def _choice(value: Any, box: Box, machine: Machine) -> str:
    index = whole_number(NAME, value, machine)
    count = len(array(box.get("choices"))) or LARGEST_INTEGER
    within(NAME, index, 0, count - 1)
    return str(index)


def _integer(value: Any, box: Box, machine: Machine) -> str:
    whole = whole_number(NAME, value, machine)
    within(NAME, whole, *_limits(box, -LARGEST_INTEGER, LARGEST_INTEGER))
    within(NAME, whole, -LARGEST_INTEGER, LARGEST_INTEGER)
    return str(whole)


def _decimal(value: Any, box: Box, machine: Machine) -> str:
    if not is_number(value):
        raise bad("not_a_number", parameter=NAME)
    return number(within(NAME, within(NAME, value, *_limits(box, -HUGE, HUGE)), -HUGE, HUGE))


def _text(value: Any, box: Box, machine: Machine) -> str:
    text = sendable(NAME, value)
    least, most = _limits(box, 0, HUGE)
    if not least <= len(text) <= most:
        raise bad("box_length", parameter=NAME, low=number(least), high=number(most))
    return quoted(text)


VALUES: Mapping[int, Callable[[Any, Box, Machine], str]] = {
    4: _choice,
    5: _integer,
    6: _decimal,
    7: _text,
}
"""Mode of a box that wants a value to what is made of it (3.5 GCodes7.cpp)."""

WITH_CANCEL = 3
"""The mode that always has a button to cancel."""


def read_value(name: str, value: Any, machine: Machine) -> Any:
    """Return a number or a text; what more it has to be depends on the box."""
    if isinstance(value, str):
        return sendable(name, value)
    if not is_number(value):
        raise bad("neither", parameter=name)
    if isinstance(value, float):
        within(name, value, -HUGE, HUGE)
    return value


def message_box_of(model: Mapping[str, Any]) -> Box:
    """Return the box that the model shows, empty where it shows none."""
    return mapping(mapping(model.get("state")).get("messageBox"))


def identity_of_box(model: Mapping[str, Any]) -> tuple[Any, ...]:
    """Return what tells the box that the model shows from others; its time runs."""
    return tuple(map(message_box_of(model).get, ("seq", "mode", "title", "message")))


def message_box(request: Request) -> Sequence[str]:
    """M292; P1 cancels, S names the box that is meant, R is the value."""
    machine, values = request.machine, request.values
    if not request.situation.answers_boxes:
        raise forbidden("unanswerable")
    if request.situation.box_is_answered:
        raise forbidden("box_answered")
    box = message_box_of(machine.model)
    mode = box.get("mode")
    if not isinstance(mode, int) or mode < 0:
        raise forbidden("no_box")
    if values["seq"] not in (None, box.get("seq")):
        raise forbidden("other_box", seq=str(box.get("seq")))
    cancels = values["action"] == "cancel"
    if cancels and mode != WITH_CANCEL and box.get("cancelButton") is not True:
        raise bad("not_cancellable")
    words = ["M292", "P1" if cancels else "P0"]
    value = values[NAME]
    wants_value = mode in VALUES and not cancels
    if wants_value and value is None:
        raise bad("box_wants_value")
    if value is not None and not wants_value:
        raise bad("box_takes_no_value")
    if wants_value:
        words.append(f"R{{{VALUES[mode](value, box, machine)}}}")
    seq = box.get("seq")
    if machine.version >= VALUES_SINCE and isinstance(seq, int) and not is_told(seq):
        words.append(f"S{seq}")
    return [" ".join(words)]
