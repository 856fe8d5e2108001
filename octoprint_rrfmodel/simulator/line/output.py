"""What goes out on USB: in order, late or slowly where a fault says so."""

from __future__ import annotations

from collections import deque
from typing import Callable

from ..clock import Clock
from ..text.letters import utf8
from .plug import Plug
from .switches import FaultSwitches

BITS_PER_BYTE = 10


class Output:
    """The queue of bytes that the host hasn't fetched yet."""

    def __init__(self, clock: Clock, faults: FaultSwitches, plug: Plug):
        self._clock = clock
        self._faults = faults
        self._plug = plug
        self._late: deque[tuple[float, bytes]] = deque()
        self._ready = bytearray()
        self._ready_since = 0.0
        self._line_free_at = 0.0
        self.said = 0
        """Bytes since the beginning."""
        self.listeners: list[Callable[[str], None]] = []
        """Told of what goes to everybody: the network, which is there whether USB is or not."""

    def reply(self, text: str) -> None:
        """Queue a reply with its framing; the faults get their hands on it."""
        data = self._faults.on_reply(utf8(text))
        self._append(self._clock.now + self._faults.number("slow"), data)

    def text(self, text: str) -> None:
        """Send text to everybody."""
        self.to_usb(text)
        for listener in self.listeners:
            listener(text)

    def to_usb(self, text: str) -> None:
        """Queue text that nobody asked for."""
        self._append(self._clock.now, utf8(text))

    def _append(self, due: float, data: bytes) -> None:
        if not self._plug.is_plugged_in:
            return
        if self._late:
            due = max(due, self._late[-1][0])
        if due <= self._clock.now:
            self._make_ready(due, data)
        else:
            self._late.append((due, data))

    def take(self) -> bytes:
        """Return what the host can have by now."""
        now, faults = self._clock.now, self._faults
        while self._late and self._late[0][0] <= now:
            self._make_ready(*self._late.popleft())
        if faults.is_on("stall"):
            return b""
        if faults.is_on("unread") and now - self._ready_since > faults.number("unread"):
            # RRF 3.5 Platform.cpp:1055, SERIAL_MAIN_TIMEOUT (seen in firmware)
            self._ready.clear()
        if not faults.is_on("baud"):
            data = bytes(self._ready)
            self._ready.clear()
            return data
        seconds_per_byte = BITS_PER_BYTE / max(1.0, faults.number("baud"))
        count = int(max(0.0, now - self._line_free_at) / seconds_per_byte)
        data = bytes(self._ready[:count])
        del self._ready[:count]
        self._line_free_at = self._line_free_at + count * seconds_per_byte if self._ready else now
        return data

    def _make_ready(self, since: float, data: bytes) -> None:
        if not self._ready:
            self._ready_since = since
        self._ready += data
        self.said += len(data)

    def discard(self) -> None:
        """Forget what the host hasn't fetched."""
        self._late.clear()
        self._ready.clear()
