"""The web server of a board on its own: responders, their deadlines, and a connection for each
request (RRF 3.5 HttpResponder.cpp, Socket.h; seen in firmware).
"""

from __future__ import annotations

import socket
import threading

from ..acceptor import TICK_SECONDS, AtBoard
from ..connection import RECEIVE_SECONDS, UPLOAD_SECONDS, Connection
from ..delivery import Delivery
from ..waiting import awaited
from .answers import rejection
from .request_parser import Rejected, Request, read_request
from .standalone import Outcome, RunningUpload, Standalone

MOST_SOCKETS = 8
FIND_RESPONDER_SECONDS = 2.0


class HttpServer:
    """Serves one board; ``at_board`` is entered where the board is used."""

    def __init__(
        self,
        board: Standalone,
        delivery: Delivery,
        *,
        responders: int,
        at_board: AtBoard,
        ended: threading.Event,
    ):
        self._board = board
        self._delivery = delivery
        self._responders = threading.BoundedSemaphore(responders)
        self._sockets = threading.BoundedSemaphore(MOST_SOCKETS)
        self._at_board = at_board
        self._ended = ended

    def converse(self, client: socket.socket, address: str) -> None:
        """Keep a connection until it has ended."""
        connection = Connection(client)
        if not self._sockets.acquire(blocking=False):
            connection.reset()
            return
        self._converse(connection, address)

    def _converse(self, connection: Connection, address: str) -> None:
        try:
            if not self._find_responder():
                connection.reset()
                return
            try:
                self._serve(connection, address)
            finally:
                self._responders.release()
            connection.finish()
        finally:
            connection.close()
            self._sockets.release()

    def _find_responder(self) -> bool:
        if self._delivery.is_busy:
            self._ended.wait(FIND_RESPONDER_SECONDS)
            return False
        return self._responders.acquire(timeout=FIND_RESPONDER_SECONDS)

    def _serve(self, connection: Connection, address: str) -> None:
        """Answer one request; whatever comes behind it isn't read."""
        if self._loses(connection):
            return
        try:
            request = self._read(connection, address)
        except Rejected as problem:
            connection.send(rejection(500, str(problem)))
            return
        if request is None:
            return
        with self._at_board():
            answer = self._delivery.instead()
        if answer is None:
            answer = self._answer(connection, request)
        if answer is None:
            return
        self._ended.wait(self._delivery.delay)
        if self._loses(connection):
            return
        with self._at_board():
            delivered = self._delivery.of(answer, request.path)
        is_taken = connection.send(delivered.data)
        if delivered.is_reset or not is_taken:
            connection.reset()

    def _loses(self, connection: Connection) -> bool:
        """Return whether the network is down; then the connection is gone when it is back."""
        if not self._delivery.is_lossy:
            return False
        while self._delivery.is_lossy and not self._ended.wait(TICK_SECONDS):
            pass
        connection.reset()
        return True

    def _read(self, connection: Connection, address: str) -> Request | None:
        data = b""
        while True:
            chunk = connection.receive(RECEIVE_SECONDS)
            if chunk is None:
                connection.reset()
            if not chunk:
                return None
            data += chunk
            request = read_request(data, address)
            if request is not None:
                return request

    def _answer(self, connection: Connection, request: Request) -> bytes | None:
        with self._at_board():
            outcome = self._board.answer(request)
        if isinstance(outcome, RunningUpload):
            return self._upload(connection, outcome, request.rest)
        return self._waited_for(outcome)

    def _waited_for(self, outcome: Outcome) -> bytes | None:
        """Go on until there is an answer, and leave the board alone meanwhile."""
        if isinstance(outcome, bytes):
            return outcome
        if isinstance(outcome, RunningUpload):
            return None
        return awaited(outcome, self._at_board, self._ended)

    def _upload(self, connection: Connection, running: RunningUpload, data: bytes) -> bytes | None:
        try:
            while True:
                with self._at_board():
                    if data:
                        running.receive(self._delivery.received(data))
                    if running.upload.is_complete:
                        return running.answer()
                chunk = connection.receive(UPLOAD_SECONDS)
                if not chunk or self._loses(connection):
                    with self._at_board():
                        running.upload.abandon()
                    if chunk is None:
                        connection.reset()
                    return None
                data = chunk
        finally:
            running.end()
