"""What a board is busy with besides moving: macros of its own, a tool change, or being halted."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator

from ..line.channel import Channel


class Activity:
    """Tells whether the board is halted, changes a tool or runs a macro of the firmware's own."""

    def __init__(self) -> None:
        self.restart()

    def restart(self) -> None:
        self.is_halted = False
        self.is_changing_tool = False
        self._macros = 0

    @property
    def is_in_macro(self) -> bool:
        return self._macros != 0

    @contextlib.contextmanager
    def running_macro(self, channel: Channel) -> Iterator[None]:
        """While this is entered the board is busy, and the channel in a macro."""
        self._macros += 1
        # a macro's lines take the place of the one that it was called on (seen in firmware)
        channel.pending.clear()
        channel.macros += 1
        try:
            yield
        finally:
            self._macros -= 1
            channel.macros -= 1
