"""TCP ports that nobody listens on."""

from __future__ import annotations

import random
import socket

# below the range from which the kernel takes ports for outgoing connections (32768 on Linux)
CANDIDATES = range(20000, 32000)


def free_port() -> int:
    """Return a port of the loopback address that could be bound a moment ago.

    Test processes choose at the same time, hence at random and not the lowest one.
    """
    while True:
        port = random.choice(CANDIDATES)
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                continue
            return port
