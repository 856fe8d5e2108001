"""A captured object model as the model of a board."""

from __future__ import annotations

import copy
import dataclasses
import json
import os
import re
from collections.abc import Mapping
from typing import Any, Callable

from .firmware import VERSIONS, Firmware
from .hardware import blank, parts
from .hardware.boards import Mainboard
from .machines import machine_called
from .model.build import full_model
from .model.members import for_firmware

RESULT = "result"
AXIS_LETTERS = "XYZUVWABCD"
LATEST = "3.5.3"
OLDEST = "3.3"
_VERSION = re.compile(r"(\d+)\.(\d+)(?:\.(\d+))?")
"""A firmware version; groups: major, minor, patch."""


class UnreadableModel(ValueError):
    """The file holds no object model; the text says why."""


def _bare(value: Any) -> Any:
    """Return the model out of its M409 envelope, if it is in one."""
    if isinstance(value, Mapping) and isinstance(value.get(RESULT), Mapping):
        return value[RESULT]
    return value


def model_in(text: str) -> dict[str, Any]:
    """Return the model in a text: JSON, plain or in an envelope, or JSON lines, then the first."""
    try:
        value = json.loads(text)
    except ValueError as problem:
        first = text.lstrip().partition("\n")[0]
        try:
            value = json.loads(first)
        except ValueError:
            raise UnreadableModel(f"no JSON: {problem}") from None
    return model_of(value)


def model_of(value: Any) -> dict[str, Any]:
    """Return the model that a JSON value is, plain or in an envelope."""
    model = _bare(value)
    if not isinstance(model, Mapping) or not isinstance(model.get("state"), Mapping):
        raise UnreadableModel("no object model: there is no member 'state'")
    return dict(model)


def load(path: str | os.PathLike[str]) -> dict[str, Any]:
    """Return the model in a file."""
    try:
        with open(path, encoding="utf-8") as file:
            return model_in(file.read())
    except (OSError, UnicodeDecodeError) as problem:
        raise UnreadableModel(f"cannot read {os.fspath(path)}: {problem}") from None


def firmware_of(model: Mapping[str, Any]) -> str:
    """Return the name of the newest known firmware that isn't newer than the captured one."""
    found = _VERSION.match(_board_of(model)["firmwareVersion"])
    if found is None:
        return LATEST
    release = tuple(int(part or 0) for part in found.groups())
    fitting = [n for n, item in VERSIONS.items() if item.has_model and item.release <= release]
    # the first release of a series stands for its betas and release candidates
    series = [n for n, item in VERSIONS.items() if item.release[:2] == release[:2]]
    if series and series[0] not in fitting:
        return series[0]
    return fitting[-1] if fitting else OLDEST


def _board_of(model: Mapping[str, Any]) -> dict[str, str]:
    """Return the names of ``boards[0]``, empty where the capture has none."""
    boards = model.get("boards") or [None]
    first = boards[0] if isinstance(boards[0], Mapping) else {}
    names = ("firmwareName", "firmwareVersion", "name", "shortName", "firmwareDate")
    return {name: str(first.get(name) or "") for name in names}


def identity(
    model: Mapping[str, Any], firmware: Firmware, mainboard: Mainboard
) -> tuple[Firmware, Mainboard]:
    """Return firmware and mainboard with the names that the model gives them."""
    names = _board_of(model)
    if names["firmwareVersion"]:
        firmware = dataclasses.replace(
            firmware, version=names["firmwareVersion"], date=names["firmwareDate"], time=""
        )
    if names["firmwareName"]:
        mainboard = dataclasses.replace(
            mainboard,
            firmware_name=names["firmwareName"],
            electronics=names["name"],
            short_name=names["shortName"],
            name=names["name"],
            is_duet2="Duet 2" in names["firmwareName"],
        )
    return firmware, mainboard


def _with(value: Any, usual: Mapping[str, Any]) -> Any:
    """Return an object with the members it lacks; anything but an object stays as it is."""
    if not isinstance(value, Mapping):
        return value
    whole = {**copy.deepcopy(dict(usual)), **value}
    for name, member in value.items():
        # kinematics differ in their members by what they are
        if isinstance(member, Mapping) and isinstance(usual.get(name), Mapping):
            whole[name] = dict(member) if name == "kinematics" else _with(member, usual[name])
    return whole


def _tool(index: int) -> dict[str, Any]:
    return parts.tool(index, "", [], [], [], (), ())


def _axis(index: int) -> dict[str, Any]:
    return parts.axis(AXIS_LETTERS[index % len(AXIS_LETTERS)], [], 0.0, 200.0, 6000.0, 500.0, 80.0)


_BOARD = {
    "mcuTemp": {"current": 36.0, "max": 38.0, "min": 21.0},
    "vIn": {"current": 24.0, "max": 24.2, "min": 23.8},
}

ELEMENTS: dict[tuple[str, str], Callable[[int], Mapping[str, Any]]] = {
    ("tools", ""): _tool,
    ("fans", ""): lambda index: parts.fan(),
    ("inputs", ""): lambda index: blank.gcode_input(blank.INPUT_NAMES[index % 14]),
    ("spindles", ""): lambda index: parts.spindle(),
    ("heat", "heaters"): lambda index: parts.heater(-1, 280.0, 2.0, 0.5),
    ("move", "axes"): _axis,
    ("move", "extruders"): lambda index: parts.extruder(""),
    ("sensors", "analog"): lambda index: {"lastReading": parts.ROOM, "name": "", "type": ""},
    ("sensors", "endstops"): lambda index: parts.endstop(),
    ("sensors", "probes"): lambda index: parts.probe(),
    ("boards", ""): lambda index: copy.deepcopy(_BOARD),
}
"""Lists of objects whose missing members are supplied, and what from."""

_OBJECTS = ("state", "move", "job", "heat", "seqs", "sensors")
"""Objects whose missing members are supplied; their lists stay empty."""


def completed(model: Mapping[str, Any], firmware: Firmware) -> dict[str, Any]:
    """Return the model with everything supplied that a host's polling and the board need."""
    usual = full_model(machine_called("cartesian"), firmware)
    whole = copy.deepcopy(dict(model))
    for key, value in usual.items():
        if not isinstance(whole.get(key), type(value)):
            whole[key] = type(value)()
    for key in _OBJECTS:
        supplied = {
            name: [] if isinstance(member, list) and key != "seqs" else member
            for name, member in usual[key].items()
        }
        given = {name: value for name, value in whole[key].items() if value is not None}
        whole[key] = {**whole[key], **_with(given, supplied)}
    for (key, member), element in ELEMENTS.items():
        holder, name = (whole[key], member) if member else (whole, key)
        path = f"{key}.{member}[]" if member else f"{key}[]"
        values = holder[name] if isinstance(holder[name], list) else []
        holder[name] = [
            _with(value, for_firmware(element(index), firmware, path))
            for index, value in enumerate(values)
        ]
    if not whole["inputs"]:
        whole["inputs"] = usual["inputs"]
    for gcode_input in whole["inputs"]:
        # single-board computer software fills this in its own way, and has no USB channel
        if gcode_input is not None and gcode_input["name"] in blank.MARLIN_CHANNELS:
            gcode_input["compatibility"] = "Marlin"
    return whole
