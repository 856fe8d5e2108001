"""One connection as the firmware keeps it: one request, one answer, and it is closed."""

from __future__ import annotations

import contextlib
import socket
import struct
import time

RECEIVE_SECONDS = 2.0
"""A connection on which nothing comes for so long is reset (seen in firmware)."""
UPLOAD_SECONDS = 8.0
"""The same within an upload."""
WRITE_SECONDS = 2.0
LINGER_SECONDS = 0.5
"""What still comes behind an answer is taken for so long, so that it isn't reset."""
CHUNK = 65536


class Connection:
    """Bytes in and out; every method may be called once the other end has gone."""

    def __init__(self, connection: socket.socket):
        self._socket = connection
        with contextlib.suppress(OSError):
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)

    def receive(self, seconds: float) -> bytes | None:
        """Return what comes, nothing where the client has closed, ``None`` where time is up."""
        try:
            self._socket.settimeout(seconds)
            return self._socket.recv(CHUNK)
        except socket.timeout:
            return None
        except OSError:
            return b""

    def send(self, data: bytes) -> bool:
        """Send it all; return whether the client has taken it."""
        try:
            self._socket.settimeout(WRITE_SECONDS)
            self._socket.sendall(data)
        except OSError:
            return False
        return True

    def reset(self) -> None:
        """End it with RST."""
        with contextlib.suppress(OSError):
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        self.close()

    def finish(self) -> None:
        """End it in an orderly way."""
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_WR)
        end = time.monotonic() + LINGER_SECONDS
        while time.monotonic() < end and self.receive(LINGER_SECONDS):
            pass
        self.close()

    def close(self) -> None:
        self._socket.close()
