"""M999 over a serial port, and OctoPrint connected again when the board is back.

Runs on the thread of whoever restarts the board (``guard.recovery``).
"""

import logging
import os
import time
from typing import NamedTuple

from ...host.version import IS_2

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

TELL_SECONDS = 10.0
"""Time in which a board that was just connected tells what it is doing."""

LOOK_SECONDS = 0.1

LOGGER = logging.getLogger("octoprint.plugins.rrfmodel.restart")


class WorldChangedError(Exception):
    """The restart would hit something else than what it was asked for."""


class Connection(NamedTuple):
    """What OctoPrint connects with."""

    port: str
    baudrate: int
    profile: str


class World:
    """What a restart was asked for: a board at a port, with nobody else at it.

    ``printer()`` is OctoPrint's printer, ``is_running()`` whether the board prints by itself.
    """

    def __init__(self, printer, is_running):
        self._printer = printer
        self._is_running = is_running
        self._held = _held_by(printer())
        # the print that the restart ends: a paused one, or one that a box at the board holds up
        self._ends_a_print = printer().is_paused() or printer().is_printing()

    def take(self):
        """Take what OctoPrint has now for the restart's own: it has just made it."""
        self._held = _held_by(self._printer())
        self._ends_a_print = False

    def is_told(self):
        """Return whether the board has said what it is doing."""
        return self._is_running() is not None

    def check(self):
        """Raise ``WorldChangedError`` unless the next step is still what somebody asked for."""
        printer = self._printer()
        held = _held_by(printer)
        # one that has failed is still the same; 2.0 begins with one that says that it is closed
        if held is not None and held is not self._held:
            raise WorldChangedError("Somebody has connected to another printer meanwhile")
        if (printer.is_printing() or printer.is_paused()) and not self._ends_a_print:
            raise WorldChangedError("OctoPrint prints meanwhile")
        if self._is_running():
            raise WorldChangedError("The board prints meanwhile")


def restart(link, printer, last, is_running):
    """Restart the board at the other end of a connection's port, and connect again.

    ``link`` is the ``SerialLink``, ``printer()`` OctoPrint's printer, ``is_running()`` says whether
    the board prints by itself. Each step first looks whether the world is still the one that this
    began in, and leaves what somebody else has begun alone. Raises ``TimeoutError`` where the board
    doesn't come back.
    """
    try:
        _restart(link, printer, last, World(printer, is_running))
    except WorldChangedError as change:
        LOGGER.info("%s: leaving it alone", change)
    else:
        LOGGER.info("The board was restarted and is connected again")


def reconnect(printer, last):
    """Close OctoPrint's connection and open it again, unless something is printed."""
    if printer.is_printing() or printer.is_paused():
        return
    _close(printer)
    printer.connect(port=last.port, baudrate=last.baudrate, profile=last.profile)


def _restart(link, printer, last, world):
    deadline = time.monotonic() + RETURN_SECONDS
    if not printer().is_operational():
        _connect(link, printer(), last, deadline, world)
        # a board that goes on by itself has to have the time to say so
        _wait_until(world.is_told, TELL_SECONDS)
    _send_restart(link, world)
    world.check()
    _close(printer())
    # a port of a board's own USB goes away, one of an adapter stays
    if _may_vanish(last.port):
        _wait_until(lambda: not os.path.exists(last.port), LEAVE_SECONDS)
    else:
        time.sleep(LEAVE_SECONDS)
    _connect(link, printer(), last, time.monotonic() + RETURN_SECONDS, world)


def _send_restart(link, world):
    """Send M999, which no acknowledgement follows, past all queues."""
    # without a connection to RepRapFirmware there is a printer that nobody asked about
    deadline = time.monotonic() + CONNECT_SECONDS
    while not link.is_rrf:
        world.check()
        if time.monotonic() > deadline:
            raise TimeoutError("the printer did not say that it runs RepRapFirmware")
        time.sleep(LOOK_SECONDS)
    world.check()
    LOGGER.info("Restarting the board")
    link.connection._do_send_without_checksum(b"M999")
    # closing may throw away what has not left yet; the board takes a second to restart
    time.sleep(SENDING_SECONDS)


def _connect(link, printer, last, deadline, world):
    while True:
        world.check()
        if not _may_vanish(last.port) or os.path.exists(last.port):
            _close(printer)
            # closing takes a while
            world.check()
            if _connects(link, printer, last, world):
                return
        if time.monotonic() > deadline:
            raise TimeoutError(f"no answer on {last.port}")
        time.sleep(1.0)


def _connects(link, printer, last, world):
    link.was_identified.clear()
    try:
        printer.connect(port=last.port, baudrate=last.baudrate, profile=last.profile)
    except Exception as error:
        # a port that has just appeared may not be ready
        LOGGER.info("Could not connect: %s", error)
        return False
    world.take()
    deadline = time.monotonic() + CONNECT_SECONDS
    closed_since = None
    # the event stays when somebody disconnects at once: that is not to be undone
    while not link.was_identified.wait(LOOK_SECONDS):
        world.check()
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


def _held_by(printer):
    """Return what one connection of OctoPrint's is told from the next by, of any firmware."""
    # 1.11 has no public one
    return printer.current_connection if IS_2 else printer._comm


def _close(printer):
    """Close the connection; after an error OctoPrint 2.0 holds on to one that is dead."""
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
