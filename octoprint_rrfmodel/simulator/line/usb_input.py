"""Bytes from the host, cut into lines for the USB channel."""

from __future__ import annotations

from typing import Callable, NamedTuple

from ..clock import Clock
from .channel import Channel

RECEIVE_BUFFER = 512
"""Bytes that the board takes from USB while it is busy; the host has to wait with the rest."""


class Received(NamedTuple):
    """A line as it came in on USB."""

    time: float
    text: str
    said: int = 0
    """Bytes that the board had said by then."""


class UsbInput:
    """The receive buffer in front of the USB channel, and the log of what has come in."""

    def __init__(self, clock: Clock, channel: Channel):
        self.takes: Callable[[str, bool], bool] | None = None
        """Called with a line and whether the input has room, says whether it is done with."""
        self.said: Callable[[], int] = int
        """Returns the bytes that the board has said."""
        self._clock = clock
        self._channel = channel
        self._bytes = bytearray()
        self.log: list[Received] = []

    @property
    def has_room(self) -> bool:
        """Whether the board takes further bytes; a busy channel leaves them in its buffer."""
        waiting = len(self._bytes) + sum(len(line) + 1 for line in self._channel.lines)
        return waiting < RECEIVE_BUFFER

    def receive(self, data: bytes) -> None:
        """Take bytes, and cut them at CR, LF and NUL, each of which ends a line."""
        self._bytes += data
        for end in (b"\r", b"\x00"):
            if end in self._bytes:
                self._bytes = self._bytes.replace(end, b"\n")
        *lines, rest = self._bytes.split(b"\n")
        if not lines:
            return
        self._bytes = rest
        for line in lines:
            if line:
                text = line.decode("utf-8", "surrogateescape")
                self.log.append(Received(self._clock.now, text, self.said()))
                if self.takes is not None and self.takes(text, self.has_room):
                    continue
                self._channel.lines.append(text)

    def discard(self) -> None:
        """Forget the beginning of a line."""
        self._bytes.clear()
