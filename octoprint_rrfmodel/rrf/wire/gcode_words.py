"""G-code lines as the firmware reads them: words, quoting, numbers."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

_WORD = re.compile(r"([A-Za-z])\s*(-?[0-9]*\.?[0-9]+(?:e[-+][0-9]+)?)?")
"""One word of a plain command: group 1 the letter, group 2 the number, if it has one. A host in
Python writes very small numbers with ``e-``."""

_TEXT = re.compile(r'(?:(?P<letter>[A-Za-z])\s*)?"(?P<text>(?:[^"]|"")*)"')
"""A text in quotes, with the letter in front of it if there is one."""

LONGEST = 1000
"""Characters of a command that are looked at; the firmware takes 256, and refuses longer ones."""

KEEPS_MODES = "M120"
"""Keeps modes and feed rate until M121 (3.5 GCodeMachineState.cpp:41-60)."""

_KEPT = re.compile(
    r"(?P<begin>M120 (?:G21|M83)) (?:(?P<mode>G9[01]) )?(?P<move>G1 .*) (?P<end>M121)"
)
"""A line of a move that leaves all as it was, by the parts in which it goes out."""


def words(line: str) -> dict[str, float | None]:
    """Return the words of a line without quotes, by upper-case letter.

    >>> words("G0 X10 Y-5.5 F200")
    {'G': 0.0, 'X': 10.0, 'Y': -5.5, 'F': 200.0}
    """
    return {letter.upper(): _finite(number) for letter, number in _WORD.findall(line[:LONGEST])}


def _finite(number: str) -> float | None:
    """Return a number, ``None`` for none and for one with more digits than a float takes."""
    value = float(number) if number else math.inf
    return value if math.isfinite(value) else None


def number(value: float) -> str:
    """Return a number as shortly as it can be read back, never with an exponent.

    >>> number(10.0), number(0.02), number(-0.0)
    ('10', '0.02', '0')
    """
    text = f"{value:.5f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def numbers(values: Sequence[float]) -> str:
    """Return one number, or several with ``:`` between, as multi-heater tools take them."""
    return ":".join(map(number, values))


def quoted(text: str) -> str:
    """Return a text as the firmware wants its strings: in quotes, quotes and ``'`` doubled.

    An apostrophe before a letter would make it lower case (3.5 StringParser.cpp).
    """
    doubled = text.replace('"', '""').replace("'", "''")
    return f'"{doubled}"'


def jog_line(moves: Sequence[str], is_relative: bool, speed: float | None) -> str:
    """Return one line that moves the axes and leaves modes and feed rate as they were.

    ``moves`` are words, ``speed`` is in mm/min. M120 and M121 keep and restore (3.5
    GCodeMachineState.cpp:41-60).
    """
    mode = "G91" if is_relative else "G90"
    feed = f" F{number(speed)}" if speed else ""
    return f"M120 G21 {mode} G1 {' '.join(moves)}{feed} M121"


def extrude_line(amounts: Sequence[float], speed: float | None) -> str:
    """Return one line that extrudes, as ``jog_line``; several amounts are one per extruder."""
    feed = f" F{number(speed)}" if speed else ""
    return f"M120 M83 G1 E{numbers(amounts)}{feed} M121"


def apart(line: str) -> tuple[str, ...]:
    """Return a line of ``jog_line`` or ``extrude_line`` as the lines that go out, another alone.

    Who counts filament or follows positions finds among them those that a host of the Marlin kind
    sends, in order, and knows neither M120 nor M121. They take G91 for the extruder's mode too; by
    an M83 of its own line they would go on counting after the board has its old mode again.

    >>> apart("M120 M83 G1 E5 F300 M121"), apart("M106 S1")
    (('M120 M83', 'G91', 'G1 E5 F300', 'G90', 'M121'), ('M106 S1',))
    """
    parts = _KEPT.fullmatch(line)
    if parts is None:
        return (line,)
    mode = parts["mode"] or "G91"
    back = ("G90",) if mode == "G91" else ()
    return parts["begin"], mode, parts["move"], *back, parts["end"]


def texts(line: str) -> dict[str, str]:
    """Return the texts of a line that stand behind a letter, by upper-case letter.

    >>> texts('M291 P"Is it there?" R "Look" S3')
    {'P': 'Is it there?', 'R': 'Look'}
    """
    return {
        found["letter"].upper(): _unquoted(found["text"])
        for found in _TEXT.finditer(line[:LONGEST])
        if found["letter"]
    }


def _unquoted(text: str) -> str:
    """Return what a text in quotes means; the reverse of :func:`quoted`."""
    plain = text.replace('""', '"')
    return re.sub("'(.)", lambda found: found[1].lower(), plain, flags=re.DOTALL)


def axis_word(letter: str, value: str = "") -> str:
    """Return an axis letter with a value; lower-case axes are written ``'a``."""
    return f"'{letter}{value}" if letter.islower() else f"{letter}{value}"
