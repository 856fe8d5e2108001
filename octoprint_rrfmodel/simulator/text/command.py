"""One G-code command: its letter, number and parameters, and a line cut into commands."""

from __future__ import annotations

import re
from typing import Any, Callable

from . import expression

Lookup = Callable[[str], Any]

WHOLE_LINE = frozenset((23, 28, 30, 32, 36, 37, 38, 117))
"""M-codes whose text runs to the end of the line, whatever letters are in it."""

META_WORDS = frozenset(
    ("abort", "break", "continue", "echo", "elif", "else", "global", "if", "set", "skip", "var")
    + ("while",)
)

_META = re.compile(r"\s*([a-z]+)\b(.*)", re.DOTALL)
"""A meta command; groups: word, the rest."""

_HEAD = re.compile(r"\s*(?:([GMgm])\s*(\d+)(?:\.(\d+))?|([Tt])\s*(-?\d+(?![.\d])|\{[^}]*\})?)")
"""The start of a command; groups: letter, number, fraction, T, tool."""

_IN_BRACES = r'(?:"(?:[^"]|"")*"(?!")|[^{}"])*'
"""What may stand between braces besides further braces: braces in a text are none."""

_NEXT = re.compile(rf'"(?:[^"]|"")*"?|\{{{_IN_BRACES}\}}?|\'.|[GMgm](?=\s*\d)')
"""What matters for finding the next command; only a letter that isn't quoted starts one."""

_PARAMETER = re.compile(
    r"""\s*('?[A-Za-z])\s*((?:"(?:[^"]|"")*")|"""
    rf"""(?:\{{{_IN_BRACES}(?:\{{{_IN_BRACES}\}}{_IN_BRACES})*\}})|"""
    r"""(?:[^\s"{}A-Za-z']+(?:[eE][-+]?\d+(?![\d.]))?))?"""
)
"""One parameter; groups: letter with its apostrophe, value as written."""

_QUOTED = re.compile(r'"(?:[^"]|"")*"')
"""A text in quotes, with quotes doubled inside."""

_APOSTROPHE = re.compile(r"'(.)")

_MOVE = re.compile(r"([A-Z])\s*(-?\d+\.?\d*|-?\.\d+)")
"""The common form of a G0/G1 parameter; groups: letter, number."""


class GCodeError(Exception):
    """A command that fails; the text is the reply without ``Error:`` and command name."""


class SyntaxProblem(Exception):
    """A command that can't be read; ``column`` counts from 1 where it is known."""

    def __init__(self, text: str, column: int | None = None):
        super().__init__(text)
        self.text = text
        self.column = column


class Command:
    """One command of a line, parameters read when asked for."""

    __slots__ = ("letter", "number", "fraction", "text", "column", "_parameters", "_lookup")

    def __init__(
        self,
        letter: str,
        number: int | None,
        fraction: int,
        *,
        text: str,
        column: int,
        lookup: Lookup,
    ):
        self.letter = letter
        """``G``, ``M``, ``T``, ``Q`` for a comment, ``meta`` for a meta command."""
        self.number = number
        self.fraction = fraction
        self.text = text
        """What follows the command, as written."""
        self.column = column
        """Where ``text`` starts in the line, from 0."""
        self._parameters: dict[str, tuple[str, int]] | None = None
        self._lookup = lookup

    @property
    def name(self) -> str:
        """As messages name it: ``M409``, ``G38.2``."""
        if self.letter == "meta":
            return self.text.split(None, 1)[0]
        number = "" if self.number is None else str(self.number)
        return f"{self.letter}{number}" + (f".{self.fraction}" if self.fraction >= 0 else "")

    @property
    def raw(self) -> dict[str, tuple[str, int]]:
        """Parameter letter → value as written and its column. A quoted ``'x`` is lower case."""
        if self._parameters is None:
            found: dict[str, tuple[str, int]] = {}
            for match in _PARAMETER.finditer(self.text):
                letter = match.group(1)
                letter = letter[1].lower() if letter[0] == "'" else letter.upper()
                found.setdefault(letter, (match.group(2) or "", self.column + match.end(1) + 1))
            self._parameters = found
        return self._parameters

    def __contains__(self, letter: str) -> bool:
        return letter in self.raw

    def value(self, letter: str) -> Any:
        """Return the parameter as number, text or list; ``None`` without it."""
        if letter not in self.raw:
            return None
        text, column = self.raw[letter]
        if text.startswith('"'):
            return self.unquoted(text)
        if text.startswith("{"):
            try:
                return expression.evaluate(text, self._lookup)
            except expression.BadExpression as error:
                raise SyntaxProblem(f"{self.name}: {error}", column) from None
        if ":" in text:
            return [self._number(part, column) for part in text.split(":")]
        return self._number(text, column) if text else None

    def _number(self, text: str, column: int) -> float:
        try:
            return int(text) if re.fullmatch(r"[-+]?\d+", text) else float(text)
        except ValueError:
            raise SyntaxProblem(f"{self.name}: expected number after", column) from None

    def number_of(self, letter: str, default: float | None = None) -> float | None:
        """Return the number behind the letter; ``default`` without the letter."""
        value = self.value(letter)
        if isinstance(value, list):
            value = value[0]
        if value is None:
            if letter in self:
                raise SyntaxProblem(
                    f"{self.name}: expected number after '{letter}'", self.raw[letter][1]
                )
            return default
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise SyntaxProblem(f"{self.name}: expected a numeric expression", self.raw[letter][1])
        return float(value)

    def integer(self, letter: str, default: int | None = None) -> int | None:
        value = self.number_of(letter)
        return default if value is None else int(value)

    def numbers(self, letter: str) -> list[float] | None:
        """Return the numbers of ``S1:2:3`` as a list; ``None`` without the letter."""
        value = self.value(letter)
        if isinstance(value, list):
            return [float(part) for part in value]
        number = self.number_of(letter)
        return None if number is None else [number]

    def string(self, letter: str, longest: int | None = None) -> str | None:
        """Return the text behind the letter, which must be quoted or an expression."""
        if letter not in self.raw:
            return None
        text, column = self.raw[letter]
        value = self.value(letter) if text[:1] in ('"', "{") else None
        if not isinstance(value, str):
            raise SyntaxProblem(f"{self.name}: expected a string expression", column)
        if longest is not None and len(value.encode("utf-8")) > longest:
            raise SyntaxProblem(f"{self.name}: string too long", column)
        return value

    def unquoted_text(self) -> str:
        """Return the argument of M23, M117 and the like, with or without quotes."""
        text = self.text.strip()
        if text.startswith('"'):
            found = _QUOTED.match(text)
            return self.unquoted(found[0]) if found else text[1:]
        return text

    @staticmethod
    def unquoted(text: str) -> str:
        """Return a quoted text as RRF reads it: ``""`` a quote, ``'X`` lower-case x."""
        inner = text[1:-1].replace('""', '"')
        return _APOSTROPHE.sub(lambda m: m.group(1).lower(), inner)

    def coordinates(self) -> dict[str, float]:
        """Return letter → number for a move, the common form quickly."""
        if self._parameters is None:
            found = _MOVE.findall(self.text)
            rest = _MOVE.sub("", self.text)
            if not rest or rest.isspace():
                return {letter: float(number) for letter, number in found}
        return {letter: self.number_of(letter) or 0.0 for letter in self.raw}


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


def commands_of(line: str, lookup: Lookup, last_move: int | None = None) -> list[Command]:
    """Return the commands of a line without its comment; :class:`SyntaxProblem` where it has none.

    ``last_move`` is the G number that a line with coordinates only continues (CNC mode).
    """
    found: list[Command] = []
    at = 0
    while at < len(line) and not line[at:].isspace():
        head = _HEAD.match(line, at)
        if head is None:
            meta = _META.match(line, at)
            if meta and meta.group(1) in META_WORDS:
                found.append(
                    Command("meta", None, -1, text=line[at:].strip(), column=at, lookup=lookup)
                )
                return found
            if last_move is not None and re.match(r"\s*[XYZUVWABC]", line[at:]):
                found.append(Command("G", last_move, -1, text=line[at:], column=at, lookup=lookup))
                return found
            raise SyntaxProblem(f"Bad command: {line[at:].strip()}")
        if head.group(4):
            letter, number, fraction = "T", _tool_of(head.group(5), lookup), -1
        else:
            letter, number = head.group(1).upper(), int(head.group(2))
            fraction = int(head.group(3)) if head.group(3) else -1
        start = head.end()
        if letter == "M" and number in WHOLE_LINE and not line[start:].lstrip().startswith('"'):
            end = len(line)
        else:
            end = _end_of_command(line, start)
        found.append(
            Command(letter, number, fraction, text=line[start:end], column=start, lookup=lookup)
        )
        at = end
    return found


def _tool_of(text: str | None, lookup: Lookup) -> int | None:
    if text is None:
        return None
    if text.startswith("{"):
        try:
            return int(expression.evaluate(text, lookup))
        except (expression.BadExpression, TypeError, ValueError):
            raise SyntaxProblem("T: expected a numeric expression") from None
    return int(text)
