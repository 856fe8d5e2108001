"""Things by the names that printer objects have, as numbers of the machine's."""

from __future__ import annotations

from typing import Any

from ..gcode.commands.outcome import unknown
from ..gcode.commands.parameters import listed, shown
from ..views.machine import array, mapping
from .steps import At


def thing_of(at: At, wanted: str, *families: str) -> tuple[str, Any]:
    """Return the full name and the thing of an object, by that name or by what is behind its kind.

    Refused where there is none.
    """
    found = _found(at, wanted, families)
    if found is None:
        names = [name for name in at.view.objects if _family(name) in families]
        raise unknown("no_such_object_name", value=shown(wanted), known=listed(names))
    return found


def _found(at: At, wanted: str, families: tuple[str, ...]) -> tuple[str, Any] | None:
    asked = wanted.strip().lower()
    for name, (_, thing) in at.view.objects.items():
        if _family(name) not in families:
            continue
        if asked in (name.lower(), name.partition(" ")[2].lower()):
            return name, thing
    return None


def _family(name: str) -> str:
    return name.partition(" ")[0].rstrip("0123456789")


def number_of(thing: Any, *path: str, at: At) -> int:
    """Return the place of a thing in a list of the model."""
    place: Any = at.view.model
    for step in path:
        place = mapping(place).get(step)
    return next(index for index, item in enumerate(array(place)) if item is thing)


def extruder_number(at: At, wanted: str) -> int:
    """Return the number of the tool that an extruder stands for."""
    _, extruder = thing_of(at, wanted, "extruder")
    return int(extruder.tool["number"])
