"""Frames of websockets, the server's side (RFC 6455)."""

from __future__ import annotations

import base64
import hashlib
import struct
from typing import Callable, NamedTuple

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10
GOING_AWAY, UNSUPPORTED, INVALID, FAILED = 1001, 1003, 1007, 1011
_GUID = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
_FINAL, _MASKED = 0x80, 0x80
_TWO_BYTES, _EIGHT_BYTES = 126, 127
MOST_BYTES = 65536


class Frame(NamedTuple):
    """What came in one frame."""

    kind: int
    data: bytes


def accepted(key: str) -> str:
    """Return what a handshake is answered with."""
    return base64.b64encode(hashlib.sha1((key + _GUID).encode()).digest()).decode()


def framed(kind: int, data: bytes) -> bytes:
    """Return the bytes of a frame, which servers don't mask."""
    if len(data) < _TWO_BYTES:
        length = bytes([len(data)])
    elif len(data) <= 0xFFFF:
        length = bytes([_TWO_BYTES]) + struct.pack(">H", len(data))
    else:
        length = bytes([_EIGHT_BYTES]) + struct.pack(">Q", len(data))
    return bytes([_FINAL | kind]) + length + data


def closing(code: int, reason: str = "") -> bytes:
    """Return the frame that ends a websocket."""
    return framed(CLOSE, struct.pack(">H", code) + reason.encode())


def read_frame(read: Callable[[int], bytes]) -> Frame | None:
    """Return the next frame, ``None`` at the end; ``read`` returns so many bytes, or fewer."""
    head = read(2)
    if len(head) < 2:
        return None
    length = head[1] & ~_MASKED
    if length == _TWO_BYTES:
        (length,) = struct.unpack(">H", read(2))
    elif length == _EIGHT_BYTES:
        (length,) = struct.unpack(">Q", read(8))
    if length > MOST_BYTES:
        return None
    mask = read(4) if head[1] & _MASKED else b"\0\0\0\0"
    data = read(length)
    if len(data) < length or len(mask) < 4:
        return None
    return Frame(head[0] & 0x0F, bytes(b ^ mask[i % 4] for i, b in enumerate(data)))
