"""A serial object that leads to a :class:`~.board.Board` instead of a device."""

from __future__ import annotations

import importlib
import threading
import time
from typing import Any

from .board import Board

POLL_SECONDS = 0.002
"""How often a waiting read looks whether the board has said something."""


def _serial_error(text: str, timeout: bool = False) -> Exception:
    """Return pyserial's exception where pyserial is installed, so that hosts catch it."""
    try:
        serial = importlib.import_module("serial")
    except ImportError:
        return TimeoutError(text) if timeout else OSError(text)
    kind = serial.SerialTimeoutException if timeout else serial.SerialException
    error: Exception = kind(text)
    return error


class SimulatedSerial:
    """A board behind the interface of ``serial.Serial`` as far as OctoPrint uses it.

    ``readline`` returns whole lines only: on a timeout it returns ``b""`` and keeps what has come.
    Reading and writing from different threads is safe. When the board re-enumerates, reads and
    writes raise ``SerialException``, as with a device that has been pulled out.
    """

    def __init__(
        self,
        board: Board,
        *,
        port: str = "RRF-SIM",
        baudrate: int = 115200,
        timeout: float | None = None,
        write_timeout: float | None = None,
    ):
        if not board.is_plugged_in:
            raise _serial_error(f"could not open port {port}: no such device")
        self.board = board
        self.port = port
        self.name = port
        self.baudrate = baudrate
        self.timeout = timeout
        self.write_timeout = write_timeout
        self.parity = "N"
        self.rts = self.dtr = True
        self.is_open = True
        self._session = board.sessions
        self._buffer = bytearray()
        self._read_lock = threading.RLock()
        self._wake = threading.Event()
        self._is_cancelled = False

    def open(self) -> None:
        """Open the port again after :meth:`close`."""
        if not self.board.is_plugged_in:
            raise _serial_error(f"could not open port {self.port}: no such device")
        self._session = self.board.sessions
        self._buffer.clear()
        self.is_open = True

    def isOpen(self) -> bool:
        return self.is_open

    def close(self) -> None:
        self.is_open = False
        self._wake.set()

    def _check(self) -> None:
        if not self.is_open:
            raise _serial_error("Attempting to use a port that is not open")
        if self._session != self.board.sessions or not self.board.is_plugged_in:
            raise _serial_error(
                "device reports readiness to read but returned no data "
                "(device disconnected or multiple access on port?)"
            )

    def _fetch(self) -> None:
        self.board.advance()
        self._check()
        self._buffer += self.board.transmit()

    def _wait(self, enough: Any) -> bool:
        """Fetch until ``enough()`` or the timeout; return whether it is enough."""
        self._is_cancelled = False
        end = None if self.timeout is None else time.monotonic() + self.timeout
        while True:
            self._fetch()
            if enough():
                return True
            if end is not None and time.monotonic() >= end:
                return False
            # a write of another thread wakes this one, so that its answer isn't late
            self._wake.wait(POLL_SECONDS)
            self._wake.clear()
            if self._is_cancelled:
                return False

    @property
    def in_waiting(self) -> int:
        """Bytes that can be read at once."""
        with self._read_lock:
            self._fetch()
            return len(self._buffer)

    def inWaiting(self) -> int:
        return self.in_waiting

    def read(self, size: int = 1) -> bytes:
        """Return up to ``size`` bytes, fewer after the timeout."""
        with self._read_lock:
            self._wait(lambda: len(self._buffer) >= size)
            data = bytes(self._buffer[:size])
            del self._buffer[: len(data)]
            return data

    def readline(self, *args: Any) -> bytes:
        """Return a whole line with its line end, ``b""`` after the timeout."""
        with self._read_lock:
            if not self._wait(lambda: b"\n" in self._buffer):
                return b""
            end = self._buffer.index(b"\n") + 1
            line = bytes(self._buffer[:end])
            del self._buffer[:end]
            return line

    def write(self, data: bytes) -> int:
        """Hand bytes to the board; wait while its input is full, at most ``write_timeout``."""
        self._check()
        end = None if self.write_timeout is None else time.monotonic() + self.write_timeout
        while not self.board.has_room:
            if end is not None and time.monotonic() >= end:
                raise _serial_error("Write timeout", timeout=True)
            time.sleep(POLL_SECONDS)
            self.board.advance()
            self._check()
        self.board.receive(bytes(data))
        self._wake.set()
        return len(data)

    def flush(self) -> None:
        """Everything written has arrived already."""

    def reset_input_buffer(self) -> None:
        with self._read_lock:
            self._fetch()
            self._buffer.clear()

    flushInput = reset_input_buffer

    def reset_output_buffer(self) -> None:
        """Nothing waits on the way out."""

    flushOutput = reset_output_buffer

    def cancel_read(self) -> None:
        """Let a waiting read return with what there is."""
        self._is_cancelled = True
        self._wake.set()

    def cancel_write(self) -> None:
        """A write never waits for long."""

    def __enter__(self) -> SimulatedSerial:
        return self

    def __exit__(self, *exception: Any) -> None:
        self.close()
