"""One part of the model that is asked for by itself."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..views.machine import Machine
from ..wire.request import ModelRequest
from .freshness import BOX, CHANGED, LIVE, freshness_of, is_guarded
from .live import LIVE_KEYS
from .parts import MOST_BYTES, length_of, parts_of, told

LIVE_FLAGS = "fin"
CHANGED_FLAGS = "vnoa0"
"""Without a depth: below a key everything is told. Without ``a`` only nine axes would be."""

TELLS_BOXES = (3, 4, 0)
"""The firmware from which on live values tell of a message box."""


class Row:
    """A part of the model, and when it was asked for."""

    def __init__(self, path: str, flags: str, is_guarded: bool = False) -> None:
        self.path = path
        self.flags = flags
        self.is_guarded = is_guarded
        self.is_changed = flags == CHANGED_FLAGS and not is_guarded
        """Whether it is asked for once after a change, and not again and again."""
        self.aims = freshness_of(path, CHANGED if self.is_changed else LIVE)
        self.tried_at: float | None = None
        self.changed_at: float | None = None

    @property
    def request(self) -> ModelRequest:
        """What asks for it."""
        return ModelRequest(self.path, self.flags)


def live_rows(model: Mapping[str, Any]) -> list[Row]:
    """Return the parts of what changes all the time."""
    paths = [path for key in LIVE_KEYS for path in parts_of(key, LIVE_FLAGS, model)]
    rows = [Row(path, LIVE_FLAGS, is_guarded(path)) for path in paths]
    if Machine(model).version < TELLS_BOXES:
        rows.append(Row(BOX, CHANGED_FLAGS, True))
    return rows


def is_short(path: str, model: Mapping[str, Any]) -> bool:
    """Return whether the answer with what has changed is short."""
    value = told(path, CHANGED_FLAGS, model)
    return length_of(path, CHANGED_FLAGS, value) <= MOST_BYTES
