"""M999 over a serial port, and OctoPrint connected again when the board is back.

Runs on the thread of whoever restarts the board (``guard.recovery``).
"""

import logging
import os
import time
from typing import NamedTuple

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

LOGGER = logging.getLogger("octoprint.plugins.rrfmodel.restart")


class Connection(NamedTuple):
    """What OctoPrint connects with."""

    port: str
    baudrate: int
    profile: str


def restart(link, printer, last):
    """Restart the board at the other end of a connection's port, and connect again.

    ``link`` is the ``SerialLink``, ``printer()`` OctoPrint's printer. Raises ``TimeoutError``
    where the board doesn't come back.
    """
    deadline = time.monotonic() + RETURN_SECONDS
    if not printer().is_operational():
        _connect(link, printer(), last, deadline)
    restarted = _send_restart(link)
    if link.connection not in (restarted, None):
        LOGGER.info("Somebody has connected to another printer meanwhile")
        return
    _close(printer())
    # a port of a board's own USB goes away, one of an adapter stays
    if _may_vanish(last.port):
        _wait_until(lambda: not os.path.exists(last.port), LEAVE_SECONDS)
    else:
        time.sleep(LEAVE_SECONDS)
    _connect(link, printer(), last, time.monotonic() + RETURN_SECONDS)
    LOGGER.info("The board was restarted and is connected again")


def _send_restart(link):
    """Send M999 past OctoPrint's queues, which would wait for an ok that never comes.

    Return the connection that it went out by.
    """
    # without a connection to RepRapFirmware there is a printer that nobody asked about
    if not _wait_until(lambda: link.is_rrf, CONNECT_SECONDS):
        raise TimeoutError("the printer did not say that it runs RepRapFirmware")
    LOGGER.info("Restarting the board")
    comm = link.connection
    comm._do_send_without_checksum(b"M999")
    # closing may throw away what has not left yet; the board takes a second to restart
    time.sleep(SENDING_SECONDS)
    return comm


def _connect(link, printer, last, deadline):
    while True:
        if not _may_vanish(last.port) or os.path.exists(last.port):
            _close(printer)
            if _connects(link, printer, last):
                return
        if time.monotonic() > deadline:
            raise TimeoutError(f"no answer on {last.port}")
        time.sleep(1.0)


def _connects(link, printer, last):
    link.was_identified.clear()
    try:
        printer.connect(port=last.port, baudrate=last.baudrate, profile=last.profile)
    except Exception as error:
        # a port that has just appeared may not be ready
        LOGGER.info("Could not connect: %s", error)
        return False
    deadline = time.monotonic() + CONNECT_SECONDS
    closed_since = None
    # the event stays when somebody disconnects at once: that is not to be undone
    while not link.was_identified.wait(LOOK_SECONDS):
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
