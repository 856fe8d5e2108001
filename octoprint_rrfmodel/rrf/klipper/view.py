"""One moment seen by the objects, and what a row of their table is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, Callable, NamedTuple

from .kept import accumulated
from .printer import Printer
from .world import Accumulated, Job, World

ABSENT: Any = object()
"""What a field gives that this machine has not: left out of all fields, ``None`` when asked for."""


class View(Printer):
    """A world, with the answers that more than one field needs; computed when first asked."""

    def __init__(self, world: World, rows: Sequence[Row] = ()) -> None:
        super().__init__(world.model)
        self.host = world.host
        self.eventtime = world.eventtime
        self._kept = world.kept
        self._rows = rows

    @cached_property
    def kept(self) -> Accumulated:
        """What was accumulated, this moment included."""
        return accumulated(self._kept, self, self.host, self.eventtime)

    @property
    def job(self) -> Job:
        """The print under way or the last one."""
        return self.kept.job

    @cached_property
    def objects(self) -> dict[str, tuple[Row, Any]]:
        """Every object served: its row, and the thing that it is about."""
        found: dict[str, tuple[Row, Any]] = {}
        for row in self._rows:
            for name, thing in row.things(self).items():
                found.setdefault(name, (row, thing))
        return found


Field = Callable[[Any, Any], Any]
"""The value of one field, from the view and the thing that the object is about."""


def _no_settings(view: View, thing: Any) -> Mapping[str, Any]:
    return {}


class Row(NamedTuple):
    """One kind of object; adding one is adding a row."""

    name: str
    """As Klipper's documents call it; ``X`` stands for a name of the machine's."""
    things: Callable[[View], Mapping[str, Any]]
    """The objects there are, by full name, each with what it is about."""
    fields: Mapping[str, Field]
    members: Callable[[Any], Mapping[str, Any]] = lambda thing: {}
    """Further fields with names of the machine's own."""
    settings: Callable[[View, Any], Mapping[str, Any]] = _no_settings
    """The options of its section in ``configfile``; what is ``None`` is left out."""

    @property
    def family(self) -> str:
        """What the names of its objects begin with."""
        return family(self.name)


def family(name: str) -> str:
    """Return the kind that the name of an object begins with.

    >>> family("temperature_sensor mcu_0"), family("extruder1")
    ('temperature_sensor', 'extruder')
    """
    return name.partition(" ")[0].rstrip("0123456789")


def one(name: str) -> Callable[[View], Mapping[str, Any]]:
    """Return for ``Row.things`` that there is always one object, about nothing in particular."""
    return lambda view: {name: None}


def where(name: str, thing: Callable[[View], Any]) -> Callable[[View], Mapping[str, Any]]:
    """Return for ``Row.things`` that there is one object where ``thing`` gives anything."""

    def things(view: View) -> Mapping[str, Any]:
        found = thing(view)
        return {name: found} if found else {}

    return things


def each(
    kind: str, things: Callable[[View], Mapping[str, Any]]
) -> Callable[[View], Mapping[str, Any]]:
    """Return for ``Row.things`` that there is an object ``kind X`` for each thing named X."""
    return lambda view: {f"{kind} {name}": thing for name, thing in things(view).items()}
