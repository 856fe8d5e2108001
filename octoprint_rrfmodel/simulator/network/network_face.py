"""What every network face of a board has: an address, and the board for oneself."""

from __future__ import annotations

import abc
import contextlib
import socket
import threading
from collections.abc import Iterator
from typing import Any, TypeVar

from ..board import Board
from .acceptor import Acceptor
from .delivery import Delivery
from .listener import Listener
from .rr.model_requests import ModelSource
from .uploads import CardWriter

Self = TypeVar("Self", bound="NetworkFace")


class NetworkFace(abc.ABC):
    """Serves a board at an address; use it with ``with``.

    Beside it the board may have a serial port or a terminal: it is the same board.
    """

    def __init__(self, board: Board, host: str, port: int):
        self.board = board
        listener = Listener(host, port)
        self.port = listener.port
        self.url = f"http://{host}:{listener.port}"
        self.delivery = Delivery(board.faults)
        self.ended = threading.Event()
        self._acceptor = Acceptor(
            listener, at_board=self.at_board, is_up=self.is_up, ended=self.ended
        )
        self.source = ModelSource(
            model=board.object_model,
            live=board.live,
            text=board.model_text,
            faults=board.faults,
        )
        self.writer = CardWriter(
            card=board.card,
            job=board.job,
            model=board.object_model,
            output=board.output,
            clock=board.clock,
        )

    def start(self: Self) -> Self:
        self._acceptor.start(self.converse)
        return self

    def stop(self) -> None:
        """End the server and give its port back."""
        self._acceptor.stop()
        with self.board.lock:
            self.unplug()

    def __enter__(self: Self) -> Self:
        return self.start()

    def __exit__(self, *exception: Any) -> None:
        self.stop()

    @abc.abstractmethod
    def converse(self, client: socket.socket, address: str) -> None:
        """Keep a connection until it has ended."""

    @abc.abstractmethod
    def unplug(self) -> None:
        """Hear no more of the board."""

    def is_up(self) -> bool:
        """Return whether connections are taken."""
        return not self.delivery.is_refusing

    @contextlib.contextmanager
    def at_board(self) -> Iterator[None]:
        """Have the board for oneself, and let it do at once what it was told."""
        with self.board.lock:
            self.board.advance()
            yield
            self.board.advance()
