"""Takes connections while the board does, and lets the board's time go on meanwhile."""

from __future__ import annotations

import socket
import threading
from contextlib import AbstractContextManager
from typing import Callable

from .connection import Connection
from .listener import Listener

AtBoard = Callable[[], AbstractContextManager[object]]
"""Entered where the board is used: nobody else has it, and it does at once what it was told."""
TICK_SECONDS = 0.05


class Acceptor:
    """Gives each connection to ``converse``, on a thread of its own."""

    def __init__(
        self,
        listener: Listener,
        *,
        at_board: AtBoard,
        is_up: Callable[[], bool],
        ended: threading.Event,
    ):
        self._listener = listener
        self._at_board = at_board
        self._is_up = is_up
        self._ended = ended
        self._converse: Callable[[socket.socket, str], None] | None = None
        self._thread = threading.Thread(
            target=self._listen, name="simulated board's web server", daemon=True
        )

    def start(self, converse: Callable[[socket.socket, str], None]) -> None:
        """Take connections from now on."""
        self._converse = converse
        self._listener.open()
        self._thread.start()

    def stop(self) -> None:
        """Take no more; those under way end by themselves."""
        self._ended.set()
        self._thread.join()
        self._listener.release()

    def _listen(self) -> None:
        while not self._ended.is_set():
            if not self._takes_connections():
                self._listener.close()
                self._ended.wait(TICK_SECONDS)
                continue
            self._listener.open()
            accepted = self._listener.accept(TICK_SECONDS)
            if accepted is None:
                continue
            if not self._takes_connections():
                Connection(accepted[0]).reset()
                continue
            threading.Thread(
                target=self._converse,
                args=accepted,
                name="simulated board's connection",
                daemon=True,
            ).start()

    def _takes_connections(self) -> bool:
        with self._at_board():
            return self._is_up()
