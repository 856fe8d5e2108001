"""Lines to commands, and the values that expressions in them ask for."""

from __future__ import annotations

from functools import partial
from typing import Any, Callable

from ..device.motion import Motion
from ..line.channel import Channel
from ..model.tree import ObjectModel
from ..text.command import Command, Lookup, commands_of, without_comment


class Decoder:
    """Reads lines as the machine's mode wants them; ``member`` gives members of the model."""

    def __init__(self, model: ObjectModel, motion: Motion, member: Callable[[str], Any]):
        self._model = model
        self._motion = motion
        self._member = member

    def commands(self, channel: Channel, text: str) -> list[Command]:
        """Return the commands of a line, none where there is nothing but a comment."""
        is_cnc = self._model.is_cnc
        bare = without_comment(text, is_cnc) if ";" in text or is_cnc else text
        if not bare or bare.isspace():
            return []
        return commands_of(bare, self.lookup(channel), self._motion.last_code if is_cnc else None)

    def lookup(self, channel: Channel) -> Lookup:
        """Return the function from a path to its value, as seen from that channel."""
        return partial(self._value, channel)

    def _value(self, channel: Channel, path: str) -> Any:
        """Return a variable of the channel or a member of the object model."""
        if path.startswith("var."):
            return channel.variables.get(path[4:])
        return self._member(path)
