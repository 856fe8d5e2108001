"""The websocket: the whole model, then what changes, one message for each ``OK`` (DSF
WebSocketController.cs).
"""

from __future__ import annotations

import contextlib
import queue
import socket
import threading
import time
from typing import Any, Callable

from ..acceptor import AtBoard
from ..delivery import Delivery
from .frames import (
    BINARY,
    CLOSE,
    FAILED,
    GOING_AWAY,
    INVALID,
    PING,
    PONG,
    TEXT,
    UNSUPPORTED,
    closing,
    framed,
    read_frame,
)
from .machine_model import as_json
from .machine_request import MachineAnswer
from .patches import Patches

LONGEST_MESSAGE = 128
CYCLE_SECONDS = 0.25
"""How often DSF reads the model."""
PING_SECONDS = 30.0
OK, ASKS = b"OK\n", b"PING\n"
ANSWER = b"PONG\n"
END = object()
CLOSINGS = {
    503: (GOING_AWAY, "DCS has been stopped"),
    502: (FAILED, "Incompatible DCS version"),
}
"""Status that requests are answered with → how a websocket is closed then."""


class ModelSocket:
    """One websocket; ``model`` gives the whole model.

    ``trouble`` says why it has to end, ``delivery`` what of its messages gets through.
    """

    def __init__(
        self,
        client: socket.socket,
        *,
        at_board: AtBoard,
        model: Callable[[], dict[str, Any]],
        trouble: Callable[[], MachineAnswer | None],
        delivery: Delivery,
        ended: threading.Event,
    ):
        self._client = client
        self._at_board = at_board
        self._model = model
        self._trouble = trouble
        self._delivery = delivery
        self._ended = ended
        self._received: queue.Queue[Any] = queue.Queue()
        self._pinged_at = time.monotonic()

    def converse(self) -> None:
        """Go on until either side ends it."""
        try:
            self._tell_changes()
        finally:
            # closing alone wouldn't end it: the reader still waits for what comes
            with contextlib.suppress(OSError):
                self._client.shutdown(socket.SHUT_RDWR)

    def _tell_changes(self) -> None:
        threading.Thread(
            target=self._read, name="simulated websocket's reader", daemon=True
        ).start()
        with self._at_board():
            model = self._model()
        patches = Patches(model)
        if not self._tell(model):
            return
        is_awaited, next_at = True, time.monotonic()
        while not self._ended.is_set():
            trouble = self._trouble()
            if trouble is not None:
                code, reason = CLOSINGS[trouble.status]
                self._send(closing(code, reason))
                return
            if self._delivery.is_lossy:
                self._ended.wait(CYCLE_SECONDS)
                continue
            is_acknowledged = self._take(CYCLE_SECONDS if is_awaited else 0.0)
            if is_acknowledged is None:
                return
            is_awaited = is_awaited and not is_acknowledged
            if is_awaited or not self._is_due(next_at):
                continue
            next_at = time.monotonic() + CYCLE_SECONDS
            with self._at_board():
                patch = patches.next(self._model())
            if patch is not None:
                is_awaited = True
                if not self._tell(patch):
                    return
        self._send(closing(GOING_AWAY, "Server is shutting down"))

    def _tell(self, value: dict[str, Any]) -> bool:
        """Send what gets through of a message; return whether the client has taken it."""
        self._ended.wait(self._delivery.delay)
        with self._at_board():
            data = self._delivery.message(as_json(value).encode())
        return self._send(framed(TEXT, data))

    def _is_due(self, next_at: float) -> bool:
        """Wait for the next reading, and return whether it has come."""
        return not self._ended.wait(max(0.0, next_at - time.monotonic()))

    def _take(self, seconds: float) -> bool | None:
        """Take what has come; return whether it acknowledges, ``None`` where it is the end."""
        if time.monotonic() - self._pinged_at >= PING_SECONDS:
            self._pinged_at = time.monotonic()
            self._send(framed(PING, b""))
        try:
            frame = self._received.get(timeout=seconds) if seconds else self._received.get_nowait()
        except queue.Empty:
            return False
        if frame is END or frame.kind == CLOSE:
            self._send(closing(1000))
            return None
        if frame.kind in (PING, PONG):
            return False if frame.kind == PONG or self._send(framed(PONG, frame.data)) else None
        if frame.kind == BINARY or len(frame.data) > LONGEST_MESSAGE:
            self._send(closing(UNSUPPORTED))
            return None
        if frame.data == ASKS:
            return False if self._send(framed(TEXT, ANSWER)) else None
        if frame.data != OK:
            self._send(closing(INVALID, "Invalid command"))
            return None
        return True

    def _read(self) -> None:
        try:
            while True:
                frame = read_frame(self._exactly)
                self._received.put(END if frame is None else frame)
                if frame is None:
                    return
        except (OSError, ValueError):
            self._received.put(END)

    def _exactly(self, count: int) -> bytes:
        data = b""
        while len(data) < count:
            chunk = self._client.recv(count - len(data))
            if not chunk:
                break
            data += chunk
        return data

    def _send(self, data: bytes) -> bool:
        try:
            self._client.sendall(data)
        except OSError:
            return False
        return True
