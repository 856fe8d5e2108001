"""The bytes of answers, header by header as the firmware writes them (seen in firmware)."""

from __future__ import annotations

from ...text.letters import utf8

UNCACHED = (
    "Cache-Control: no-cache, no-store, must-revalidate\r\nPragma: no-cache\r\nExpires: 0\r\n"
)
CLOSED = "Connection: close\r\n"
OUT_OF_BUFFERS = b"HTTP/1.1 503 Service Unavailable\r\n\r\n"
JSON, TEXT, UNKNOWN = "application/json", "text/plain", "application/octet-stream"

TYPES = {
    "png": "image/png",
    "ico": "image/x-icon",
    "js": "application/javascript",
    "css": "text/css",
    "htm": "text/html",
    "html": "text/html",
    "zip": "application/zip",
    "g": TEXT,
    "gc": TEXT,
    "gcode": TEXT,
}
"""Ending of a name → type; any other is :data:`UNKNOWN`."""

_REJECTION = (
    "<html>\n<head>\n</head>\n<body>\n"
    '<p style="font-size: 16pt; text-align: center; margin-top:50px">'
    "Your Duet rejected the HTTP request: {}</p>\n</body>\n"
)


def type_of(name: str) -> str:
    """Return the type of a file by its name."""
    return TYPES.get(name.rpartition(".")[2].lower(), UNKNOWN)


def _allowed(site: str) -> str:
    return f"Access-Control-Allow-Origin: {site}\r\n" if site else ""


def text_answer(text: str, site: str = "", kind: str = JSON) -> bytes:
    """Return an answer of that text; ``site`` is the site of foreign pages that may ask."""
    body = utf8(text)
    head = (
        f"HTTP/1.1 200 OK\r\n{UNCACHED}Content-Type: {kind}\r\nContent-Length: {len(body)}\r\n"
        f"{_allowed(site)}{CLOSED}\r\n"
    )
    return head.encode() + body


def error_answer(number: int, site: str = "") -> bytes:
    """Return ``{"err":n}``."""
    return text_answer(f'{{"err":{number}}}', site)


def file_answer(name: str, content: bytes, site: str = "") -> bytes:
    """Return a file of the card."""
    head = (
        f"HTTP/1.1 200 OK\r\n{UNCACHED}{_allowed(site)}Content-Type: {type_of(name)}\r\n"
        f"Content-Length: {len(content)}\r\n{CLOSED}\r\n"
    )
    return head.encode() + content


def page_answer(name: str, content: bytes, is_packed: bool) -> bytes:
    """Return a file of the web interface."""
    packed = "Content-Encoding: gzip\r\n" if is_packed else ""
    head = (
        f"HTTP/1.1 200 OK\r\nContent-Type: {type_of(name)}\r\n{packed}"
        f"Content-Length: {len(content)}\r\n{CLOSED}\r\n"
    )
    return head.encode() + content


def rejection(status: int, text: str, site: str = "") -> bytes:
    """Return a refusal, whose end is that of the connection."""
    head = f"HTTP/1.1 {status} {text}\r\n{CLOSED}{_allowed(site)}\r\n"
    return f"{head}{_REJECTION.format(text)}".encode()


def options(site: str, has_keys: bool) -> bytes:
    """Return what OPTIONS is answered with."""
    head = (
        f"HTTP/1.1 204 No Content\r\nAllow: OPTIONS, GET, POST\r\n{UNCACHED}Content-Length: 0\r\n"
    )
    if site:
        key = ", X-Session-Key" if has_keys else ""
        head += f"Access-Control-Allow-Headers: Content-Type{key}\r\n{_allowed(site)}"
    return f"{head}\r\n".encode()
