"""G-code through DSF: one text after the other, and each with its own reply."""

from __future__ import annotations

import re
from collections import deque
from typing import Callable

from ...line.channel import Channel
from .messages import Messages

_PAST_THE_QUEUE = re.compile(r"\s*[Mm](?:108|112|122|292|999)(?!\d)")
"""What doesn't wait for what runs (DSF SimpleCode.cs)."""


class Code:
    """A text that was sent, until it has been run."""

    def __init__(self, lines: list[str], is_awaited: bool):
        self.lines = lines
        self.is_awaited = is_awaited
        self.pieces: list[str] = []
        self.is_done = False

    @property
    def reply(self) -> str:
        """What it has been answered with, nothing where that is empty."""
        return "".join(piece for piece in self.pieces if piece.strip()).rstrip("\n")


class Codes:
    """Runs texts on two channels: one in order, the other for what doesn't wait."""

    def __init__(self, in_order: Channel, at_once: Channel, messages: Messages):
        self._messages = messages
        self._queues = {
            name: _Queue(channel, messages)
            for name, channel in (("in order", in_order), ("at once", at_once))
        }
        self.takers: dict[str, Callable[[str], bool]] = {
            in_order.name: self._queues["in order"].replied,
            at_once.name: self._queues["at once"].replied,
        }
        """Channel → who is given its replies."""

    def add(self, text: str, is_awaited: bool) -> Code:
        """Queue a text of one or more lines."""
        lines = [line for line in text.splitlines() if line.strip()]
        is_urgent = bool(lines) and all(_PAST_THE_QUEUE.match(line) for line in lines)
        code = Code(lines, is_awaited)
        self._queues["at once" if is_urgent else "in order"].add(code)
        return code

    def pump(self) -> None:
        """Begin what can begin, and end what has ended."""
        for queue in self._queues.values():
            queue.pump()

    def forget(self) -> None:
        """End everything, as a restart of the board does."""
        for queue in self._queues.values():
            queue.forget()


class _Queue:
    def __init__(self, channel: Channel, messages: Messages):
        self._channel = channel
        self._messages = messages
        self._waiting: deque[Code] = deque()
        self._current: Code | None = None

    def add(self, code: Code) -> None:
        self._waiting.append(code)
        self.pump()

    def replied(self, text: str) -> bool:
        if self._current is not None and self._current.is_awaited:
            self._current.pieces.append(text)
        else:
            self._messages.add(text)
        return True

    def pump(self) -> None:
        if self._current is not None and self._channel.is_idle:
            self._current.is_done = True
            self._current = None
        if self._current is None and self._waiting:
            self._current = self._waiting.popleft()
            self._channel.lines.extend(self._current.lines)

    def forget(self) -> None:
        for code in [self._current, *self._waiting]:
            if code is not None:
                code.is_done = True
        self._current = None
        self._waiting.clear()
