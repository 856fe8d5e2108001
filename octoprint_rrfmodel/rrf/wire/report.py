"""The firmware's report of temperatures: M105's reply, and lines while a command waits."""

from __future__ import annotations

import re
from typing import NamedTuple

_PAIRS = r"-?\d+(?:\.\d+)? ?/-?\d+(?:\.\d+)?"

_ENTRY = re.compile(rf"(?<![^\s])(?P<kind>[TBC])(?P<number>\d*):(?P<pairs>{_PAIRS}(?: +{_PAIRS})*)")
"""One entry; ``pairs`` has a current value and a target for each heater (3.5 GCodes.cpp:4811)."""


class Entry(NamedTuple):
    """What a report has of a tool, a bed or a chamber."""

    kind: str
    """``T``, ``B`` or ``C``."""
    number: int
    """Of the tool or the slot; a report has none for the first slot."""
    pairs: tuple[tuple[float, float], ...]
    """Current value and target of each of its heaters."""


def is_report(line: str) -> bool:
    """Return whether a line may be a report that has come by itself; costs next to nothing.

    >>> is_report("T0:21.3 /0.0 B:60.0 /60.0"), is_report("Begin file list")
    (True, False)
    """
    return line[:1] in "TBC" and (line[1:2].isdigit() or line[1:2] == ":")


def entries(line: str) -> list[Entry]:
    """Return what a report tells, without the entry of the current tool, which is there twice.

    >>> entries("ok T:21.3 /0.0 T1:21.3 /0.0")
    [Entry(kind='T', number=1, pairs=((21.3, 0.0),))]
    """
    found = []
    for entry in _ENTRY.finditer(line):
        if entry["kind"] == "T" and not entry["number"]:
            continue
        numbers = [float(text) for text in entry["pairs"].replace("/", " ").split()]
        pairs = tuple(zip(numbers[::2], numbers[1::2]))
        found.append(Entry(entry["kind"], int(entry["number"] or 0), pairs))
    return found
