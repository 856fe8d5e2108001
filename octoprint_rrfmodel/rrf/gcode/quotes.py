"""Quotes in a G-code line: what a semicolon in them means to a host, and one that isn't closed.

A host cuts a line at its first semicolon, the firmware at the first one that stands outside of
quotes. A quote that isn't closed takes the checksum into its text (3.5 StringParser.cpp:262-345).
"""

from __future__ import annotations

from ..wire.gcode_words import quoted
from .plain_lines import TAKES_TEXT

ROW = "quotes"
"""As the setting that switches this off is called."""

ONLY_TEXT = frozenset(("M117", "M118", "echo"))
"""Commands of which nothing but a text is lost with what stood behind the quote."""


def has_odd_quote(line: str) -> bool:
    """Return whether a quote of a line isn't closed; a doubled one counts twice.

    >>> has_odd_quote('M117 "a'), has_odd_quote('M117 "a"')
    (True, False)
    """
    return line.count('"') % 2 == 1


def without_comment(line: str) -> str:
    """Return a line up to where the firmware sees a comment begin.

    >>> without_comment('M291 P"a;b" S3 ; and "so" on')
    'M291 P"a;b" S3'
    """
    is_quoted = False
    for place, char in enumerate(line):
        if char == '"':
            is_quoted = not is_quoted
        elif char == ";" and not is_quoted:
            return line[:place].strip()
    return line.strip()


def completed(command: str, gcode: str) -> str | None:
    """Return a command with its quote closed, ``None`` where something may be missing behind it.

    >>> completed('M118 S"so', "M118"), completed('M117 5" wide', "M117")
    ('M118 S"so"', 'M117 "5"" wide"')
    >>> completed('M98 P"a', "M98") is None
    True
    """
    if gcode in ONLY_TEXT & TAKES_TEXT:
        text = command[len(gcode) :].strip()
        return f'{command}"' if text.startswith('"') else f"{gcode} {quoted(text)}"
    return f'{command}"' if gcode in ONLY_TEXT else None
