"""Text to bytes, whatever came in."""

from __future__ import annotations


def utf8(text: str) -> bytes:
    """Return the bytes of a text; bytes that came in without being UTF-8 go out unchanged."""
    try:
        return text.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        return text.encode("utf-8", "replace")
