"""Lines to commands, and the values that expressions in them ask for."""

from __future__ import annotations

import math
from functools import partial
from typing import Any, Callable

from ..device.motion import Motion
from ..line.channel import Channel
from ..model.tree import ObjectModel
from ..text.command import Command, Lookup
from ..text.cutting import commands_of, without_comment
from ..text.expression import BadExpression
from ..text.functions import Literal


class Decoder:
    """Reads lines as the machine's mode wants them; ``member`` gives members of the model."""

    def __init__(self, model: ObjectModel, motion: Motion, member: Callable[[str], Any]):
        self._model = model
        self._motion = motion
        self._member = member

    def commands(self, channel: Channel, text: str, *, in_file: bool = False) -> list[Command]:
        """Return the commands of a line, none where there is nothing but a comment."""
        is_cnc = self._model.is_cnc
        bare = self.without_comment(text)
        if not bare or bare.isspace():
            return []
        last_move = self._motion.last_code if is_cnc else None
        return commands_of(bare, self.lookup(channel), last_move, in_file=in_file)

    def without_comment(self, text: str) -> str:
        """Return what of the line the firmware keeps in its buffer."""
        is_cnc = self._model.is_cnc
        return without_comment(text, is_cnc) if ";" in text or is_cnc else text

    def lookup(self, channel: Channel) -> Lookup:
        """Return the function from a path to its value, as seen from that channel."""
        return partial(self._value, channel)

    def _value(self, channel: Channel, path: str) -> Any:
        """Return a constant, a variable of the channel or a member of the object model."""
        if path.startswith("var."):
            return channel.variables.get(path[4:])
        if path == "pi":
            return math.pi
        if path == "line":
            return channel.line_count
        if path == "result":
            return 0
        if path == "iterations":
            raise BadExpression("'iterations' used when not inside a loop")
        value = self._member(path)
        root = path.lstrip("#").partition(".")[0].partition("[")[0]
        if value is None and root not in self._model.data:
            raise BadExpression(f"unknown value '{path}'", names_line=True)
        return Literal.of_model(value) if isinstance(value, float) else value
