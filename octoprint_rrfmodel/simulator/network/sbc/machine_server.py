"""DSF's web server: connections that stay open, and websockets."""

from __future__ import annotations

import contextlib
import fnmatch
import http.server
import io
import socket
import threading
from collections.abc import Mapping
from typing import Any, Callable
from urllib.parse import urlsplit

from ...device.network_access import NetworkAccess
from ..acceptor import TICK_SECONDS, AtBoard
from ..connection import Connection
from ..delivery import Delivery
from ..waiting import awaited
from .frames import accepted
from .machine_request import MachineAnswer, MachineOutcome, MachineRequest
from .model_socket import ModelSocket
from .routes import PREFIX, Routes

IDLE_SECONDS = 130.0
"""Kestrel keeps a connection for so long."""
CONTINUE = b"HTTP/1.1 100 Continue\r\n\r\n"
SOCKET_PATH = PREFIX.rstrip("/")


class UnreadableBody(Exception):
    """Nobody can tell where the body of a request ends."""


class _Reader(http.server.BaseHTTPRequestHandler):
    """Reads requests; ``serve`` answers each and says whether the connection goes on."""

    protocol_version = "HTTP/1.1"
    timeout = IDLE_SECONDS

    def __init__(self, client: socket.socket, address: str, serve: Callable[[_Reader], bool]):
        self.serve = serve
        super().__init__(client, (address, 0), None)  # type: ignore[arg-type]

    def handle_one_request(self) -> None:
        self.close_connection = True
        try:
            self.raw_requestline = self.rfile.readline(65537)
            if self.raw_requestline and self.parse_request():
                self.close_connection = not self.serve(self)
        except (OSError, UnreadableBody):
            self.close_connection = True

    def handle_expect_100(self) -> bool:
        self.wfile.write(CONTINUE)
        return True

    def log_message(self, format: str, *args: Any) -> None:
        """Say nothing: URLs have passwords in them."""

    def body(self) -> bytes:
        """Return what comes behind the headers."""
        if (self.headers.get("Transfer-Encoding") or "").lower() == "chunked":
            return self._chunks()
        length = self.headers.get("Content-Length") or "0"
        if not length.isdecimal():
            raise UnreadableBody(length)
        return self._exactly(int(length))

    def _exactly(self, count: int) -> bytes:
        data = self.rfile.read(count)
        if len(data) < count:
            raise ConnectionError("the connection ended within a body")
        return data

    def _chunks(self) -> bytes:
        whole = io.BytesIO()
        while True:
            size = _size_of(self.rfile.readline())
            if not size:
                while self.rfile.readline().strip():
                    pass
                return whole.getvalue()
            whole.write(self._exactly(size))
            self.rfile.readline()


def _size_of(line: bytes) -> int:
    try:
        return int(line.split(b";")[0].strip() or b"0", 16)
    except ValueError as problem:
        raise UnreadableBody(line) from problem


class MachineServer:
    """Serves the computer in front of a board."""

    def __init__(
        self,
        routes: Routes,
        delivery: Delivery,
        *,
        access: NetworkAccess,
        at_board: AtBoard,
        model: Callable[[], dict[str, Any]],
        ended: threading.Event,
    ):
        self._routes = routes
        self._delivery = delivery
        self._access = access
        self._at_board = at_board
        self._model = model
        self._ended = ended

    def converse(self, client: socket.socket, address: str) -> None:
        """Keep a connection until it has ended."""
        with contextlib.closing(client):
            _Reader(client, address, self._serve)

    def _serve(self, reader: _Reader) -> bool:
        if self._loses(reader):
            return False
        address = reader.client_address[0]
        parts = urlsplit(reader.path)
        headers = {name.lower(): value for name, value in reader.headers.items()}
        if parts.path == SOCKET_PATH and reader.command == "GET":
            request = MachineRequest("GET", parts.path, parts.query, headers, b"", address)
            self._open_socket(reader, request)
            return False
        keeps_open = not reader.close_connection and headers.get("connection") != "close"
        body = self._received(reader)
        request = MachineRequest(reader.command, parts.path, parts.query, headers, body, address)
        with self._at_board():
            data = self._delivery.instead()
        if data is None:
            data = self._answer(request).data(keeps_open)
        return self._deliver(reader, data, parts.path) and keeps_open

    def _received(self, reader: _Reader) -> bytes:
        body = reader.body()
        with self._at_board():
            return self._delivery.received(body)

    def _deliver(self, reader: _Reader, data: bytes, path: str) -> bool:
        """Send what gets through; return whether the connection may go on."""
        self._ended.wait(self._delivery.delay)
        if self._loses(reader):
            return False
        with self._at_board():
            delivered = self._delivery.of(data, path)
        reader.wfile.write(delivered.data)
        if delivered.is_reset:
            Connection(reader.connection).reset()
        return delivered.data == data

    def _loses(self, reader: _Reader) -> bool:
        """Return whether the network is down; then the connection is gone when it is back."""
        if not self._delivery.is_lossy:
            return False
        while self._delivery.is_lossy and not self._ended.wait(TICK_SECONDS):
            pass
        Connection(reader.connection).reset()
        return True

    def _answer(self, request: MachineRequest) -> MachineAnswer:
        with self._at_board():
            key = request.headers.get("x-session-key")
            session = self._routes.session(key, request.address)
            outcome = self._routes.answer(request)
            if session is not None:
                session.uses += 1
        try:
            return self._waited_for(outcome)
        finally:
            if session is not None:
                session.uses -= 1

    def _waited_for(self, outcome: MachineOutcome) -> MachineAnswer:
        if isinstance(outcome, MachineAnswer):
            return outcome
        return awaited(outcome, self._at_board, self._ended)

    def _open_socket(self, reader: _Reader, request: MachineRequest) -> None:
        key = request.headers.get("sec-websocket-key")
        session = self._routes.session(request.parameter("sessionKey"), request.address)
        refused = self._refusal(request, key, session is None)
        if refused or key is None or session is None:
            reader.wfile.write(MachineAnswer(refused or 400).data(False))
            return
        reader.wfile.write(
            b"HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            b"Sec-WebSocket-Accept: " + accepted(key).encode() + b"\r\n\r\n"
        )
        reader.connection.settimeout(None)
        session.uses += 1
        try:
            ModelSocket(
                reader.connection,
                at_board=self._at_board,
                model=self._model,
                trouble=lambda: self._routes.trouble,
                delivery=self._delivery,
                ended=self._ended,
            ).converse()
        finally:
            session.uses -= 1

    def _refusal(self, request: MachineRequest, key: str | None, is_stranger: bool) -> int:
        """Return the status of a handshake that fails, 0 for one that doesn't."""
        if key is None or request.headers.get("upgrade", "").lower() != "websocket":
            return 400
        if is_stranger or not self._is_own(request.headers):
            return 403
        return self._routes.trouble.status if self._routes.trouble else 0

    def _is_own(self, headers: Mapping[str, str]) -> bool:
        origin = headers.get("origin")
        if origin is None or urlsplit(origin).netloc == headers.get("host"):
            return True
        return bool(self._access.cors_site) and fnmatch.fnmatch(origin, self._access.cors_site)
