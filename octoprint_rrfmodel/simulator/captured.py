"""A captured object model as the model of a board."""

from __future__ import annotations

import copy
import json
import os
from typing import Any, Dict, Mapping, Tuple, Union

from .build import full_model
from .firmware import VERSIONS, firmware_called
from .machines import machine_called

RESULT = "result"
_DEFAULTS_OF = ("state", "move", "job", "heat", "seqs", "sensors")
"""Objects in which what the capture lacks is supplied."""


class UnreadableModel(ValueError):
    """The file holds no object model; the text says why."""


def _bare(value: Any) -> Any:
    """Return the model out of its M409 envelope, if it is in one."""
    if isinstance(value, Mapping) and isinstance(value.get(RESULT), Mapping):
        return value[RESULT]
    return value


def model_in(text: str) -> Dict[str, Any]:
    """Return the model in a text: JSON, plain or in an envelope, or JSON lines, then the first."""
    try:
        value = json.loads(text)
    except ValueError as problem:
        first = text.lstrip().partition("\n")[0]
        try:
            value = json.loads(first)
        except ValueError:
            raise UnreadableModel(f"no JSON: {problem}") from None
    value = _bare(value)
    if not isinstance(value, Mapping) or not isinstance(value.get("state"), Mapping):
        raise UnreadableModel("no object model: there is no member 'state'")
    return dict(value)


def load(path: Union[str, os.PathLike]) -> Dict[str, Any]:
    """Return the model in a file."""
    try:
        with open(path, encoding="utf-8") as file:
            return model_in(file.read())
    except (OSError, UnicodeDecodeError) as problem:
        raise UnreadableModel(f"cannot read {os.fspath(path)}: {problem}") from None


def firmware_of(model: Mapping[str, Any]) -> str:
    """Return the name of the newest known firmware that isn't newer than the captured one."""
    boards = model.get("boards") or [{}]
    version = str((boards[0] or {}).get("firmwareVersion") or "")
    digits = [int(part) for part in version.split("-")[0].split(".") if part.isdigit()]
    release = tuple(digits) or (3, 5, 3)
    fitting = [
        name
        for name, firmware in VERSIONS.items()
        if firmware.has_model and firmware.release[: len(release)] <= release
    ]
    return fitting[-1] if fitting else "3.3"


def completed(model: Mapping[str, Any], firmware: str) -> Dict[str, Any]:
    """Return the model with everything supplied that a host's polling needs."""
    usual = full_model(machine_called("cartesian"), firmware_called(firmware))
    whole = copy.deepcopy(dict(model))
    for key, value in usual.items():
        if whole.get(key) is None:
            whole[key] = [] if isinstance(value, list) else {}
        if key in _DEFAULTS_OF:
            for name, member in value.items():
                if name not in whole[key]:
                    empty = [] if isinstance(member, list) else member
                    whole[key][name] = empty if key != "seqs" else member
    if not whole["inputs"]:
        whole["inputs"] = usual["inputs"]
    return whole


def names_of(model: Mapping[str, Any]) -> Tuple[str, str]:
    """Return firmware name and board name for M115, empty where the capture has none."""
    board = (model.get("boards") or [{}])[0] or {}
    return str(board.get("firmwareName") or ""), str(board.get("name") or "")
