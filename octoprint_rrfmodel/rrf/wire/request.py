"""What can be asked of a board, as the line that asks it."""

from __future__ import annotations

from typing import NamedTuple, Union

from .gcode_words import quoted
from .line import (
    CONFIG_REPLY,
    FILE_REPLY,
    LIST_REPLY,
    MODEL_REPLY,
    NO_FILE_REPLY,
    OLD_FILE_REPLY,
    STATUS_REPLY,
    THUMBNAIL_REPLY,
)

MODEL_BEGINS = (MODEL_REPLY, STATUS_REPLY, CONFIG_REPLY)
"""How an answer about the model begins; a late one may be of the other protocol."""

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
    """One ``M409``. Every request has ``begins``: how its answers may begin."""

    key: str
    flags: str

    @property
    def line(self) -> str:
        """The G-code, with the firmware's way of quoting: ``""`` for a quote, ``''`` for ``'``."""
        return f"M409 K{quoted(self.key)} F{quoted(self.flags)}"

    @property
    def begins(self) -> tuple[str, ...]:
        """How its answers begin."""
        return MODEL_BEGINS


class StatusRequest(NamedTuple):
    """One ``M408``; ``form`` is its S parameter, 0 to 5."""

    form: int

    @property
    def line(self) -> str:
        """The G-code."""
        return f"M408 S{self.form}"

    @property
    def begins(self) -> tuple[str, ...]:
        """How its answers begin."""
        return MODEL_BEGINS


class ListRequest(NamedTuple):
    """One ``M20 S3``: a folder's entries from number ``first`` on."""

    folder: str
    first: int = 0

    @property
    def line(self) -> str:
        """The G-code."""
        return f"M20 S3 P{quoted(self.folder)} R{self.first}"

    @property
    def begins(self) -> tuple[str, ...]:
        """How its answers begin."""
        return (LIST_REPLY,)


class FileRequest(NamedTuple):
    """One ``M36``: what the board has read from a file that can be printed."""

    path: str

    @property
    def line(self) -> str:
        """The G-code."""
        return f"M36 {quoted(self.path)}"

    @property
    def begins(self) -> tuple[str, ...]:
        """How its answers begin."""
        return (FILE_REPLY, NO_FILE_REPLY)


class JobFileRequest(NamedTuple):
    """``M36`` without a name: the file being printed, of which ``M408`` tells nothing."""

    @property
    def line(self) -> str:
        """The G-code."""
        return "M36"

    @property
    def begins(self) -> tuple[str, ...]:
        """How its answers begin."""
        return (OLD_FILE_REPLY, FILE_REPLY, NO_FILE_REPLY)


class PieceRequest(NamedTuple):
    """One ``M36.1``: a piece of a thumbnail, from a place in the file on."""

    path: str
    offset: int

    @property
    def line(self) -> str:
        """The G-code."""
        return f"M36.1 P{quoted(self.path)} S{self.offset}"

    @property
    def begins(self) -> tuple[str, ...]:
        """How its answers begin."""
        return (THUMBNAIL_REPLY,)


Request = Union[ModelRequest, StatusRequest, JobFileRequest]
"""What the model is followed by."""
