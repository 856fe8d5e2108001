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
    while not is_free(port := random.choice(CANDIDATES)):
        pass
    return port


def is_free(port: int) -> bool:
    """Return whether a server could listen on that port of the loopback address."""
    with socket.socket() as probe:
        # as servers do it: a connection that has just ended doesn't keep its port
        probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
        return True
