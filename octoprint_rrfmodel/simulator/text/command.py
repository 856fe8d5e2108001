"""One G-code command: its letter, number and parameters."""

from __future__ import annotations

import re
from typing import Any, Callable

from . import expression

Lookup = Callable[[str], Any]

CONTROL = re.compile(r"[\x00-\x1f]")
"""What may stand in no text."""

IN_BRACES = r'(?:"(?:[^"]|"")*"(?!")|[^{}"])*'
"""What may stand between braces besides further braces: braces in a text are none."""

_PARAMETER = re.compile(
    r"""\s*('?[A-Za-z])\s*((?:"(?:[^"]|"")*")|"""
    rf"""(?:\{{{IN_BRACES}(?:\{{{IN_BRACES}\}}{IN_BRACES})*\}})|"""
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

    is_bare = False
    """Whether the reply leaves the name of the command out."""
    is_silent = False
    """Whether no ``ok`` follows."""


class BareError(GCodeError):
    """A command that fails with a reply that doesn't name it."""

    is_bare = True


class UnansweredError(GCodeError):
    """A command that fails without any ``ok`` (seen in firmware)."""

    is_silent = True


class SyntaxProblem(Exception):
    """A command that can't be read; ``column`` counts from 1 where it is known."""

    def __init__(
        self, text: str, column: int | None = None, names_line: bool = False, *, told: str = ""
    ):
        super().__init__(text)
        self.text = text
        self.column = column
        self.told = told
        """What the command has answered before it came to the problem."""
        self.names_line = names_line
        """Whether the message names the channel's line besides the column."""


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
        """``G``, ``M``, ``T``, ``Q`` for a comment, ``meta`` for a meta command, ``bad``."""
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
            return self._evaluated(text, column)
        if ":" in text:
            return [self._number(part, column) for part in text.split(":")]
        return self._number(text, column) if text else None

    def _evaluated(self, text: str, column: int) -> Any:
        try:
            return expression.evaluate(text, self._lookup)
        except expression.BadExpression as error:
            at = column if error.at is None else column + error.at
            raise SyntaxProblem(f"{self.name}: {error}", at, error.names_line) from None

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
        if self.raw[letter][0].startswith('"'):
            raise SyntaxProblem(
                f"{self.name}: expected number after '{letter}'", self.raw[letter][1]
            )
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
        rest = self.text[column - self.column - 1 :]
        if text[:1] == "{":
            value = expression.text_of(self.value(letter))
        elif rest[:1] == "{":
            value = self._evaluated(rest, column)
        elif text[:1] == '"':
            self._check_characters(text, column)
            value = self.unquoted(text)
        elif rest[:1] == '"':
            # a text that isn't closed ends in the line's own end
            raise self._bad_character(self.column + len(self.text) + 2)
        else:
            raise SyntaxProblem(f"{self.name}: expected a string expression", column)
        if longest is not None and len(value.encode("utf-8")) > longest:
            raise SyntaxProblem(f"{self.name}: string too long", column)
        return value

    def _bad_character(self, column: int) -> SyntaxProblem:
        return SyntaxProblem(f"{self.name}: control character in string", column)

    def _check_characters(self, text: str, column: int) -> None:
        found = CONTROL.search(text)
        if found is not None:
            raise self._bad_character(column + found.start() + 1)

    def needed_string(self, letter: str, longest: int | None = None) -> str:
        """Return the text behind the letter, which must be there and not empty."""
        if letter not in self.raw:
            raise GCodeError(f"missing parameter '{letter}'")
        text = self.string(letter, longest) or ""
        if not text:
            raise self._empty(self.raw[letter][1] + len(self.raw[letter][0]))
        return text

    def needed_name(self) -> str:
        """Return the argument of M23 and the like, which must not be empty."""
        name = self.unquoted_text()
        if not name:
            raise self._empty(self.column + len(self.text.rstrip()) + 2)
        return name

    def loose_string(self, letter: str) -> str | None:
        """Return the text behind the letter, with or without quotes, not empty."""
        if letter not in self.raw:
            return None
        column = self.raw[letter][1]
        rest = self.text[column - self.column - 1 :]
        if rest[:1] in ('"', "{"):
            return self.needed_string(letter)
        if not rest.strip():
            raise self._empty(column + 1)
        return rest.strip()

    def _empty(self, column: int) -> SyntaxProblem:
        return SyntaxProblem(f"{self.name}: expected a non-empty string", column)

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
