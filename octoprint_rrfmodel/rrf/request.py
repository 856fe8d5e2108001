"""What can be asked of a board, as the line that asks it."""

from __future__ import annotations

from typing import NamedTuple, Union

from .gcode import quoted

LIVE_FLAGS = "d99fin"
"""Frequently changing values; ``i`` brings the message box from 3.4 on, ``n`` what is null now."""

KEY_FLAGS = "d99vno"
"""Everything below a key, so that what is absent is gone and what is null says so."""

OUTLINE_FLAGS = "d1vno"
"""The names of the top-level keys, each of them empty."""

KEY_LENGTH = 100
FLAGS_LENGTH = 20
"""Longest key and flags that ``M409`` takes (3.5 GCodes2.cpp:3111)."""


class ModelRequest(NamedTuple):
    """One ``M409``."""

    key: str
    flags: str

    @property
    def line(self) -> str:
        """The G-code, with the firmware's way of quoting: ``""`` for a quote, ``''`` for ``'``."""
        return f"M409 K{quoted(self.key)} F{quoted(self.flags)}"


class StatusRequest(NamedTuple):
    """One ``M408``; ``form`` is its S parameter, 0 to 5."""

    form: int

    @property
    def line(self) -> str:
        """The G-code."""
        return f"M408 S{self.form}"


class ListRequest(NamedTuple):
    """One ``M20 S3``: a folder's entries from number ``first`` on."""

    folder: str
    first: int = 0

    @property
    def line(self) -> str:
        """The G-code."""
        return f"M20 S3 P{quoted(self.folder)} R{self.first}"


Request = Union[ModelRequest, StatusRequest]
