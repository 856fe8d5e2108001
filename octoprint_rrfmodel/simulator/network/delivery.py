"""How answers get to their clients: the faults of the network."""

from __future__ import annotations

from typing import NamedTuple

from ..line.switches import FaultSwitches
from .rr.answers import JSON, OUT_OF_BUFFERS

_FOREIGN_PAGE = b"<html><body>Log in to this hotel's network</body></html>"
FOREIGN = (
    b"HTTP/1.1 200 OK\r\nContent-Type: text/html\r\n"
    b"Content-Length: %d\r\nConnection: close\r\n\r\n%s" % (len(_FOREIGN_PAGE), _FOREIGN_PAGE)
)
REDIRECT = (
    b"HTTP/1.1 302 Found\r\nLocation: http://192.0.2.1/elsewhere\r\nContent-Length: 0\r\n"
    b"Connection: close\r\n\r\n"
)
_INSTEAD = {"net_503": OUT_OF_BUFFERS, "net_foreign": FOREIGN, "net_redirect": REDIRECT}
"""Fault → what is answered in the place of the board; the request isn't carried out."""
_HEAD_END = b"\r\n\r\n"
_COMMANDS = ("rr_gcode", "machine/code")
"""What the paths of requests end with that carry G-code."""


class Delivered(NamedTuple):
    """What gets through of an answer."""

    data: bytes
    is_reset: bool = False
    """Whether the connection is reset behind it."""


class Delivery:
    """Looks at the faults that are on; hold the board's lock."""

    def __init__(self, faults: FaultSwitches):
        self._faults = faults

    def instead(self) -> bytes | None:
        """Return what is answered without asking the board, ``None`` where it is asked."""
        for name, data in _INSTEAD.items():
            if self._faults.take(name):
                return data
        return None

    def of(self, answer: bytes, path: str) -> Delivered:
        """Return what of the board's answer to a request for ``path`` gets through."""
        is_command = path.lower().endswith(_COMMANDS)
        if is_command and self._faults.take("net_lost_command"):
            return Delivered(b"", is_reset=True)
        if self._faults.take("net_lost_answer"):
            return Delivered(b"", is_reset=True)
        if self._faults.take("net_reset"):
            return Delivered(_without_end(answer), is_reset=True)
        if self._faults.take("net_cut"):
            return Delivered(_without_end(answer))
        if JSON.encode() in answer and self._faults.take("net_garbled"):
            return Delivered(_without_middle(answer))
        return Delivered(answer)

    def message(self, data: bytes) -> bytes:
        """Return what of a websocket's message gets through."""
        if self._faults.take("net_garbled"):
            return _without_middle(_HEAD_END + data)[len(_HEAD_END) :]
        return data

    @property
    def is_lossy(self) -> bool:
        return self._faults.is_on("net_loss")

    @property
    def is_busy(self) -> bool:
        return self._faults.is_on("net_busy")

    @property
    def is_refusing(self) -> bool:
        return self._faults.is_on("net_refused")

    @property
    def delay(self) -> float:
        """Seconds by which answers are late."""
        return self._faults.number("net_slow")

    def received(self, data: bytes) -> bytes:
        """Return what of an upload's bytes gets through."""
        if data and self._faults.take("net_corrupt"):
            return bytes([data[0] ^ 1]) + data[1:]
        return data


def _without_end(answer: bytes) -> bytes:
    """Return headers and half of what they announce."""
    head, end, body = answer.partition(_HEAD_END)
    return head + end + body[: len(body) // 2]


def _without_middle(answer: bytes) -> bytes:
    """Return an answer of the same length in which a part has become blanks."""
    head, end, body = answer.partition(_HEAD_END)
    third = len(body) // 3
    return head + end + body[:third] + b" " * third + body[2 * third :]
