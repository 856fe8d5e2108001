"""A request's first bytes read as the firmware reads them (RRF 3.5 HttpResponder.cpp:157-456)."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import NamedTuple

MOST_WORDS = 4
MOST_PARAMETERS = 5
MOST_HEADERS = 29
ROOM = 1463
"""Bytes that first line and headers may take, decoded, each item with its NUL."""
RAW_ROOM = 3 * ROOM + 1024
"""Nothing that fits is longer before it is decoded."""
HOST = "http://"

_END = re.compile(rb"\n\r?\n")
_ESCAPE = re.compile(r"%(.{0,2})", re.DOTALL)
_HEX = re.compile(r"[0-9A-F]{2}")
"""Lower-case digits aren't understood (seen in firmware)."""


class Rejected(Exception):
    """The request can't be read; the text is what the firmware says of it."""


class Request(NamedTuple):
    """A request as far as its headers."""

    method: str
    path: str
    parameters: Mapping[str, str]
    headers: Mapping[str, str]
    address: str = ""
    """Of who asks."""
    rest: bytes = b""
    """What came with the headers behind them."""

    def parameter(self, name: str) -> str | None:
        """Return a parameter, whose name is in lower case; ``None`` where it isn't given."""
        return self.parameters.get(name)

    def number(self, name: str) -> int:
        """Return a parameter's leading digits, 0 without any."""
        found = re.match(r"\s*(\d+)", self.parameters.get(name, ""))
        return int(found.group(1)) if found else 0

    def header_number(self, name: str) -> int | None:
        """Return a header's digits, ``None`` where there are none."""
        found = re.match(r"\s*(\d+)", self.headers.get(name, ""))
        return int(found.group(1)) if found else None


def read_request(data: bytes, address: str = "") -> Request | None:
    """Return the request, ``None`` as long as its headers aren't complete."""
    end = _END.search(data)
    if end is None:
        if len(data) > RAW_ROOM:
            raise Rejected("overflow")
        return None
    lines = data[: end.start()].decode("utf-8", "surrogateescape").split("\n")
    words, parameters = _first_line(lines[0].rstrip("\r"))
    headers = _headers([line.rstrip("\r") for line in lines[1:]])
    items = [*words, *parameters, *parameters.values(), *headers, *headers.values()]
    if sum(len(item.encode("utf-8", "surrogateescape")) + 1 for item in items) > ROOM:
        raise Rejected("overflow")
    return Request(words[0], words[1], parameters, headers, address, data[end.end() :])


def _first_line(line: str) -> tuple[list[str], dict[str, str]]:
    words = [word for word in re.split(r"[ \t]", line) if word]
    if len(words) < 2:
        raise Rejected("too few command words")
    path, mark, qualifiers = words[1].partition("?")
    words[1] = _unescaped(_without_host(path))
    parameters = _parameters(qualifiers) if mark and qualifiers else {}
    if len(words) > MOST_WORDS:
        raise Rejected("too many command words")
    return words, parameters


def _without_host(path: str) -> str:
    """Only ``http://`` is known; any other is the name of a file (seen in firmware)."""
    if not path.startswith(HOST):
        return path
    _, slash, rest = path[len(HOST) :].partition("/")
    if not slash:
        raise Rejected("invalid absolute URI")
    return slash + rest


def _parameters(text: str) -> dict[str, str]:
    found: dict[str, str] = {}
    for count, part in enumerate(text.split("&")):
        if count >= MOST_PARAMETERS:
            raise Rejected("too many keys in qualifier")
        key, equals, value = part.partition("=")
        if not equals or "%" in key:
            raise Rejected("bad qualifier key")
        value = _unescaped(value.replace("+", " "))
        found.setdefault(key.lower(), value.partition("\0")[0])
    return found


def _unescaped(text: str) -> str:
    if "%" not in text:
        return text
    if not all(_HEX.fullmatch(digits) for digits in _ESCAPE.findall(text)):
        raise Rejected("bad escape")
    data = re.sub(
        rb"%([0-9A-F]{2})",
        lambda found: bytes([int(found.group(1), 16)]),
        text.encode("utf-8", "surrogateescape"),
    )
    return data.decode("utf-8", "surrogateescape")


def _headers(lines: list[str]) -> dict[str, str]:
    found: dict[str, str] = {}
    last = ""
    for line in lines:
        if line[:1] in (" ", "\t") and last:
            found[last] += line
            continue
        key, colon, value = line.partition(":")
        if not colon:
            raise Rejected("unexpected newline")
        if len(found) >= MOST_HEADERS:
            raise Rejected("too many header key-value pairs")
        last = key.strip().lower()
        found[last] = value.strip()
    return found
