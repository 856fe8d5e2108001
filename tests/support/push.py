"""What OctoPrint pushes to a browser, collected from its websocket."""

from __future__ import annotations

import contextlib
import json
import threading
from typing import Any, Callable

import websocket

from .basedir import User
from .server import OctoPrintServer
from .waiting import wait_for

PLUGIN = "rrfmodel"


class PushListener:
    """A context manager that collects push messages as a logged-in user, or as nobody.

    ``messages`` holds ``(type, payload)`` in the order of arrival; types are OctoPrint's, such as
    ``current``, ``event`` and ``plugin``.
    """

    def __init__(self, server: OctoPrintServer, user: User | None) -> None:
        self.messages: list[tuple[str, Any]] = []
        self._server = server
        self._user = user
        # validating in Python takes longer than all else of a message, and decoding does it anyway
        self._socket = websocket.WebSocket(skip_utf8_validation=True)
        self._thread = threading.Thread(target=self._collect, daemon=True)

    def __enter__(self) -> PushListener:
        url = self._server.url.replace("http", "ws", 1) + "/sockjs/websocket"
        self._socket.connect(url, timeout=30)
        if self._user is not None:
            with self._server.client() as client:
                login = client.log_in(self._user)
            self._socket.send(json.dumps({"auth": f"{login['name']}:{login['session']}"}))
        self._socket.settimeout(None)
        self._thread.start()
        wait_for(lambda: self.messages, 10, "the first push message")
        if self._user is not None:
            self._wait_until_registered()
        return self

    def _wait_until_registered(self) -> None:
        """Guarantee that events from now on reach this socket.

        OctoPrint subscribes a socket to its events right after it has sent the history. One thread
        does that and takes requests, so that an answer to one says that it is through.
        """
        wait_for(lambda: "history" in dict(self.messages), 10, "the history")
        self._server.get("/api/version")

    def __exit__(self, *exc_info: object) -> None:
        self._socket.shutdown()
        self._thread.join(5)

    def _collect(self) -> None:
        # a closed socket is how listening ends
        with contextlib.suppress(websocket.WebSocketException, OSError):
            while True:
                text = self._socket.recv()
                if not text:
                    return
                self.messages.extend(json.loads(text).items())

    def of_plugin(self, plugin: str = PLUGIN) -> list[Any]:
        """Return the payloads that the plugin sent, in order."""
        return [
            payload["data"]
            for kind, payload in list(self.messages)
            if kind == "plugin" and payload["plugin"] == plugin
        ]

    def events(self, name: str | None = None) -> list[Any]:
        """Return the payloads of OctoPrint's events of that name, or of all events with theirs."""
        events = [payload for kind, payload in list(self.messages) if kind == "event"]
        if name is None:
            return [(event["type"], event["payload"]) for event in events]
        return [event["payload"] for event in events if event["type"] == name]

    def wait_for_plugin(
        self,
        predicate: Callable[[Any], bool],
        timeout: float = 10,
        what: str = "a push message",
        plugin: str = PLUGIN,
    ) -> Any:
        """Return the plugin's first payload that the predicate accepts, old ones included."""
        return wait_for(
            lambda: next(filter(predicate, self.of_plugin(plugin)), None), timeout, what
        )

    def count(self, name: str, wanted: int) -> int:
        """Return how many events of that name came, once ``wanted`` did or time is up.

        OctoPrint tells a page of an event a little later than of the state that came of it.
        """
        with contextlib.suppress(AssertionError):
            wait_for(lambda: len(self.events(name)) >= wanted, 10, f"{wanted} times {name}")
        return len(self.events(name))

    def wait_for_event(self, name: str, timeout: float = 10) -> Any:
        """Return the payload of the first event of that name; an empty one is a dictionary."""
        found = wait_for(lambda: self.events(name), timeout, f"the event {name}")
        return found[0] or {}
