"""Pictures in the format QOI (qoiformat.org), which no browser shows, as PNG."""

from __future__ import annotations

import struct
import zlib

MAGIC = b"qoif"

HEADER = struct.Struct(">4sIIBB")
"""Magic, width, height, channels, colour space."""

MOST_PIXELS = 512 * 512

_RGB, _RGBA = 0xFE, 0xFF
_INDEX, _DIFFERENCE, _LUMA = range(3)
"""The two highest bits of a tag; the fourth is a run."""


class NotQoi(ValueError):
    """The bytes are no such picture, or not the whole of it."""


def png_of(data: bytes) -> bytes:
    """Return the picture as PNG with transparency; raise ``NotQoi`` where it is broken."""
    if len(data) < HEADER.size:
        raise NotQoi("no header")
    magic, width, height, _, _ = HEADER.unpack_from(data)
    if magic != MAGIC or not 0 < width * height <= MOST_PIXELS:
        raise NotQoi("no picture of a sensible size")
    try:
        pixels = _pixels(data, width * height)
    except IndexError:
        raise NotQoi("the picture ends too early") from None
    row = width * 4
    # each row of a PNG begins with its filter, which is none
    rows = b"".join(b"\0" + pixels[at : at + row] for at in range(0, len(pixels), row))
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(rows)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunk(*chunk) for chunk in chunks)


def _chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def _pixels(data: bytes, count: int) -> bytes:
    """Return the pixels as bytes of red, green, blue and opacity."""
    found = bytearray()
    most = count * 4
    seen = [b"\0\0\0\0"] * 64
    red, green, blue, opacity = 0, 0, 0, 255
    at = HEADER.size
    while len(found) < most:
        tag = data[at]
        at += 1
        repeats = 1
        if tag >= _RGB:
            red, green, blue = data[at], data[at + 1], data[at + 2]
            at += 3
            if tag == _RGBA:
                opacity = data[at]
                at += 1
        elif tag >> 6 == _INDEX:
            red, green, blue, opacity = seen[tag]
        elif tag >> 6 == _DIFFERENCE:
            red = (red + (tag >> 4 & 3) - 2) & 255
            green = (green + (tag >> 2 & 3) - 2) & 255
            blue = (blue + (tag & 3) - 2) & 255
        elif tag >> 6 == _LUMA:
            step = (tag & 63) - 32
            other = data[at]
            at += 1
            red = (red + step + (other >> 4) - 8) & 255
            green = (green + step) & 255
            blue = (blue + step + (other & 15) - 8) & 255
        else:
            repeats = (tag & 63) + 1
        pixel = bytes((red, green, blue, opacity))
        seen[(red * 3 + green * 5 + blue * 7 + opacity * 11) % 64] = pixel
        found += pixel * repeats
    return bytes(found[:most])
