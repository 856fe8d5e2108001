"""RRF's expressions in braces, as far as macros and hosts use them."""

from __future__ import annotations

import operator
import re
from typing import Any, Callable, NamedTuple

from .functions import FUNCTIONS, Literal, text_of

__all__ = ["BadExpression", "arguments", "evaluate", "text_of"]

_TOKEN = re.compile(
    r"""\s*(?:(?P<number>\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+)|(?P<text>"(?:[^"]|"")*")"""
    r"""|(?P<name>\#?[A-Za-z_][\w]*(?:\.[A-Za-z_]\w*|\[[^\[\]]*\])*)"""
    r"""|(?P<sign>==|!=|<=|>=|&&|\|\||[-+*/^<>=!(){},&|?:%]))"""
)
"""One token; the group that matched is its kind."""

_APOSTROPHE = re.compile(r"'([A-Za-z'])")
"""What an apostrophe in a text changes: the letter behind it, and itself doubled."""

_LITERALS = {"true": True, "false": False, "null": None}


def _divided(a: Any, b: Any) -> float:
    """Return the quotient, infinite where the divisor is 0 (seen in firmware)."""
    return float(a) / b if b else float("inf")


_BINARY = (
    {"&&": lambda a, b: a and b, "||": lambda a, b: a or b, "&": lambda a, b: a and b},
    {
        "=": operator.eq,
        "==": operator.eq,
        "!=": operator.ne,
        "<": operator.lt,
        ">": operator.gt,
        "<=": operator.le,
        ">=": operator.ge,
    },
    {"^": lambda a, b: text_of(a) + text_of(b)},
    {"+": operator.add, "-": operator.sub},
    {"*": operator.mul, "/": _divided},
)
"""Operators from the loosest binding to the tightest."""


class BadExpression(ValueError):
    """An expression that can't be read or evaluated; the text is what RRF says."""

    def __init__(
        self, text: str, at: int | None = None, names_line: bool = False, *, told: str = ""
    ):
        super().__init__(text)
        self.told = told
        """The values of a list in front of it, as echo tells them."""
        self.at = at
        """Offset in the expression, where it is known."""
        self.names_line = names_line
        """Whether RRF names the line besides the column."""


class _Token(NamedTuple):
    kind: str
    text: str
    at: int


def _tokens(text: str) -> list[_Token]:
    found: list[_Token] = []
    at = 0
    text = text.rstrip()
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise BadExpression("expected an expression", at)
        kind = match.lastgroup or ""
        found.append(_Token(kind, match.group(kind), match.start(kind)))
        at = match.end()
    return found


class _Parser:
    def __init__(self, text: str, lookup: Callable[[str], Any]):
        self._tokens = _tokens(text)
        self._length = len(text.rstrip())
        self._at = 0
        self._lookup = lookup

    def _peek(self) -> str:
        return self._tokens[self._at].text if self._at < len(self._tokens) else ""

    def _where(self) -> int:
        return self._tokens[self._at].at if self._at < len(self._tokens) else self._length

    def _take(self, wanted: str = "") -> _Token:
        if self._at >= len(self._tokens) or (wanted and self._peek() != wanted):
            text = f"expected '{wanted}'" if wanted else "expected an expression"
            raise BadExpression(text, self._where())
        self._at += 1
        return self._tokens[self._at - 1]

    def whole(self) -> Any:
        value = self.ternary()
        if self._at < len(self._tokens):
            raise BadExpression("expected '}'", self._where())
        return value

    def ternary(self) -> Any:
        """Return the value of ``a`` or of ``a ? b : c``."""
        value = self.level(0)
        if self._peek() != "?":
            return value
        self._take()
        chosen = self.ternary()
        self._take(":")
        other = self.ternary()
        return chosen if value else other

    def level(self, depth: int) -> Any:
        if depth == len(_BINARY):
            return self.unary()
        value = self.level(depth + 1)
        while self._peek() in _BINARY[depth]:
            apply = _BINARY[depth][self._take().text]
            other = self.level(depth + 1)
            try:
                value = apply(value, other)
            except TypeError:
                raise BadExpression("cannot combine operands of these types") from None
        return value

    def unary(self) -> Any:
        where = self._where()
        kind, text, _ = self._take()
        if kind == "number":
            return int(text) if text.isdigit() else Literal.read(text)
        if kind == "text":
            # as outside of expressions (RRF 3.5 ExpressionParser.cpp, ParseQuotedString)
            return _APOSTROPHE.sub(lambda m: m[1].lower(), text[1:-1].replace('""', '"'))
        if kind == "name":
            return self._named(text, where)
        if text == "(":
            value = self.ternary()
            self._take(")")
            return value
        if text == "{":
            return self.braces()
        if text == "-":
            return -self.unary()
        if text == "!":
            return not self.unary()
        raise BadExpression("expected an expression", where)

    def _named(self, text: str, where: int) -> Any:
        if text in _LITERALS:
            return _LITERALS[text]
        if self._peek() == "(" and text in (*FUNCTIONS, "exists"):
            return self._called(text)
        try:
            return self._lookup(text)
        except BadExpression as error:
            at = where if error.names_line else where + len(text)
            raise BadExpression(str(error), at, error.names_line) from None

    def _called(self, name: str) -> Any:
        self._take("(")
        if name == "exists":
            path = self._take().text
            self._take(")")
            return self._exists(path)
        values = []
        while self._peek() not in (")", ""):
            values.append(self.ternary())
            if self._peek() == ",":
                self._take()
        self._take(")")
        return FUNCTIONS[name](*values)

    def _exists(self, path: str) -> bool:
        try:
            return self._lookup(path) is not None
        except BadExpression:
            return False

    def listed(self) -> list[Any]:
        """Return the values of a whole list in braces."""
        self._take("{")
        values = [self.ternary()]
        while self._peek() == ",":
            self._take()
            if self._peek() != "}":
                values.append(self.ternary())
        if self._peek() != "}":
            told = " ".join(text_of(value) for value in values)
            raise BadExpression("expected ','", self._where(), told=told)
        return values

    def braces(self) -> Any:
        """Return the value in braces; with commas an array."""
        values = [self.ternary()]
        is_array = False
        while self._peek() == ",":
            self._take()
            is_array = True
            if self._peek() != "}":
                values.append(self.ternary())
        self._take("}")
        return values if is_array else values[0]


def evaluate(text: str, lookup: Callable[[str], Any]) -> Any:
    """Return the value of an expression; ``lookup(path)`` gives variables and model members."""
    try:
        return _Parser(text, lookup).whole()
    except (TypeError, RecursionError):
        raise BadExpression("expected an expression") from None


def arguments(text: str, lookup: Callable[[str], Any]) -> list[Any]:
    """Return the values of a comma-separated list, as ``echo`` takes them."""
    try:
        return _Parser("{" + text + ",}", lookup).listed()
    except (TypeError, RecursionError):
        raise BadExpression("expected an expression") from None
