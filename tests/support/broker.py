"""A real MQTT broker, and a client that keeps what the broker tells it."""

from __future__ import annotations

import json
import os
import shutil
import socket
import subprocess
import sys
import threading
import uuid
from pathlib import Path
from typing import Any, Callable

from . import guard, ports, waiting

START_SECONDS = 30

# a daemon's place on Debian, which isn't in everybody's path
SEARCH_PATH = os.pathsep.join([os.environ.get("PATH", os.defpath), "/usr/sbin", "/usr/local/sbin"])


def mosquitto() -> str | None:
    """Return where the broker's program is, ``None`` where it isn't installed."""
    return shutil.which("mosquitto", path=SEARCH_PATH)


class Broker:
    """A context manager: mosquitto on a free port of the loopback address, without a memory.

    ``stop()`` and ``start()`` are a broker that fails and comes back, with nothing retained.
    """

    def __init__(self, folder: Path) -> None:
        self.port = ports.free_port()
        self._config = folder / "mosquitto.conf"
        self._config.write_text(
            f"listener {self.port} 127.0.0.1\n"
            "allow_anonymous true\n"
            "persistence false\n"
            # as root it would become a user that can't read the folder
            "user root\n",
            encoding="utf-8",
        )
        self._process: subprocess.Popen[bytes] | None = None

    def start(self) -> Broker:
        """Return the broker once it listens."""
        program = mosquitto()
        assert program is not None
        command = [sys.executable, guard.__file__, program, "-c", str(self._config)]
        with self._config.with_suffix(".log").open("ab") as output:
            self._process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        waiting.wait_for(self._listens, START_SECONDS, "the broker to listen")
        return self

    def stop(self) -> None:
        """Guarantee that the broker is gone; a second call does nothing."""
        process, self._process = self._process, None
        if process is not None:
            assert process.stdin is not None
            process.stdin.close()
            process.wait()

    def __enter__(self) -> Broker:
        return self.start()

    def __exit__(self, *exc_info: object) -> None:
        self.stop()

    def _listens(self) -> bool:
        assert self._process is not None and self._process.poll() is None, self.log()
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", self.port)) == 0

    def log(self) -> str:
        """Return what the broker has said."""
        return self._config.with_suffix(".log").read_text(encoding="utf-8", errors="replace")


class Subscriber:
    """A context manager: a client that has subscribed, with all it was told.

    ``retained`` are the messages that the broker had kept, complete from the beginning;
    ``messages`` are all of them, as ``(topic, payload)`` in the order of arrival.
    """

    def __init__(self, broker: Broker, *topics: str) -> None:
        from paho.mqtt import client

        self.messages: list[tuple[str, bytes]] = []
        self.retained: dict[str, bytes] = {}
        self._topics = topics
        self._port = broker.port
        self._marker = f"marker/{uuid.uuid4()}"
        self._is_told = threading.Event()
        self._client = client.Client(client.CallbackAPIVersion.VERSION2)
        self._client.on_connect = self._subscribe
        # the broker keeps the order: this comes behind all that was retained
        self._client.on_subscribe = lambda *_: self._client.publish(self._marker)
        self._client.on_message = self._take

    def __enter__(self) -> Subscriber:
        self._client.connect("127.0.0.1", self._port)
        self._client.loop_start()
        assert self._is_told.wait(10), "the broker took no subscription"
        return self

    def __exit__(self, *exc_info: object) -> None:
        self._client.disconnect()
        self._client.loop_stop()

    def _subscribe(self, client: Any, *others: Any) -> None:
        client.subscribe([(topic, 0) for topic in (*self._topics, self._marker)])

    def _take(self, client: Any, userdata: Any, message: Any) -> None:
        if message.topic == self._marker:
            self._is_told.set()
            return
        if message.retain:
            self.retained[message.topic] = message.payload
        self.messages.append((message.topic, message.payload))

    def wait_for(self, topic: str, fits: Callable[[bytes], bool], timeout: float = 10) -> bytes:
        """Return the first payload of a topic, among those to come too, that fits."""

        def found() -> list[bytes]:
            return [body for name, body in list(self.messages) if name == topic and fits(body)]

        return waiting.wait_for(found, timeout, f"a fitting message at {topic}")[0]


def retained(broker: Broker, topic: str, count: int) -> dict[str, Any]:
    """Return what a client that comes now is told, once that are so many messages.

    Values by topic.
    """

    def look() -> dict[str, bytes] | None:
        with Subscriber(broker, topic) as subscriber:
            return subscriber.retained if len(subscriber.retained) >= count else None

    found = waiting.wait_for(look, 10, f"{count} retained messages below {topic}")
    return {name: json.loads(payload) for name, payload in found.items()}
