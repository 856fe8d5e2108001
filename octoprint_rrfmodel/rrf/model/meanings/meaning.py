"""What a row of the tables is, and how their texts are marked for translation."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

Table = tuple[tuple[str, tuple[tuple[str, str, str], ...]], ...]
"""Path of an object, and rows of its members: names, unit, text."""


class Meaning(NamedTuple):
    """What a value says."""

    unit: str
    """As people write it; empty where there is none."""
    text: str
    """In English; catalogues have it in other languages."""


def N_(text: str) -> str:  # noqa: N802
    """Return the text, which the extraction of messages finds by this name."""
    return text


def read(tables: Iterable[Table]) -> dict[str, Meaning]:
    """Return the mapping from path pattern (``heat.heaters[].current``) to meaning."""
    return {
        f"{parent}.{name}" if parent else name: Meaning(unit, text)
        for table in tables
        for parent, rows in table
        for names, unit, text in rows
        for name in names.split()
    }
