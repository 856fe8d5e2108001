"""A board behind a pseudo-terminal: any program that opens serial ports can talk to it."""

from __future__ import annotations

import contextlib
import os
import pty
import select
import termios
import threading
import time
import tty
from typing import Any

from .board import Board

TICK_SECONDS = 0.002
"""Between two looks at a board that is at work."""

IDLE_SECONDS = 0.02
"""The same where nothing but a line from the host, which is heard at once, can make it work."""

CHUNK = 4096
DROP_AFTER_SECONDS = 2.0
"""USB bytes that nobody fetches for so long are lost (RRF 3.5 Platform.cpp:1055)."""


class PtyBoard:
    """Runs a board on a raw pseudo-terminal that is linked at ``link``; use it with ``with``.

    The host may close the port and open it again. While nobody has it open, output is lost as it
    is on USB. When the board re-enumerates, the terminal and the link go away and come back.
    ``baud`` slows the output down to a line of that speed.
    """

    def __init__(self, board: Board, link: str, *, baud: int | None = None):
        self.board = board
        self.link = os.fspath(link)
        if baud is not None:
            board.inject(f"baud:{baud}")
        self._master: int | None = None
        self._session = board.sessions
        self._unsent = b""
        self._unsent_since = 0.0
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self.error: BaseException | None = None
        """What ended the thread, if not :meth:`stop`."""
        self.turns_alone = 0
        """How often in a row there was nobody at the other end."""

    def start(self) -> PtyBoard:
        """Open the terminal, link it, and let the board run."""
        if os.path.lexists(self.link) and not os.path.islink(self.link):
            raise FileExistsError(f"{self.link} exists and is no link")
        self._open()
        self._thread = threading.Thread(target=self._run, name="simulated board", daemon=True)
        self._thread.start()
        return self

    def stop(self) -> None:
        """End the thread, close the terminal and remove the link."""
        self._stop.set()
        if self._thread is not None:
            self._thread.join()
        self._close()

    def __enter__(self) -> PtyBoard:
        return self.start()

    def __exit__(self, *exception: Any) -> None:
        self.stop()

    def _open(self) -> None:
        master, slave = pty.openpty()
        tty.setraw(slave, termios.TCSANOW)
        os.set_blocking(master, False)
        name = os.ttyname(slave)
        # once it has been opened and closed, an unopened terminal shows as hung up
        os.close(slave)
        self._master = master
        temporary = f"{self.link}.{os.getpid()}"
        os.symlink(name, temporary)
        os.replace(temporary, self.link)

    def _close(self) -> None:
        if self._master is not None:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(self.link)
            os.close(self._master)
            self._master = None
        self._unsent = b""

    def _run(self) -> None:
        try:
            while not self._stop.is_set():
                self._turn()
        except BaseException as error:
            self.error = error
            raise
        finally:
            self._close()

    def _turn(self) -> None:
        self.board.advance()
        if self._session != self.board.sessions:
            self._close()
            self._session = self.board.sessions
        if self._master is None:
            if self.board.is_plugged_in:
                self._open()
            else:
                self._stop.wait(TICK_SECONDS)
            return
        events = self._events(self._master)
        # what was written before the port was closed has left it
        if events & select.POLLIN:
            with contextlib.suppress(BlockingIOError, OSError):
                self.board.receive(os.read(self._master, CHUNK))
        if events & select.POLLHUP:
            self.board.transmit()
            self._unsent = b""
            self.turns_alone += 1
            self._stop.wait(IDLE_SECONDS)
            return
        self.turns_alone = 0
        self._send()

    def _events(self, master: int) -> int:
        """Wait a moment for something to happen; return what has."""
        poll = select.poll()
        wanted = select.POLLIN if self.board.has_room else 0
        poll.register(master, wanted | (select.POLLOUT if self._unsent else 0))
        seconds = TICK_SECONDS if self.board.is_at_work or self._unsent else IDLE_SECONDS
        found = poll.poll(seconds * 1000)
        return found[0][1] if found else 0

    def _send(self) -> None:
        data = self.board.transmit()
        if not self._unsent:
            self._unsent_since = time.monotonic()
        self._unsent += data
        if not self._unsent or self._master is None:
            return
        try:
            sent = os.write(self._master, self._unsent)
        except OSError:
            sent = 0
        if sent:
            self._unsent = self._unsent[sent:]
            self._unsent_since = time.monotonic()
        elif time.monotonic() - self._unsent_since > DROP_AFTER_SECONDS:
            self._unsent = b""
