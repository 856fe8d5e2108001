"""A listening socket that comes and goes while its port is kept."""

from __future__ import annotations

import contextlib
import select
import socket

BACKLOG = 16


class Listener:
    """Listens at an address; a port of 0 is any, and stays the same from then on."""

    def __init__(self, host: str, port: int):
        self.host = host
        self._check_that_nobody_listens(port)
        # bound and never listening: nobody else gets the port while the board is down
        self._holder = self._bound(port)
        self.port = int(self._holder.getsockname()[1])
        self._socket: socket.socket | None = None

    def _bound(self, port: int) -> socket.socket:
        result = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        try:
            result.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            if hasattr(socket, "SO_REUSEPORT"):
                result.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
            result.bind((self.host, port))
        except OSError:
            result.close()
            raise
        return result

    def _check_that_nobody_listens(self, port: int) -> None:
        """Two boards could share a port, and each would get a part of the connections."""
        with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((self.host, port))

    def open(self) -> None:
        """Take connections, if it doesn't yet."""
        if self._socket is None:
            self._socket = self._bound(self.port)
            self._socket.listen(BACKLOG)

    def close(self) -> None:
        """Refuse connections, those that nobody has taken yet as well."""
        if self._socket is not None:
            self._socket.close()
            self._socket = None

    def accept(self, seconds: float) -> tuple[socket.socket, str] | None:
        """Return a connection and where it comes from, ``None`` if none has come in that time."""
        if self._socket is None:
            return None
        ready, _, _ = select.select([self._socket], [], [], seconds)
        if ready:
            with contextlib.suppress(OSError):
                connection, address = self._socket.accept()
                return connection, str(address[0])
        return None

    def release(self) -> None:
        """Give the port back."""
        self.close()
        self._holder.close()
