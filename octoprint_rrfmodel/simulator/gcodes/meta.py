"""Meta commands: echo, variables, abort. Conditions and loops are accepted and do nothing."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Callable

from ..line.channel import Channel, Macro, Outcome
from ..text import expression
from ..text.command import Command, GCodeError

if TYPE_CHECKING:
    from ..core import Core

_SET = re.compile(r"(var|global)\.([A-Za-z_]\w*)((?:\[[^\]]*\])*)\s*=(.*)", re.DOTALL)
"""An assignment; groups: kind, name, indexes, expression."""
_DECLARE = re.compile(r"\s*([A-Za-z_]\w*)\s*=(.*)", re.DOTALL)


def meta(board: Core, channel: Channel, command: Command) -> Outcome:
    """Any meta command."""
    word, _, rest = command.text.partition(" ")
    try:
        return META[word](board, channel, rest)
    except expression.BadExpression as error:
        raise GCodeError(str(error)) from None


def _echo(board: Core, channel: Channel, text: str) -> Outcome:
    values = expression.arguments(text, channel.lookup)
    return " ".join(expression.text_of(value) for value in values)


def _declared(text: str, channel: Channel) -> tuple[str, Any]:
    match = _DECLARE.match(text)
    if match is None:
        raise GCodeError("expected '='")
    return match.group(1), expression.evaluate(match.group(2), channel.lookup)


def _global(board: Core, channel: Channel, text: str) -> Outcome:
    name, value = _declared(text, channel)
    if name in board.data["global"]:
        raise GCodeError(f"variable '{name}' already exists")
    board.data["global"][name] = value
    board.bump("global")
    return None


def _var(board: Core, channel: Channel, text: str) -> Outcome:
    name, value = _declared(text, channel)
    channel.variables[name] = value
    return None


def _set(board: Core, channel: Channel, text: str) -> Outcome:
    match = _SET.match(text.strip())
    if match is None:
        raise GCodeError("expected a variable")
    is_global = match.group(1) == "global"
    variables = board.data["global"] if is_global else channel.variables
    if match.group(2) not in variables:
        raise GCodeError(f"unknown variable '{match.group(2)}'")
    value = expression.evaluate(match.group(4), channel.lookup)
    indexes = [int(index) for index in re.findall(r"\[\s*(\d+)\s*\]", match.group(3))]
    if indexes:
        target = variables[match.group(2)]
        for index in indexes[:-1]:
            target = target[index]
        target[indexes[-1]] = value
    else:
        variables[match.group(2)] = value
    if is_global:
        board.bump("global")
    return None


def _abort(board: Core, channel: Channel, text: str) -> Outcome:
    if text.strip():
        board.message(expression.text_of(expression.evaluate(text, channel.lookup)) + "\n")
    if channel.macro_depth:
        raise Macro
    return None


def _nothing(board: Core, channel: Channel, text: str) -> Outcome:
    return None


META: dict[str, Callable[[Core, Channel, str], Outcome]] = dict.fromkeys(
    ("if", "elif", "else", "while", "break", "continue", "skip"), _nothing
)
META.update({"echo": _echo, "global": _global, "var": _var, "set": _set, "abort": _abort})

TABLE = {"meta": meta}
