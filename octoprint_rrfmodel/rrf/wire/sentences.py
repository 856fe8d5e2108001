"""Where the firmware's sentences are in a line that is too long to be one."""

from __future__ import annotations

LONGEST = 256
"""Bytes of a text reply (``GCodeReplyLength``, 3.5 Configuration.h:151)."""

SEVERAL = 8 * LONGEST
"""Messages without a line end of their own glue to the next line, in front of it or behind."""


def sentences(line: str) -> str:
    """Return the line, of a very long one its beginning and its end.

    No sentence stands anywhere else, and a broken board's line would keep the line's thread.

    >>> len(sentences("x" * 64_000)), sentences("Error: G1: target position not reachable")
    (4097, 'Error: G1: target position not reachable')
    """
    if len(line) <= 2 * SEVERAL:
        return line
    return f"{line[:SEVERAL]}\n{line[-SEVERAL:]}"
