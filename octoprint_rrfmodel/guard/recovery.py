"""Going on after an emergency stop: who may restart the board, on a thread of its own."""

import logging
import threading

from flask_babel import gettext

from ..rrf.gcode.doing import OTHER
from ..rrf.views.machine import STOPS_AT_ONCE


class Recovery:
    """Restarts the board, one restart at a time; any thread may ask for one.

    ``printer()`` is OctoPrint's, ``link`` reaches the board, ``machine()`` is the view of the
    model. ``notifications`` tell when the board didn't come back, or doesn't stop yet.
    ``is_held()`` says whether a box holds the line that nobody can answer over it: OctoPrint can't
    end its print then.
    """

    def __init__(self, printer, link, machine, *, notifications, is_held):
        self._printer = printer
        self._link = link
        self._machine = machine
        self._notifications = notifications
        self._is_held = is_held
        self._lock = threading.Lock()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.recovery")
        self.is_wanted = False
        """Whether the connection ended with the board halted."""

    ##~~ a listener

    def identified(self):
        """Note that there is a board again; it tells by itself if it is halted."""
        self.is_wanted = False

    def forgotten(self):
        """Note the end of a connection, while it is still known how the board was."""
        if self._machine().is_halted:
            self.halted()

    def halted(self, doing=None):
        """Note that the board was stopped, and OctoPrint may have hung up on it.

        Tell if that has to wait for what the line was ``doing``.
        """
        self.is_wanted = True
        is_long = doing is not None and doing.what != OTHER
        if is_long and self._machine().version < STOPS_AT_ONCE:
            self._notifications.tell("stop_waits", doing.command)

    ##~~ any thread

    def refusal(self):
        """Return why there can be no restart now, ``None`` where there can."""
        printer = self._printer()
        streams = printer.is_printing() and not printer.is_paused() and not self._is_held()
        if streams or self._machine().prints:
            return gettext("The machine prints. Pause or cancel the print first.")
        if printer.is_operational() and not self._link.is_rrf:
            return gettext("The connected printer has not said that it runs RepRapFirmware.")
        if not self._link.can_restart:
            return gettext("No printer with RepRapFirmware was connected yet. Connect it first.")
        return None

    def start(self):
        """Begin to restart the board, if that isn't under way."""
        if self._lock.acquire(blocking=False):
            threading.Thread(target=self._run, name="rrfmodel.recovery", daemon=True).start()

    def _is_running(self):
        """Return whether the board prints by itself, ``None`` while that isn't known."""
        machine = self._machine()
        return machine.prints if machine.status else None

    def _run(self):
        try:
            self._link.restart(self._is_running)
        except Exception:
            self._logger.exception("Could not restart the board")
            self._notifications.did_not_come_back()
        finally:
            self._lock.release()
