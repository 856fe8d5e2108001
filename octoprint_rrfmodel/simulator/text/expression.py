"""RRF's expressions in braces, as far as macros and hosts use them."""

from __future__ import annotations

import operator
import re
from typing import Any, Callable

_TOKEN = re.compile(
    r"""\s*(?:(?P<number>\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+)|(?P<text>"(?:[^"]|"")*")"""
    r"""|(?P<name>\#?[A-Za-z_][\w]*(?:\.[A-Za-z_]\w*|\[[^\[\]]*\])*)"""
    r"""|(?P<sign>==|!=|<=|>=|&&|\|\||[-+*/^<>=!(){},&|]))"""
)
"""One token; the group that matched is its kind."""

_APOSTROPHE = re.compile(r"'([A-Za-z'])")
"""What an apostrophe in a text changes: the letter behind it, and itself doubled."""

_LITERALS = {"true": True, "false": False, "null": None}

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
    {"*": operator.mul, "/": operator.truediv},
)
"""Operators from the loosest binding to the tightest."""


class BadExpression(ValueError):
    """An expression that can't be read or evaluated; the text is what RRF says."""


def text_of(value: Any) -> str:
    """Return a value as ``echo`` prints it."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return "{" + ",".join(text_of(element) for element in value) + "}"
    if isinstance(value, float):
        return f"{value:.3f}".rstrip("0").rstrip(".") or "0"
    return str(value)


def _tokens(text: str) -> list[Any]:
    found: list[Any] = []
    at = 0
    text = text.rstrip()
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise BadExpression("expected an expression")
        kind = match.lastgroup or ""
        found.append((kind, match.group(kind)))
        at = match.end()
    return found


class _Parser:
    def __init__(self, tokens: list[Any], lookup: Callable[[str], Any]):
        self._tokens = tokens
        self._at = 0
        self._lookup = lookup

    def _peek(self) -> str:
        return self._tokens[self._at][1] if self._at < len(self._tokens) else ""

    def _take(self, wanted: str = "") -> Any:
        if self._at >= len(self._tokens) or (wanted and self._peek() != wanted):
            raise BadExpression(f"expected '{wanted}'" if wanted else "expected an expression")
        self._at += 1
        return self._tokens[self._at - 1]

    def whole(self) -> Any:
        value = self.level(0)
        if self._at < len(self._tokens):
            raise BadExpression("expected '}'")
        return value

    def level(self, depth: int) -> Any:
        if depth == len(_BINARY):
            return self.unary()
        value = self.level(depth + 1)
        while self._peek() in _BINARY[depth]:
            apply = _BINARY[depth][self._take()[1]]
            other = self.level(depth + 1)
            try:
                value = apply(value, other)
            except (TypeError, ZeroDivisionError):
                raise BadExpression("cannot combine operands of these types") from None
        return value

    def unary(self) -> Any:
        kind, text = self._take()
        if kind == "number":
            return int(text) if text.isdigit() else float(text)
        if kind == "text":
            # as outside of expressions (RRF 3.5 ExpressionParser.cpp, ParseQuotedString)
            return _APOSTROPHE.sub(lambda m: m[1].lower(), text[1:-1].replace('""', '"'))
        if kind == "name":
            return _LITERALS[text] if text in _LITERALS else self._lookup(text)
        if text == "(":
            value = self.level(0)
            self._take(")")
            return value
        if text == "{":
            return self.braces()
        if text == "-":
            return -self.unary()
        if text == "!":
            return not self.unary()
        raise BadExpression("expected an expression")

    def braces(self) -> Any:
        """Return the value in braces; with commas an array."""
        values = [self.level(0)]
        is_array = False
        while self._peek() == ",":
            self._take()
            is_array = True
            if self._peek() != "}":
                values.append(self.level(0))
        self._take("}")
        return values if is_array else values[0]


def evaluate(text: str, lookup: Callable[[str], Any]) -> Any:
    """Return the value of an expression; ``lookup(path)`` gives variables and model members."""
    try:
        return _Parser(_tokens(text), lookup).whole()
    except (TypeError, RecursionError):
        raise BadExpression("expected an expression") from None


def arguments(text: str, lookup: Callable[[str], Any]) -> list[Any]:
    """Return the values of a comma-separated list, as ``echo`` takes them."""
    return list(evaluate("{" + text + ",}", lookup))
