"""Heaters that are to be off: the lines for all of a kind, and what says that a kind is meant."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Literal, NamedTuple

from ..views.machine import Machine, array, mapping
from ..wire.gcode_words import words
from .forms import Slots, slot_off_line, tool_off_line

ROW = "heaters_off"
"""As the setting for what a host's script doesn't know is called."""

Kind = Literal["tool", "bed", "chamber"]

KINDS: tuple[Kind, ...] = ("tool", "bed", "chamber")

_OF_COMMAND: Mapping[str, Kind] = {
    "G10": "tool",
    "M104": "tool",
    "M109": "tool",
    "M568": "tool",
    "M140": "bed",
    "M190": "bed",
    "M141": "chamber",
    "M191": "chamber",
}

_SLOTS: Mapping[Kind, tuple[Slots, str]] = {
    "bed": ("bed", "bedHeaters"),
    "chamber": ("chamber", "chamberHeaters"),
}
"""What has slots to how a line and how the model call them."""


class Off(NamedTuple):
    """What switches one part of the machine off."""

    kind: Kind
    number: int
    """Of the tool, or of the slot."""
    line: str
    is_on: bool
    """Whether the model says that it heats, or would."""


def switched_off(command: str, gcode: str | None) -> Kind | None:
    """Return the kind of heater that a command gives no temperature, ``None`` for other commands.

    >>> switched_off("M104 T1 S0", "M104"), switched_off("M140 S60", "M140")
    ('tool', None)
    """
    kind = _OF_COMMAND.get(gcode or "")
    if kind is None:
        return None
    given = words(command)
    if gcode == "M568" and given.get("A") == 0:
        return kind
    target = given.get("S")
    is_temperature = gcode != "G10" or "P" in given
    return kind if is_temperature and target is not None and target <= 0 else None


def all_off(machine: Machine, kinds: tuple[Kind, ...] = KINDS) -> list[Off]:
    """Return what switches off all that the machine has of some kinds, and each heater once.

    Also where the model says that it is off: it may be behind.
    """
    return [off for kind in kinds for off in _FIND[kind](machine, kind)]


def _tools(machine: Machine, kind: Kind) -> Iterator[Off]:
    seen: set[Any] = set()
    for number, tool in sorted(machine.tools.items()):
        heaters = [index for index in array(tool.get("heaters")) if isinstance(index, int)]
        if heaters and not seen.issuperset(heaters):
            seen.update(heaters)
            is_on = any(_heats(machine, index) for index in heaters)
            yield Off(kind, number, tool_off_line(machine, tool), is_on)


def _slots(machine: Machine, kind: Kind) -> Iterator[Off]:
    name, member = _SLOTS[kind]
    for slot, heater in enumerate(array(mapping(machine.model.get("heat")).get(member))):
        if isinstance(heater, int) and heater >= 0:
            yield Off(kind, slot, slot_off_line(machine, name, slot), _heats(machine, heater))


_FIND = {"tool": _tools, "bed": _slots, "chamber": _slots}


def _heats(machine: Machine, index: int) -> bool:
    heater = machine.heater(index)
    state = heater.get("state")
    target = heater.get(state) if state in ("active", "standby") else None
    return isinstance(target, (int, float)) and target > 0
