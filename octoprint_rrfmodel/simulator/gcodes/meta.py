"""Meta commands: echo, variables; in files abort too, and conditions and loops that do nothing."""

from __future__ import annotations

import re
from typing import Any, Callable

from ..interpreter.decoder import Decoder
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import MacroAbandoned, Outcome
from ..line.output import Output
from ..model.tree import ObjectModel
from ..text import expression
from ..text.command import Command, GCodeError, SyntaxProblem, UnansweredError

_SET = re.compile(r"(var|global)\.([A-Za-z_]\w*)((?:\[[^\]]*\])*)\s*=(.*)", re.DOTALL)
"""An assignment; groups: kind, name, indexes, expression."""
_DECLARE = re.compile(r"\s*([A-Za-z_]\w*)\s*=(.*)", re.DOTALL)
"""A declaration; groups: name, expression."""

_IGNORED = ("if", "elif", "else", "while", "break", "continue", "skip")


class MetaCommands:
    """Runs what begins with a word instead of a letter and a number."""

    def __init__(self, model: ObjectModel, decoder: Decoder, output: Output):
        self._model = model
        self._decoder = decoder
        self._output = output
        self._words: dict[str, Callable[[Channel, str], Outcome]] = {
            **dict.fromkeys(_IGNORED, self._nothing),
            "abort": self._abort,
            "echo": self._echo,
            "global": self._global,
            "set": self._set,
            "var": self._var,
        }

    def rows(self) -> Rows:
        return {
            "meta": Row(self._meta),
        }

    def _meta(self, channel: Channel, command: Command) -> Outcome:
        """Any meta command."""
        word, _, rest = command.text.partition(" ")
        try:
            return self._words[word](channel, rest)
        except expression.BadExpression as error:
            # the list of echo is read with a brace in front of it
            before = command.column + len(word) + (1 if word == "echo" else 2)
            column = None if error.at is None else before + error.at
            raise SyntaxProblem(
                f"meta command: {error}", column, error.names_line, told=error.told
            ) from None

    def _echo(self, channel: Channel, text: str) -> Outcome:
        values = expression.arguments(text, self._decoder.lookup(channel))
        return " ".join(expression.text_of(value) for value in values)

    def _declared(self, channel: Channel, text: str) -> tuple[str, Any]:
        match = _DECLARE.match(text)
        if match is None:
            raise GCodeError("expected '='")
        return match.group(1), expression.evaluate(match.group(2), self._decoder.lookup(channel))

    def _global(self, channel: Channel, text: str) -> Outcome:
        name, value = self._declared(channel, text)
        if name in self._model.data["global"]:
            raise UnansweredError(f"variable '{name}' already exists")
        self._model.data["global"][name] = value
        self._model.bump("global")
        return None

    def _var(self, channel: Channel, text: str) -> Outcome:
        name, value = self._declared(channel, text)
        channel.variables[name] = value
        return None

    def _set(self, channel: Channel, text: str) -> Outcome:
        match = _SET.match(text.strip())
        if match is None:
            raise GCodeError("expected a variable")
        is_global = match.group(1) == "global"
        variables = self._model.data["global"] if is_global else channel.variables
        if match.group(2) not in variables:
            raise GCodeError(f"unknown variable '{match.group(2)}'")
        value = expression.evaluate(match.group(4), self._decoder.lookup(channel))
        indexes = [int(index) for index in re.findall(r"\[\s*(\d+)\s*\]", match.group(3))]
        if indexes:
            target = variables[match.group(2)]
            for index in indexes[:-1]:
                target = target[index]
            target[indexes[-1]] = value
        else:
            variables[match.group(2)] = value
        if is_global:
            self._model.bump("global")
        return None

    def _abort(self, channel: Channel, text: str) -> Outcome:
        if text.strip():
            value = expression.evaluate(text, self._decoder.lookup(channel))
            self._output.text(expression.text_of(value) + "\n")
        if channel.macro_depth:
            raise MacroAbandoned
        return None

    def _nothing(self, channel: Channel, text: str) -> Outcome:
        return None
