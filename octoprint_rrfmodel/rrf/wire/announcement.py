"""What a board says of itself to whoever asks the network for web servers (DNS-SD).

Ethernet boards give the name of their firmware and its version (3.5 LwipEthernetInterface.cpp),
those with WiFi the name and version of their module. There is no service of their own.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

IS_BOARD = re.compile(r"duet|reprap", re.IGNORECASE)
"""In the product that a board tells."""

LONGEST_PART = 40

NOT_SHOWN = re.compile(r"[^\w .,:+/()-]")
"""A name on the network may be made of anything."""


def announced(server: str, properties: Mapping[bytes, bytes | None]) -> str | None:
    """Return in a line who announces itself, ``None`` where it is no board with RepRapFirmware.

    ``server`` is its name on the network, ``properties`` its TXT record: bytes to bytes.
    """
    product, version = (_text(properties.get(name)) for name in (b"product", b"version"))
    if not version or not IS_BOARD.search(product):
        return None
    name = _shown(server.rstrip(".").rpartition(".local")[0] or server)
    return f"{name} ({_shown(product)} {_shown(version)})"


def _text(value: bytes | None) -> str:
    return (value or b"").decode("utf-8", "replace")


def _shown(text: str) -> str:
    return NOT_SHOWN.sub("", text).strip()[:LONGEST_PART]
