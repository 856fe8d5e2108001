"""Parameters that name a thing of the machine: read against what the model says there is.

Where the model says nothing, as about some things on firmware without ``M409``, any number that
a firmware could have passes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Callable

from ...views.machine import Machine, array, mapping
from ...wire.gcode_words import number as as_text
from .outcome import bad
from .parameters import Read, listed, number, number_or, shown, whole_number, within

MOST = 50
"""No firmware has more tools, fans or heaters (3.5 Configuration.h)."""

LETTERS = "XYZUVWABCD"
"""Axes that a machine may have whose firmware doesn't tell which they are."""

MOST_TRAVEL = 10_000.0
"""Millimetres; more is a mistake."""

COLDEST, HOTTEST = -273.0, 2000.0
"""Limits of a heater that tells none; at and below the first one it is switched off, the second
one is what a broken sensor reads (3.5 Tool.cpp:788)."""

Numbers = Callable[[Machine], "Sequence[int] | None"]
"""The numbers that there are, ``None`` where nobody knows."""


def _one_of(thing: str, numbers: Numbers, least: int = 0) -> Read:
    """Return the reader of the number of a thing; ``least`` -1 allows to name none of them."""

    def read(name: str, value: Any, machine: Machine) -> int:
        whole = whole_number(name, value, machine)
        known = numbers(machine)
        if whole == least == -1:
            return whole
        if known is None:
            return int(within(name, whole, least, MOST - 1))
        if whole not in known:
            raise bad(f"no_such_{thing}", value=shown(whole), known=listed(known))
        return whole

    return read


def _there(*path: str) -> Numbers:
    """Return the places of a list of the model that hold something."""

    def numbers(machine: Machine) -> Sequence[int] | None:
        place: Any = machine.model
        for step in path:
            place = mapping(place).get(step)
        if not isinstance(place, list):
            return None
        return [number for number, item in enumerate(place) if isinstance(item, Mapping)]

    return numbers


def _spindles(machine: Machine) -> Sequence[int] | None:
    spindles = machine.model.get("spindles")
    if not isinstance(spindles, list):
        return None
    # without M409 only those that are there are told, without a state
    return [
        number
        for number, spindle in enumerate(spindles)
        if isinstance(spindle, Mapping) and spindle.get("state") != "unconfigured"
    ]


def _boards(machine: Machine) -> Sequence[int] | None:
    """Return CAN addresses; the main board is 0 wherever it lies."""
    boards = machine.model.get("boards")
    if not isinstance(boards, list):
        return None
    addresses = [mapping(board).get("canAddress") for board in boards[1:]]
    return [0, *(address for address in addresses if isinstance(address, int))]


def _tools(machine: Machine) -> Sequence[int] | None:
    return sorted(machine.tools) if machine.knows_tools else None


def _slots(kind: str) -> Numbers:
    def numbers(machine: Machine) -> Sequence[int] | None:
        slots = mapping(machine.model.get("heat")).get(kind)
        if not isinstance(slots, list):
            return None
        return [
            slot for slot, heater in enumerate(slots) if isinstance(heater, int) and heater >= 0
        ]

    return numbers


tool = _one_of("tool", _tools)
tool_or_none = _one_of("tool", _tools, least=-1)
heater = _one_of("heater", _there("heat", "heaters"))
fan = _one_of("fan", _there("fans"))
extruder = _one_of("extruder", _there("move", "extruders"))
spindle = _one_of("spindle", _spindles)
probe = _one_of("probe", _there("sensors", "probes"))
output = _one_of("output", _there("state", "gpOut"))
led_strip = _one_of("strip", _there("ledStrips"))
board = _one_of("board", _boards)
bed = _one_of("bed", _slots("bedHeaters"))
chamber = _one_of("chamber", _slots("chamberHeaters"))


def heater_of_slot(machine: Machine, kind: str, slot: int) -> int:
    """Return the number of the heater in a slot, -1 where nobody knows."""
    slots = array(mapping(machine.model.get("heat")).get(kind))
    return slots[slot] if slot < len(slots) and isinstance(slots[slot], int) else -1


def temperature(name: str, value: float, machine: Machine, index: Any) -> float:
    """Return a temperature that a heater may be set to.

    The firmware takes what lies between its limits, not the limits themselves (3.5 Tool.cpp:812).
    """
    known = machine.heater(index)
    # before M409 there is one limit for all
    limit = mapping(machine.model.get("m408")).get("tempLimit")
    low = max(number_or(known.get("min"), COLDEST), COLDEST)
    high = number_or(known.get("max"), number_or(limit, HOTTEST))
    if not low < value < high:
        raise bad("temperature", parameter=name, low=as_text(low), high=as_text(high))
    return value


def axes_of(machine: Machine) -> dict[str, Mapping[str, Any]] | None:
    """Return the axes by their letters; ``A`` and ``a`` are two. ``None`` where none is known."""
    known = map(mapping, array(mapping(machine.model.get("move")).get("axes")))
    axes = {axis["letter"]: axis for axis in known if _is_letter(axis.get("letter"))}
    return axes or None


def _is_letter(value: Any) -> bool:
    return isinstance(value, str) and len(value) == 1 and value.isascii() and value.isalpha()


def axis(name: str, value: Any, machine: Machine) -> str:
    """Return the letter of an axis."""
    known = axes_of(machine)
    letters = list(LETTERS if known is None else known)
    if not isinstance(value, str) or value not in letters:
        raise bad("no_such_axis", value=shown(value), known=listed(letters))
    return value


def axes(name: str, value: Any, machine: Machine) -> tuple[str, ...]:
    """Return the letters of several axes, each once."""
    if not isinstance(value, (str, list, tuple)):
        raise bad("not_letters", parameter=name)
    return tuple(dict.fromkeys(axis(name, letter, machine) for letter in value))


def moves(name: str, value: Any, machine: Machine) -> dict[str, float]:
    """Return a distance or a place for each axis, in mm."""
    if not isinstance(value, Mapping) or not value:
        raise bad("not_moves", parameter=name)
    one = number(-MOST_TRAVEL, MOST_TRAVEL)
    return {
        axis(name, letter, machine): one(name, place, machine) for letter, place in value.items()
    }
