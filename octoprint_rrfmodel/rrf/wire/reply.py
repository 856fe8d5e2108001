"""A reply's text turned into values: ``M409``, ``M408``, ``M20`` and "no buffers"."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from typing import Any, Callable, NamedTuple

from .line import MODEL_REPLY, NO_BUFFERS


class MalformedReply(ValueError):
    """A text that starts like a reply and is none; says what is wrong and where."""


class ModelReply(NamedTuple):
    """An answer to ``M409``."""

    key: str
    flags: str | None
    """As echoed; ``None`` in SBC mode, where ``network`` and ``volumes`` come without."""
    result: Any
    next: int
    """Element to go on with, 0 where the array is complete or the result is no array."""


class StatusReply(NamedTuple):
    """An answer to ``M408``: its members as they came."""

    fields: dict[str, Any]


class NoBuffers(NamedTuple):
    """The board had no room for the answer; it names no key (3.5 GCodes2.cpp:3154)."""


class FolderEntry(NamedTuple):
    """A file or a folder, as ``M20 S3`` tells it."""

    name: str
    is_folder: bool
    size: int
    date: str
    """``2024-11-04T20:21:00`` by the board's clock; empty where it tells none."""


class FolderPage(NamedTuple):
    """An answer to ``M20 S3``."""

    folder: str
    first: int
    entries: tuple[FolderEntry, ...]
    next: int
    """Entry to go on with, 0 where the folder is complete."""
    error: int
    """0, or why there are no entries: 1 no card, 2 no such folder (3.5 RepRap.cpp:1865)."""


_LITERAL = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"?|-?\b(?:nan|inf)\b')
"""A string, to its end or that of all, or a word that M408 prints for a number that is none."""

_EXPONENTS = (re.compile(r"e\+?[0-9]{3}"), re.compile(r"E\+?[0-9]{3}"))
"""Exponents that may leave the range of a float; what begins with one letter is found fastest."""

_APART = 50
_LONG_NUMBER = re.compile(r"[0-9]{6}")
"""What every fiftieth letter of 300 digits is: they may leave the range of a float, too."""


_FOREIGN = re.compile(r'"[\x00-!#-\x7f]*[^\x00-\x7f][^"]*"')
"""A string with a letter beyond ASCII: a name that somebody gave, or a broken byte."""

_FOREIGN_NAME = re.compile(r'[{,]"[\x00-!#-9;-\[\]-\x7f]*[^\x00-\x7f][^"\\:]*":')
"""A member's name with such a letter: the firmware's own names have none."""


def _finite(text: str) -> float | None:
    value = float(text)
    return value if math.isfinite(value) else None


def _no_number(_text: str) -> None:
    return None


def _may_be_huge(text: str) -> bool:
    """Return whether a number in it might be one that no float holds."""
    return bool(
        _LONG_NUMBER.search(text[::_APART]) or any(each.search(text) for each in _EXPONENTS)
    )


_DECODER = json.JSONDecoder(parse_constant=_no_number)
_CAREFUL_DECODER = json.JSONDecoder(parse_constant=_no_number, parse_float=_finite)


def scanner_of(text: str) -> Callable[[str, int], tuple[Any, int]]:
    """Return what reads one value of a text.

    ``(text, start) -> (value, end)``; it raises ``StopIteration`` or ``ValueError``.
    """
    decoder = _CAREFUL_DECODER if _may_be_huge(text) else _DECODER
    return decoder.scan_once  # type: ignore[attr-defined, no-any-return]


def decode(text: str) -> ModelReply | StatusReply | NoBuffers:
    """Return what a reply says; raise ``MalformedReply`` for a text that can't be read.

    >>> decode('{"key":"#tools","flags":"","result":2}')
    ModelReply(key='#tools', flags='', result=2, next=0)
    """
    if text == NO_BUFFERS:
        return NoBuffers()
    if not text.isascii() and _FOREIGN_NAME.search(text):
        raise MalformedReply(f"a member with a broken name: {text[:80]!r}")
    members = members_of(text)
    if not text.startswith(MODEL_REPLY):
        return StatusReply(members)
    key, flags = members.get("key"), members.get("flags")
    start = members.get("next", 0)
    if (
        type(key) is not str
        or "result" not in members
        or (flags is not None and type(flags) is not str)
        or type(start) is not int
    ):
        raise MalformedReply(f"no envelope of an M409 reply: {text[:80]!r}")
    return ModelReply(key, flags, members["result"], start)


def foreign_strings(text: str) -> tuple[str, ...]:
    """Return the strings of a reply that hold letters beyond ASCII; most replies have none."""
    return () if text.isascii() else tuple(_FOREIGN.findall(text))


def decode_page(text: str) -> FolderPage:
    """Return what an answer to ``M20 S3`` says; raise ``MalformedReply`` if it can't be read."""
    members = members_of(text)
    folder, files = members.get("dir"), members.get("files", [])
    first, following = members.get("first", 0), members.get("next", 0)
    error = members.get("err", 0)
    if (
        type(folder) is not str
        or type(files) is not list
        or not all(isinstance(file, dict) for file in files)
        or any(type(value) is not int for value in (first, following, error))
    ):
        raise MalformedReply(f"no list of a folder: {text[:80]!r}")
    return FolderPage(folder, first, tuple(_entries(files)), following, error)


def _entries(files: list[dict[str, Any]]) -> Iterator[FolderEntry]:
    for file in files:
        name = file.get("name")
        if not isinstance(name, str):
            continue
        size, date = file.get("size"), file.get("date")
        yield FolderEntry(
            name,
            file.get("type") == "d",
            size if type(size) is int else 0,
            date if isinstance(date, str) else "",
        )


def members_of(text: str) -> dict[str, Any]:
    """Return the members of a reply; raise ``MalformedReply`` for a text that is no object."""
    decoder = _CAREFUL_DECODER if _may_be_huge(text) else _DECODER
    try:
        try:
            members = decoder.decode(text)
        except ValueError:
            if "nan" not in text and "inf" not in text:
                raise
            members = decoder.decode(_LITERAL.sub(_null_for_word, text))
    except (ValueError, RecursionError) as error:
        raise MalformedReply(f"{error}: {text[:80]!r}") from None
    if type(members) is not dict:
        raise MalformedReply(f"no object: {text[:80]!r}")
    return members


def _null_for_word(match: re.Match[str]) -> str:
    return match[0] if match[0][0] == '"' else "null"
