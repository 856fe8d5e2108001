"""Commands about the machine as a whole: what is known of it, its power, its height map."""

from __future__ import annotations

import re
from collections.abc import Sequence

from ...views.machine import mapping
from .outcome import Request, forbidden, unknown
from .parameters import shown
from .states import PRINTING_OR_PAUSED, forbid

POWER_IS_CONFIGURED = (3, 4)
"""From here on M80 is an error unless a port was given to it (3.4 GCodes2.cpp, M80)."""

MESH = {"load": "G29 S1", "clear": "G29 S2", "probe": "G29", "calibrate": "G32"}
"""Action to line; without S the machine's own mesh.g runs (3.5 GCodes2.cpp:385). G32 runs bed.g,
which levels the bed or calibrates a delta."""

_ROOT = re.compile(r"[^.\[]*")
"""The top-level key that a key begins with."""


def refresh(request: Request) -> Sequence[str]:
    """No line: the model is asked for again. The key has to be one that the model has."""
    key = request.values["key"]
    model = request.machine.model
    if key and model and root_of(key) not in model:
        raise unknown("no_such_key", key=shown(key))
    return []


def root_of(key: str) -> str:
    """Return the top-level key that a key is below."""
    matched = _ROOT.match(key)
    return matched[0] if matched else ""


def recover(request: Request) -> Sequence[str]:
    """No line: the restart takes the connection down, which no line can."""
    return []


def emergency_stop(request: Request) -> Sequence[str]:
    """M112."""
    return ["M112"]


def power(request: Request) -> Sequence[str]:
    """M80 and M81."""
    machine, is_on = request.machine, request.values["on"]
    if not is_on:
        forbid(request, PRINTING_OR_PAUSED)
    state = mapping(machine.model.get("state"))
    if machine.version >= POWER_IS_CONFIGURED and state.get("atxPower", True) is None:
        raise forbidden("no_power_control")
    return ["M80" if is_on else "M81"]


def mesh(request: Request) -> Sequence[str]:
    """G29."""
    return [MESH[request.values["action"]]]
