"""``M408`` replies kept together and seen as an object model.

Firmware without ``M409`` (2.x and older) tells its state in the forms S0 to S5, none of which is
whole. They are collected, and the model is built from all of them by the rows of
``m408_table``. What has no place in the object model stays readable below ``m408``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from ..model.merge import patched
from .m408_job import (
    LEGACY_OF_A_JOB,
    OF_A_JOB,
    WITHOUT_JOB,
    file_of,
    has_ended,
    is_another,
    put_job,
)
from .m408_table import CONFIG_FIELDS, LEGACY, STATUS_FIELDS, Row

_STEP = re.compile(r"([^.\[\]]+)|\[(\d*)\]")
"""One step of a path: group 1 a member, group 2 an index, empty for "each"."""

_SLICE = re.compile(r"\[(\d*):(\w*)\]$")
"""The end of a field of which only a part is taken; groups are where it starts and ends."""

_REFERENCE = re.compile(r"\{([\w.]+)\}")
"""An index that stands in another field, named in group 1."""

_ABSENT = object()

_NONSENSE = (TypeError, ValueError, LookupError, ArithmeticError, AttributeError)
"""What a row's ``convert`` may raise."""

MOST_HEATERS = 64
"""A heater's number from here on is a spoilt one; no firmware has as many."""


class M408Model:
    """Collects the forms that come and gives the model they make."""

    def __init__(self) -> None:
        self._legacy: dict[str, Any] = {}
        self._status: dict[str, Any] = {}
        self._config: dict[str, Any] = {}
        self._file: dict[str, Any] = {}
        self._before = self._forms()

    def _forms(self) -> tuple[dict[str, Any], ...]:
        return self._legacy, self._status, self._config, self._file

    def undo(self) -> None:
        """Forget the last reply: it doesn't count."""
        self._legacy, self._status, self._config, self._file = self._before

    def take(self, fields: dict[str, Any]) -> dict[str, Any]:
        """Keep a reply of whatever form and return the whole model, by top-level key."""
        self._before = self._forms()
        if "heaters" in fields:
            if has_ended(fields):
                self._legacy = _without_job(self._legacy)
                # what a form tells that isn't asked again is no witness
                self._file = self._file if self._status else {}
            self._legacy = patched(self._legacy, fields)[0]
            if fields.get("msgBox.mode") == -1:
                self._legacy = _without_box(self._legacy)
        elif "status" in fields:
            # a box, a beep and a message are only there while they last
            gone = {"output"} if fields["status"] not in WITHOUT_JOB else {"output", *OF_A_JOB}
            lasting = {name: value for name, value in self._status.items() if name not in gone}
            if is_another(self._status, fields):
                self._file = {}
            self._status = patched(lasting, fields)[0]
            self._legacy = _without_job(_without_box(self._legacy))
        else:
            self._config = patched(self._config, fields)[0]
        return self.model()

    def take_file(self, fields: dict[str, Any]) -> dict[str, Any]:
        """Keep what ``M36`` tells of the file being printed; return the whole model."""
        self._before = self._forms()
        self._file = file_of(fields)
        return self.model()

    def model(self) -> dict[str, Any]:
        """Return the model that the replies so far make."""
        model: dict[str, Any] = {}
        names = self._status.get("axisNames") or self._config.get("axisMins")
        axes = len(names) if isinstance(names, (str, list)) else len("XYZ")
        for fields, rows in (
            (self._legacy, LEGACY),
            (self._config, CONFIG_FIELDS),
            (self._status, STATUS_FIELDS),
        ):
            if fields:
                kept = _copy(fields)
                for row in rows:
                    _place(model, fields, kept, row, axes)
                kept = _without_empty(kept)
                if kept:
                    model["m408"] = {**model.get("m408", {}), **kept}
        if self._status.get("tools") == []:
            # a row for a member of each element says nothing of a list without any
            model["tools"] = []
        if model:
            put_job(model, self._file)
            _complete(model)
        return model


def _without_box(fields: dict[str, Any]) -> dict[str, Any]:
    """Return the members of S0 without those of a message box."""
    return {name: value for name, value in fields.items() if not name.startswith("msgBox.")}


def _without_job(fields: dict[str, Any]) -> dict[str, Any]:
    """Return the members of S0 without those of a job."""
    return {name: value for name, value in fields.items() if name not in LEGACY_OF_A_JOB}


def _place(
    model: dict[str, Any], fields: dict[str, Any], kept: dict[str, Any], row: Row, axes: int
) -> None:
    """Write one field's value where its row says; a value that makes no sense stays kept."""
    if row.path is None:
        return
    path = row.path
    for reference in _REFERENCE.findall(path):
        index = _at(fields, reference)
        if type(index) is not int or not 0 <= index < MOST_HEATERS:
            return
        path = path.replace(f"{{{reference}}}", str(index))
    field, part = row.field, slice(None)
    if sliced := _SLICE.search(field):
        start, end = sliced.groups()
        part = slice(int(start or 0), axes if end else None)
        field = field[: sliced.start()] + "[]"
    found = False
    for indexes, value in _values(fields, field, part):
        try:
            value = row.convert(value)
        except _NONSENSE:
            continue
        found = True
        if value is not None or "[]" not in path:
            _write(model, _steps(path, indexes), value)
    if found and part == slice(None):
        _drop(kept, field)


def _values(fields: Any, field: str, part: slice = slice(None)) -> Iterator[tuple[list[int], Any]]:
    """Yield each value that a field stands for, with the indexes that lead to it."""
    if field in fields:  # S0 has dots in its names
        yield [], fields[field]
        return
    head, each, rest = field.partition("[]")
    value = _at(fields, head)
    if not each:
        if value is not _ABSENT:
            yield [], value
        return
    if isinstance(value, (int, float)):
        value = [value]  # fanRPM: a number where there is one fan
    if not isinstance(value, (list, str)):
        return
    for index, item in enumerate(value[part]):
        if not rest:
            yield [index], item
        elif isinstance(item, dict) and rest[1:] in item:
            yield [index], item[rest[1:]]


def _at(fields: Any, path: str) -> Any:
    value = fields
    for name, index in _STEP.findall(path):
        if name:
            value = value.get(name, _ABSENT) if isinstance(value, dict) else _ABSENT
        elif isinstance(value, list) and int(index) < len(value):
            value = value[int(index)]
        else:
            return _ABSENT
    return value


def _steps(path: str, indexes: list[int]) -> list[str | int]:
    left = iter(indexes)
    steps: list[str | int] = []
    for name, index in _STEP.findall(path):
        steps.append(name or (int(index) if index else next(left)))
    return steps


def _write(model: Any, steps: list[str | int], value: Any) -> None:
    """Put ``value`` at a path, making the objects and arrays on the way."""
    for step, following in zip(steps, [*steps[1:], None]):
        if isinstance(step, int):
            while len(model) <= step:
                model.append(None)
        if following is None:
            model[step] = value
            return
        child = model[step] if isinstance(step, int) else model.get(step)
        if not isinstance(child, (dict, list)):
            child = [] if isinstance(following, int) else {}
            model[step] = child
        model = child


def _drop(kept: Any, field: str) -> None:
    """Take a field that has found its place out of what is kept as it came."""
    if field in kept:
        del kept[field]
        return
    head, each, rest = field.partition("[]")
    *parents, last = head.split(".")
    for name in parents:
        kept = kept.get(name, {})
        if not isinstance(kept, dict):
            return
    if rest and isinstance(kept.get(last), list):
        for item in kept[last]:
            if isinstance(item, dict):
                item.pop(rest[1:], None)
        if any(kept[last]):
            return
    kept.pop(last.partition("[")[0], None)


def _copy(fields: Any) -> Any:
    if isinstance(fields, dict):
        return {name: _copy(value) for name, value in fields.items()}
    return [_copy(item) for item in fields] if isinstance(fields, list) else fields


def _without_empty(value: Any) -> Any:
    if not isinstance(value, dict):
        return value
    pruned = {name: _without_empty(item) for name, item in value.items()}
    return {name: item for name, item in pruned.items() if item not in ({}, [])}


def _complete(model: dict[str, Any]) -> None:
    """Add what M408 says only by position: slots, tool heaters' targets, missing fans."""
    heat = model.get("heat", {})
    if "heaters" in heat:
        heat.setdefault("bedHeaters", [0])
        heat.setdefault("chamberHeaters", [])
    fans = [fan if fan and "requestedValue" in fan else None for fan in model.get("fans", [])]
    while fans and fans[-1] is None:
        fans.pop()
    if fans:
        model["fans"] = fans
    else:
        model.pop("fans", None)
    heaters = heat.get("heaters", [])
    current = model.get("state", {}).get("currentTool")
    tools = filter(None, model.get("tools", []))
    # the current tool last: a heater that several have follows it
    for tool in sorted(tools, key=lambda tool: tool.get("number") == current):
        for name in ("active", "standby"):
            for heater, target in zip(_array(tool.get("heaters")), _array(tool.get(name))):
                known = type(heater) is int and 0 <= heater < len(heaters)
                if known and heaters[heater] is not None:
                    heaters[heater][name] = target
    if "state" in model:
        model["state"].setdefault("messageBox", None)


def _array(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []
