"""Methods about the print that is under way, whoever runs it, and restarts of the board."""

from functools import partial

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...host.own_thread import on_a_thread_of_its_own
from .methods import Method

CONTROL = "PLUGIN_RRFMODEL_CONTROL"

FITS = {
    "pause": lambda printer: printer.is_printing() and not printer.is_paused(),
    "resume": lambda printer: printer.is_paused(),
    "cancel": lambda printer: printer.is_printing() or printer.is_paused(),
}
"""What is done to OctoPrint's own print, and whether it is as that wants it."""


class PrintControl:
    """Pauses, resumes and cancels a print: OctoPrint's own, or the board's.

    ``printer()`` is OctoPrint's, ``link`` leads to the board, ``commands`` are those to the
    machine. What is called may run hooks of other plugins, and nobody waits for them.
    """

    def __init__(self, printer, link, commands):
        self._printer = printer
        self._link = link
        self._commands = commands

    def control(self, action, call):
        """Do that to the print; raise ``RequestRefused``."""
        if not self._link.has_a_print():
            self._commands.checked("job", {"action": action})
            self._later(partial(self._commands.run, "job", {"action": action}))
            return "ok"
        if not call.caller.may("PRINT"):
            raise RequestRefused(403, gettext("You may not do that. Ask an administrator."))
        printer = self._printer()
        if not FITS[action](printer):
            raise RequestRefused(409, _misfit(action))
        self._later(getattr(printer, f"{action}_print"))
        return "ok"

    def restart(self, call):
        """Restart the board as after an emergency stop; raise ``RequestRefused``."""
        self._commands.checked("recover", {})
        self._commands.run("recover", {})
        return "ok"

    def _later(self, function):
        on_a_thread_of_its_own(function, name="rrfmodel.print")


def _misfit(action):
    if action == "resume":
        return gettext("The print is not paused.")
    return gettext("The print is paused already, or about to end.")


def print_methods(control):
    """Return the rows; ``control`` is the ``PrintControl``."""
    return (
        *(
            Method(f"printer.print.{action}", partial(control.control, action), CONTROL, ("POST",))
            for action in FITS
        ),
        *(
            Method(f"printer.{name}", control.restart, CONTROL, ("POST",))
            for name in ("restart", "firmware_restart")
        ),
    )
