"""A server that answers each connection as it is told, and keeps what it was asked."""

import contextlib
import socket
import threading
import time

from octoprint_rrfmodel.link.network.standalone import Standalone


def answer(body, status="200 OK", *headers):
    """Return the bytes of an answer as boards give them."""
    body = body.encode() if isinstance(body, str) else body
    lines = [f"HTTP/1.1 {status}", *headers, f"Content-Length: {len(body)}", "Connection: close"]
    return "\r\n".join([*lines, "", ""]).encode() + body


class StandIn:
    """Answers connections one after the other; ``reply(request)`` gives the bytes or pieces."""

    def __init__(self, reply):
        self._reply = reply
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.port = self._listening.getsockname()[1]
        self.requests = []
        self._thread = threading.Thread(target=self._run, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._listening.shutdown(socket.SHUT_RDWR)
        self._listening.close()
        self._thread.join(5)

    def _run(self):
        while True:
            try:
                connected, _ = self._listening.accept()
            except OSError:
                return
            with connected, contextlib.suppress(OSError):
                self._serve(connected)

    def _serve(self, connected):
        connected.settimeout(5)
        request = connected.recv(65536)
        self.requests.append(request)
        head, _, body = request.partition(b"\r\n\r\n")
        for line in head.decode().splitlines():
            if line.lower().startswith("content-length:"):
                missing = int(line.partition(":")[2]) - len(body)
                while missing > 0:
                    piece = connected.recv(65536)
                    missing -= len(piece)
                    body += piece
                self.requests[-1] = head + b"\r\n\r\n" + body
        reply = self._reply(self.requests[-1])
        for piece in [reply] if isinstance(reply, bytes) else reply:
            connected.sendall(piece)


def standalone(session):
    """Return the dialect of a board by itself over that session."""
    return Standalone(session, time.monotonic, wake=lambda: None)
