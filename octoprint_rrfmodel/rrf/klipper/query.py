"""Which objects there are, what is asked of them, and what has changed since."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from . import config, fans, heat, host, job, motion, sensors
from .values import finite
from .view import ABSENT, Row, View, family
from .world import World

OBJECTS: tuple[Row, ...] = (
    *host.ROWS,
    *config.ROWS,
    *motion.ROWS,
    *job.ROWS,
    *heat.ROWS,
    *fans.ROWS,
    *sensors.ROWS,
)
"""Every kind of object. Adding one is adding a row to the table of its module."""

_FAMILIES: dict[str, list[Row]] = {}
for _row in OBJECTS:
    _FAMILIES.setdefault(_row.family, []).append(_row)

MOST_OBJECTS = 500
MOST_FIELDS = 3000
"""What may be asked for at once: several times what a machine has, each thing counted once."""

_NAMES = re.compile(r"\w+")

Wanted = Mapping[str, "Sequence[str] | None"]
"""Objects and the fields wanted of each; ``None`` and an empty one are all of them."""


def seen(world: World) -> View:
    """Return the view of a world with all objects."""
    return View(world, OBJECTS)


def names(world: World) -> list[str]:
    """Return the names of the objects that the machine has, as ``objects/list`` gives them."""
    return list(seen(world).objects)


def status(world: World, wanted: Wanted) -> dict[str, dict[str, Any]]:
    """Return the fields wanted of each object, whatever the model holds.

    An object that isn't there is ``{}``, a field that isn't ``None``. Every value is one that JSON
    has. Only what is wanted is computed.
    """
    return Moment(world).status(wanted)


class Moment:
    """One world that many look at: what several want is computed and compared once."""

    def __init__(self, world: World) -> None:
        self._view = seen(world)
        self._things: dict[str, Mapping[str, Any]] = {}
        self._values: dict[tuple[str, tuple[str, ...] | None], dict[str, Any]] = {}
        # the objects are kept beside what differs, so that no other has their identities
        self._differences: dict[tuple[int, int], tuple[Any, Any, dict[str, Any]]] = {}

    def status(self, wanted: Wanted) -> dict[str, dict[str, Any]]:
        """Return what ``status`` does; who wants the same of an object gets the same one."""
        return {name: self._object(name, fields) for name, fields in wanted.items()}

    def difference(
        self, last: Mapping[str, Mapping[str, Any]], now: Mapping[str, Mapping[str, Any]]
    ) -> dict[str, dict[str, Any]]:
        """Return the fields of ``now`` that are other than in ``last``, each as a whole.

        A field that is gone is ``None``. Objects without changes are left out.
        """
        found = {name: self._changed(last.get(name, {}), fields) for name, fields in now.items()}
        return {name: changed for name, changed in found.items() if changed}

    def _object(self, name: str, fields: Sequence[str] | None) -> dict[str, Any]:
        key = name, tuple(fields) if fields else None
        if key not in self._values:
            row, thing = self._found(name)
            self._values[key] = {} if row is None else _values(self._view, row, thing, fields)
        return self._values[key]

    def _changed(self, before: Mapping[str, Any], now: Mapping[str, Any]) -> dict[str, Any]:
        key = id(before), id(now)
        if key not in self._differences:
            self._differences[key] = before, now, _changed_fields(before, now)
        return self._differences[key][2]

    def _found(self, name: str) -> tuple[Row | None, Any]:
        for row in _FAMILIES.get(family(name), ()):
            if row.name not in self._things:
                self._things[row.name] = row.things(self._view)
            if name in self._things[row.name]:
                return row, self._things[row.name][name]
        return None, None


def _values(view: View, row: Row, thing: Any, fields: Sequence[str] | None) -> dict[str, Any]:
    members = row.members(thing)
    result = {}
    for name in fields or [*row.fields, *members]:
        field = row.fields.get(name)
        value = members.get(name) if field is None else field(view, thing)
        if value is not ABSENT:
            result[name] = finite(value)
        elif fields:
            result[name] = None
    return result


def _changed_fields(before: Mapping[str, Any], now: Mapping[str, Any]) -> dict[str, Any]:
    changed = {
        field: value
        for field, value in now.items()
        if field not in before or _differs(before[field], value)
    }
    changed.update((field, None) for field in before if field not in now)
    return changed


def _differs(old: Any, new: Any) -> bool:
    # true is not 1 in JSON
    return bool(old != new) or isinstance(old, bool) is not isinstance(new, bool)


def wanted_of(objects: Any) -> dict[str, tuple[str, ...] | None]:
    """Return what a request's ``objects`` ask for.

    Raises ``ValueError`` with a sentence for anything but names, each with null, a list of texts
    or a text with names in it, and for too many.
    """
    if not isinstance(objects, Mapping):
        raise ValueError("Objects are given by name, each with null or a list of its fields.")
    if len(objects) > MOST_OBJECTS:
        raise ValueError(f"No more than {MOST_OBJECTS} objects can be asked for at once.")
    wanted: dict[str, tuple[str, ...] | None] = {}
    count = 0
    for name, fields in objects.items():
        if not isinstance(name, str):
            raise ValueError(f"The name of an object is a text, and {name!r} is none.")
        if isinstance(fields, str):
            # OctoEverywhere sends a set as Python writes it, Obico a single name
            fields = _NAMES.findall(fields)
        if fields is not None and not _are_texts(fields):
            raise ValueError(f"The fields of {name!r} are null or a list of names.")
        # what is named twice is computed, compared and kept once
        wanted[name] = tuple(dict.fromkeys(fields)) if fields else None
        count += len(wanted[name] or ())
        if count > MOST_FIELDS:
            raise ValueError(f"No more than {MOST_FIELDS} fields can be asked for at once.")
    return wanted


def _are_texts(fields: Any) -> bool:
    return isinstance(fields, (list, tuple)) and all(isinstance(field, str) for field in fields)
