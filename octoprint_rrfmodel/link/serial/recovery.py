"""Going on after an emergency stop: M999, and OctoPrint connected again when the board is back."""

import logging
import os
import threading
import time
from typing import NamedTuple

from flask_babel import gettext

SENDING_SECONDS = 0.5
"""Time for the line with M999 to leave."""

LEAVE_SECONDS = 5.0
"""Time in which the port vanishes after M999, if it is one that does (3.5 GCodes2.cpp:4718)."""

RETURN_SECONDS = 90.0
"""Time in which the port has to come back and the board to answer."""

CONNECT_SECONDS = 35.0
"""Time that one attempt to connect may take; OctoPrint gives up by itself before."""

GONE_SECONDS = 1.0
"""How long a connection has to be closed to have failed: OctoPrint 2.0's starts as a closed one."""

LOOK_SECONDS = 0.1


class Connection(NamedTuple):
    """What OctoPrint connects with."""

    port: str
    baudrate: int
    profile: str


class Recovery:
    """Restarts the board on a thread of its own, one restart at a time.

    ``printer()`` is OctoPrint's printer, ``comm()`` its serial connection to RepRapFirmware or
    ``None``, ``profile()`` the identifier of the printer profile in use. ``is_busy()`` says
    whether the machine itself prints. ``failed()`` is called when the board didn't come back.
    """

    def __init__(self, printer, comm, profile, is_busy, failed):
        self._printer = printer
        self._comm = comm
        self._profile = profile
        self._is_busy = is_busy
        self._failed = failed
        self._last = None
        self._is_connected = threading.Event()
        self._lock = threading.Lock()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.recovery")
        self.is_wanted = False
        """Whether the connection ended with the board halted."""

    def connected(self):
        """Note what OctoPrint is connected with; the board tells by itself if it is halted."""
        self._is_connected.set()
        comm = self._comm()
        if comm is not None:
            self._last = Connection(*comm.getConnection(), self._profile())
        self.is_wanted = False

    def halted(self):
        """Note that the board was stopped, and OctoPrint may have hung up on it."""
        self.is_wanted = True

    def refusal(self):
        """Return why there can be no restart now, ``None`` where there can."""
        printer = self._printer()
        if (printer.is_printing() and not printer.is_paused()) or self._is_busy():
            return gettext("The machine prints. Pause or cancel the print first.")
        if printer.is_operational() and self._comm() is None:
            return gettext("The connected printer has not said that it runs RepRapFirmware.")
        if self._last is None:
            return gettext("No printer with RepRapFirmware was connected yet. Connect it first.")
        return None

    def start(self):
        """Begin to restart the board, if that isn't under way."""
        if self._lock.acquire(blocking=False):
            threading.Thread(target=self._run, name="rrfmodel.recovery", daemon=True).start()

    def _run(self):
        try:
            self._restart(self._last)
        except Exception:
            self._logger.exception("Could not restart the board")
            self._failed()
        finally:
            self._lock.release()

    def _restart(self, last):
        deadline = time.monotonic() + RETURN_SECONDS
        if not self._printer().is_operational():
            self._connect(last, deadline)
        restarted = self._send_restart()
        if self._comm() not in (restarted, None):
            self._logger.info("Somebody has connected to another printer meanwhile")
            return
        self._close()
        # a port of a board's own USB goes away, one of an adapter stays
        if _may_vanish(last.port):
            _wait_until(lambda: not os.path.exists(last.port), LEAVE_SECONDS)
        else:
            time.sleep(LEAVE_SECONDS)
        self._connect(last, time.monotonic() + RETURN_SECONDS)
        self._logger.info("The board was restarted and is connected again")

    def _send_restart(self):
        """Send M999 past OctoPrint's queues, which would wait for an ok that never comes.

        Return the connection that it went out by.
        """
        # without a connection to RepRapFirmware there is a printer that nobody asked about
        if not _wait_until(lambda: self._comm() is not None, CONNECT_SECONDS):
            raise TimeoutError("the printer did not say that it runs RepRapFirmware")
        self._logger.info("Restarting the board")
        comm = self._comm()
        comm._do_send_without_checksum(b"M999")
        # closing may throw away what has not left yet; the board takes a second to restart
        time.sleep(SENDING_SECONDS)
        return comm

    def _connect(self, last, deadline):
        while True:
            if not _may_vanish(last.port) or os.path.exists(last.port):
                self._close()
                if self._connects(last):
                    return
            if time.monotonic() > deadline:
                raise TimeoutError(f"no answer on {last.port}")
            time.sleep(1.0)

    def _connects(self, last):
        printer = self._printer()
        self._is_connected.clear()
        try:
            printer.connect(port=last.port, baudrate=last.baudrate, profile=last.profile)
        except Exception as error:
            # a port that has just appeared may not be ready
            self._logger.info("Could not connect: %s", error)
            return False
        deadline = time.monotonic() + CONNECT_SECONDS
        closed_since = None
        # the event stays when somebody disconnects at once: that is not to be undone
        while not self._is_connected.wait(LOOK_SECONDS):
            now = time.monotonic()
            if not printer.is_closed_or_error():
                closed_since = None
            elif closed_since is None:
                closed_since = now
            elif now - closed_since > GONE_SECONDS:
                return False
            if now > deadline:
                return False
        return True

    def _close(self):
        """Close the connection; after an error OctoPrint 2.0 holds on to one that is dead."""
        printer = self._printer()
        printer.disconnect()
        _wait_until(printer.is_closed_or_error, LEAVE_SECONDS)


def _may_vanish(port):
    """Return whether the port is a file: what other systems and plugins call a port may not be."""
    return os.path.isabs(port)


def _wait_until(condition, seconds):
    """Return whether the condition has become true in time."""
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(LOOK_SECONDS)
    return True
