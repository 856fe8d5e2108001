"""A board on the network and a client that says and shows every byte; time moves when told."""

from __future__ import annotations

import contextlib
import json
import re
import socket
from urllib.parse import quote

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard

SECONDS = 20


class Said:
    """What came back over one connection."""

    def __init__(self, data, is_reset):
        self.data = data
        self.is_reset = is_reset

    @property
    def head(self):
        return self.data.partition(b"\r\n\r\n")[0].decode("latin-1")

    @property
    def body(self):
        return self.data.partition(b"\r\n\r\n")[2]

    @property
    def status(self):
        found = re.match(rb"HTTP/1.1 (\d+)", self.data)
        return int(found.group(1)) if found else None

    @property
    def json(self):
        return json.loads(self.body)


def said_to(port, data, source="127.0.0.1"):
    """Send bytes over a connection of its own; return what comes until it ends."""
    with socket.socket() as client:
        client.settimeout(SECONDS)
        client.bind((source, 0))
        client.connect(("127.0.0.1", port))
        client.sendall(data)
        return everything(client)


def everything(client):
    """Return what comes until the connection ends."""
    received = b""
    try:
        while True:
            chunk = client.recv(65536)
            if not chunk:
                return Said(received, False)
            received += chunk
    except ConnectionResetError:
        return Said(received, True)


class HttpBench:
    """A board at a free port, with a clock that moves by :meth:`wait` alone."""

    def __init__(self, machine="cartesian", firmware="3.5.3", **options):
        self.time = 0.0
        self.board = Board(machine, firmware, clock=lambda: self.time, **options)
        self.face = HttpBoard(self.board, clock=lambda: self.time)
        self.port = int(self.face.url.rpartition(":")[2])
        self.key = None

    def wait(self, seconds):
        """Let so much time pass."""
        with self.board.lock:
            self.time += seconds
            self.board.advance()

    def raw(self, data, source="127.0.0.1"):
        """Return what is said to these bytes."""
        return said_to(self.port, data, source)

    def get(self, name, /, *, session=None, source="127.0.0.1", **parameters):
        """Return what is said to ``GET /rr_<name>``."""
        text = "&".join(f"{k}={quote(str(v), safe=':/')}" for k, v in parameters.items())
        return self.raw(self._head("GET", f"/rr_{name}", text, session), source)

    def post(self, body, /, *, session=None, **parameters):
        """Return what is said to an upload."""
        text = "&".join(f"{k}={quote(str(v), safe=':/')}" for k, v in parameters.items())
        extra = f"Content-Length: {len(body)}\r\n"
        return self.raw(self._head("POST", "/rr_upload", text, session, extra) + body)

    def _head(self, method, path, text, session, extra=""):
        session = self.key if session is None else session
        header = "" if session is None else f"X-Session-Key: {session}\r\n"
        query = f"?{text}" if text else ""
        return f"{method} {path}{query} HTTP/1.1\r\nHost: x\r\n{header}{extra}\r\n".encode()

    def log_in(self, password="", **parameters):
        """Log in with a key, which goes with all that follows; return the answer."""
        answer = self.get("connect", password=password, sessionKey="yes", **parameters).json
        self.key = answer.get("sessionKey", self.key)
        return answer

    def is_refused(self):
        """Return whether the board takes no connection."""
        try:
            said = self.get("model")
        except ConnectionError:
            return True
        return said.is_reset and not said.data

    def ask(self, key="", flags=""):
        """Return the result of ``rr_model``."""
        return self.get("model", **{"key": key, "flags": flags}).json["result"]


@contextlib.contextmanager
def http_bench(*arguments, **options):
    """Return a bench for as long as it is wanted."""
    bench = HttpBench(*arguments, **options)
    with bench.face:
        yield bench
