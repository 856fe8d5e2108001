"""A line cut into its commands."""

from __future__ import annotations

import re

from . import expression
from .command import CONTROL, IN_BRACES, Command, Lookup, SyntaxProblem

WHOLE_LINE = frozenset((20, 23, 28, 30, 32, 36, 37, 38, 117))
"""M-codes whose text runs to the end of the line, whatever letters are in it."""

META_WORDS = frozenset(("echo", "global", "set", "var"))
"""Meta commands that there are on every channel."""

FILE_WORDS = META_WORDS | {"abort", "break", "continue", "elif", "else", "if", "skip", "while"}
"""Meta commands in files; conditions and loops typed on USB are bad (seen in firmware)."""

_META = re.compile(r"\s*([a-z]+)\b(.*)", re.DOTALL)
"""A meta command; groups: word, the rest."""

_HEAD = re.compile(r"\s*(?:([GMQgmq])(-?\d+)(?:\.(\d+))?|([Tt])\s*(-?\d+(?![.\d])|\{[^}]*\})?)")
"""The start of a command; groups: letter, number, fraction, T, tool."""


_NEXT = re.compile(rf'"(?:[^"]|"")*"?|\{{{IN_BRACES}\}}?|\'.|[GMgm]')
"""What matters for finding the next command: any of its letters that isn't quoted starts one."""


def without_comment(line: str, parentheses: bool = False) -> str:
    """Return the line up to its comment; quotes and, on a CNC machine, ``( )`` are seen."""
    if ";" in line:
        quoted = False
        for at, char in enumerate(line):
            if char == '"':
                quoted = not quoted
            elif char == ";" and not quoted:
                line = line[:at]
                break
    if parentheses and "(" in line and '"' not in line:
        line = re.sub(r"\([^)]*\)?", "", line)
    return line


def _end_of_command(line: str, start: int) -> int:
    for match in _NEXT.finditer(line, start):
        if match.group()[0] in "GMgm":
            return match.start()
    return len(line)


def commands_of(
    line: str, lookup: Lookup, last_move: int | None = None, *, in_file: bool = False
) -> list[Command]:
    """Return the commands of a line without its comment, what is none as a ``bad`` one.

    ``last_move`` is the G number that a line with coordinates only continues (CNC mode).
    """
    found: list[Command] = []
    words = FILE_WORDS if in_file else META_WORDS
    at = 0
    while at < len(line) and not line[at:].isspace():
        head = _HEAD.match(line, at)
        if head is None:
            meta = _META.match(line, at)
            if meta and meta.group(1) in words and not found:
                found.append(
                    Command("meta", None, -1, text=line[at:].strip(), column=at, lookup=lookup)
                )
                return found
            if last_move is not None and re.match(r"\s*[XYZUVWABC]", line[at:]):
                found.append(Command("G", last_move, -1, text=line[at:], column=at, lookup=lookup))
                return found
            start = len(line) - len(line[at:].lstrip())
            end = _end_of_command(line, start + 1) if line[start] in "GMgm" else len(line)
            found.append(Command("bad", None, -1, text=line[at:end], column=at, lookup=lookup))
            at = end
            continue
        if head.group(4):
            letter, number, fraction = "T", _tool_of(head.group(5), lookup), -1
        else:
            letter, number = head.group(1).upper(), _wrapped(int(head.group(2)))
            fraction = int(head.group(3)) if head.group(3) else -1
        start = head.end()
        if (
            letter == "Q"
            or letter == "M"
            and number in WHOLE_LINE
            and not line[start:].lstrip().startswith('"')
        ):
            end = len(line)
        else:
            end = _end_of_command(line, start)
        found.append(
            Command(letter, number, fraction, text=line[start:end], column=start, lookup=lookup)
        )
        at = end
    return found


def _wrapped(number: int) -> int:
    """Return a number as it is left in 32 bits."""
    return (number + 2**31) % 2**32 - 2**31


def bad_command(text: str) -> str:
    """Return what RRF says of text that is no command."""
    # an apostrophe is about the letter behind it, and goes where there is none (seen in firmware)
    shown = CONTROL.sub(lambda match: f"[0x{ord(match[0]):02x}]", text.strip()).rstrip("'")
    return f"Bad command: {shown}"


def _tool_of(text: str | None, lookup: Lookup) -> int | None:
    if text is None:
        return None
    if text.startswith("{"):
        try:
            return int(expression.evaluate(text, lookup))
        except (expression.BadExpression, TypeError, ValueError):
            raise SyntaxProblem("T: expected a numeric expression") from None
    return int(text)
