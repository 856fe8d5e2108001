"""What a person may write where a board's address is asked for."""

import ipaddress
import re
from typing import NamedTuple

DEFAULT_PORTS = {"http": 80, "https": 443}

_PARTS = re.compile(
    r"(?:(?P<scheme>https?)://)?"
    r"(?:\[(?P<six>[0-9A-Fa-f:.]+)\]|(?P<name>[^\s:/?#@\[\]\\%]+))"
    r"(?::(?P<port>[0-9]{1,5}))?/?"
)
"""Nothing but these: no path, no user, no query. A slash at the end is what browsers show."""

_LABEL = r"(?:\w|\w[\w-]{0,61}\w)"

_NAME = re.compile(rf"(?=.{{1,253}}\Z){_LABEL}(?:\.{_LABEL})*\.?")


class Address(NamedTuple):
    """Where a board is."""

    scheme: str
    host: str
    """A name or an address, one of the sixth version without brackets."""
    port: int

    @property
    def text(self):
        """The shortest form that means the same."""
        host = f"[{self.host}]" if ":" in self.host else self.host
        scheme = "" if self.scheme == "http" else f"{self.scheme}://"
        port = "" if self.port == DEFAULT_PORTS[self.scheme] else f":{self.port}"
        return f"{scheme}{host}{port}"


def address_of(text):
    """Return the address that a text is, ``None`` where it is anything else."""
    text = text.strip() if isinstance(text, str) else ""
    if _is_six(text):
        text = f"[{text}]"
    found = _PARTS.fullmatch(text)
    if found is None:
        return None
    scheme = found["scheme"] or "http"
    host = found["six"] or found["name"].lower()
    if not (_is_six(host) if found["six"] else _NAME.fullmatch(host)):
        return None
    port = int(found["port"] or DEFAULT_PORTS[scheme])
    return Address(scheme, host, port) if 0 < port < 65536 else None


def _is_six(text):
    try:
        ipaddress.IPv6Address(text)
    except ValueError:
        return False
    return True


def is_place(text):
    """Return whether a board may be at what a text says; boards have addresses of version four."""
    try:
        found = ipaddress.IPv4Address(text)
    except ValueError:
        return False
    return not (found.is_multicast or found.is_unspecified or found.is_reserved)
