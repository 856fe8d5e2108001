"""The functions of RRF's expressions, and how values are printed (RRF 3.5 ExpressionParser.cpp)."""

from __future__ import annotations

import datetime
import math
import random
from collections.abc import Mapping
from typing import Any, Callable

COMPUTED_DECIMALS = 6
"""Decimals of a number that has been computed (seen in firmware)."""


class Literal(float):
    """A number that is printed with the decimals it was written with."""

    decimals: int

    @classmethod
    def read(cls, text: str) -> Literal:
        """Return the number that the text is."""
        fraction = text.partition(".")[2] if "e" not in text.lower() else ""
        found = cls(text)
        found.decimals = max(1, len(fraction))
        return found

    @classmethod
    def of_model(cls, value: float) -> Literal:
        """Return a member of the object model with the decimals it needs."""
        found = cls(value)
        found.decimals = max(1, len(f"{value:.3f}".rstrip("0").partition(".")[2]))
        return found

    def __neg__(self) -> Literal:
        found = Literal(-float(self))
        found.decimals = self.decimals
        return found


def text_of(value: Any) -> str:
    """Return a value as ``echo`` prints it."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return "{" + ",".join(text_of(element) for element in value) + "}"
    if isinstance(value, float):
        if not math.isfinite(value):
            return "nan" if math.isnan(value) else str(float(value))
        decimals = getattr(value, "decimals", COMPUTED_DECIMALS)
        return f"{float(value):.{decimals}f}"
    return str(value)


def _date_time(seconds: Any) -> str:
    moment = datetime.datetime(1970, 1, 1) + datetime.timedelta(seconds=int(seconds))
    return moment.isoformat()


def _vector(count: int, value: Any) -> list[Any]:
    return [value] * int(count)


FUNCTIONS: Mapping[str, Callable[..., Any]] = {
    "abs": abs,
    "ceil": math.ceil,
    "cos": math.cos,
    "datetime": _date_time,
    "degrees": math.degrees,
    "exp": math.exp,
    "floor": math.floor,
    "isnan": lambda value: isinstance(value, float) and math.isnan(value),
    "log": math.log,
    "max": max,
    "min": min,
    "mod": math.fmod,
    "pow": pow,
    "radians": math.radians,
    "random": lambda limit: random.randrange(max(1, int(limit))),
    "round": round,
    "sin": math.sin,
    "sqrt": math.sqrt,
    "square": lambda value: value * value,
    "tan": math.tan,
    "vector": _vector,
}
"""Name → function of its arguments; ``exists`` is the parser's, since it looks at a name."""
