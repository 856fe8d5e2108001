"""Requests to one board: a new connection each, in one piece, with an end in sight.

No proxy of the environment is asked, no redirect followed, and a name is looked up once: who is
asked is who was meant. What goes wrong is told without the request: a path may hold a password.
"""

import http.client
import io
import math
import socket
import ssl
import time
from typing import NamedTuple

HEADER_BYTES = 8 * 1024
"""Most that a board's headers may be together."""

CONNECT_SECONDS = 4.0

IDLE_SECONDS = 9.0
"""Time without a byte after which a transfer is lost; a board gives up after eight."""

PIECE = 64 * 1024

ALIVE = (
    ((socket.SOL_SOCKET, socket.SO_KEEPALIVE), 1),
    *(
        ((socket.IPPROTO_TCP, getattr(socket, name)), value)
        for name, value in (("TCP_KEEPIDLE", 15), ("TCP_KEEPINTVL", 5), ("TCP_KEEPCNT", 4))
        if hasattr(socket, name)
    ),
)
"""By which the end of who vanished is noticed where an answer may take as long as it takes."""


class Unreachable(Exception):
    """The board gave no answer, or none that is one; says why in a few words."""


class NotConnected(Unreachable):
    """Nothing of the request has left."""


class Answer(NamedTuple):
    """What came back."""

    status: int
    body: bytes


class _Raw(io.RawIOBase):
    """A socket to read from until a deadline, and no more than so many bytes."""

    def __init__(self, connected, deadline, most):
        self.connected = connected
        self._deadline = deadline
        self._left = most

    def readable(self):
        return True

    def readinto(self, buffer):
        remaining = self._deadline() - time.monotonic()
        if remaining <= 0:
            raise TimeoutError("the time is over")
        is_endless = remaining == math.inf
        if self._left <= 0:
            raise Unreachable("more was answered than makes sense")
        self.connected.settimeout(None if is_endless else remaining)
        count = self.connected.recv_into(memoryview(buffer)[: min(len(buffer), self._left)])
        self._left -= count
        return count

    def close(self):
        if not self.closed:
            self.connected.close()
        super().close()


class _Wire:
    """What ``http.client`` takes for a socket; it is closed by whoever has read from it."""

    def __init__(self, connected, raw):
        self._raw = raw
        self.sendall = connected.sendall

    def close(self):
        """Leave it open: a response still reads from it."""

    def makefile(self, *_):
        """Return the file to read from."""
        return io.BufferedReader(self._raw)


class _Connection(http.client.HTTPConnection):
    """A connection that is made already, for one request."""

    def __init__(self, address, wire):
        super().__init__(address.host, address.port)
        self.sock = wire

    def connect(self):
        raise Unreachable("the connection is over")


class Transport:
    """Asks the board at an address (``address.Address``); any thread may.

    ``resolve(host, port)`` looks a name up: the places that it means, the likeliest first.
    """

    def __init__(self, address, resolve=None):
        self.address = address
        self._resolve = resolve or _resolve
        self._found = None

    def get(self, path, headers, *, seconds, most):
        """Return the answer; ``Unreachable`` where there is none in time."""
        end = time.monotonic() + seconds
        return self._exchange("GET", path, headers, deadline=lambda: end, most=most)

    def post(self, path, headers, body, told=None):
        """Send a file and return the answer; ``told(count)`` after each piece that has left."""
        return self._exchange(
            "POST", path, headers, deadline=_idle(), most=64 * 1024, body=body, told=told
        )

    def send(self, method, path, headers, body=None, *, most, end=None, told=None):
        """Send a request of any method, with bytes or a file, and return the answer.

        ``end`` is the time until which it may take, infinite for one that takes as long as it
        takes; without it only time without a byte counts.
        """
        deadline = _idle() if end is None else lambda: end
        return self._exchange(
            method, path, headers, deadline=deadline, most=most, body=body, told=told
        )

    def open(self, path, headers, most):
        """Return the response to read a file from; whoever gets it closes it."""
        return self._respond("GET", path, headers, raw=self._connect(_idle(), most))

    def _exchange(self, method, path, headers, *, deadline, most, **body):
        raw = self._connect(deadline, most)
        with raw, self._respond(method, path, headers, raw=raw, **body) as response:
            try:
                return Answer(response.status, response.read())
            except _FAILURES as error:
                raise Unreachable(_why(error)) from None

    def _respond(self, method, path, headers, *, raw, body=None, told=None):
        connection = _Connection(self.address, _Wire(raw.connected, raw))
        try:
            # a body in pieces goes behind the headers, which are one write
            pieces = None if body is None else _pieces(body, told)
            connection.request(method, path, body=pieces, headers=headers)
            return connection.getresponse()
        except _FAILURES as error:
            raw.close()
            raise Unreachable(_why(error)) from None

    def _connect(self, deadline, most):
        try:
            return _Raw(self.connected(), deadline, most + HEADER_BYTES)
        except _FAILURES as error:
            raise NotConnected(_why(error)) from None

    def connected(self):
        """Return a connection on which nothing was said yet; raises what sockets raise."""
        address = self.address
        found = self._found or self._resolve(address.host, address.port)
        for number, place in enumerate(found, 1):
            try:
                connected = socket.create_connection(place, timeout=CONNECT_SECONDS)
            except OSError:
                if number == len(found):
                    raise
                continue
            # whom the name means now is whom it means as long as this lasts
            self._found = (place,)
            return self._made_ready(connected)
        raise socket.gaierror

    def _made_ready(self, connected):
        try:
            connected.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            for option, value in ALIVE:
                connected.setsockopt(*option, value)
            connected.settimeout(IDLE_SECONDS)
            if self.address.scheme == "https":
                context = ssl.create_default_context()
                return context.wrap_socket(connected, server_hostname=self.address.host)
        except BaseException:
            connected.close()
            raise
        return connected


_FAILURES = (OSError, http.client.HTTPException, ValueError)


def _resolve(host, port):
    found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    # boards have addresses of the fourth version
    found.sort(key=lambda each: each[0] != socket.AF_INET)
    return tuple(each[4][:2] for each in found)


def _idle():
    """Return a deadline that moves on with each look: time without a byte is what counts."""
    return lambda: time.monotonic() + IDLE_SECONDS


def _pieces(body, told):
    sent = 0
    body = io.BytesIO(body) if isinstance(body, bytes) else body
    while True:
        piece = body.read(PIECE)
        if not piece:
            return
        yield piece
        sent += len(piece)
        if told is not None:
            told(sent)


def _why(error):
    """Return what went wrong, without what was asked."""
    if isinstance(error, socket.gaierror):
        return "its name is not known"
    if isinstance(error, (TimeoutError, socket.timeout)):
        return "no answer in time"
    if isinstance(error, ConnectionRefusedError):
        return "it refuses connections"
    if isinstance(error, ssl.SSLError):
        return "its certificate is not trusted"
    return type(error).__name__
