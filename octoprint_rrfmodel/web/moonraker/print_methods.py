"""Methods about prints: begun, paused, gone on with, cancelled, whoever runs them."""

import time
from functools import partial

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...host.own_thread import on_a_thread_of_its_own
from ...host.print_files import LOCAL, STARTING
from ...rrf.card.listing import ROOT
from .methods import CONTROL, Method
from .places import CARD

PRINT, SELECT = "PRINT", "FILES_SELECT"
"""OctoPrint's permissions for what its own API does so."""

TAGS = frozenset(("source:plugin", "plugin:rrfmodel", "trigger:rrfmodel.moonraker"))


LOOK_SECONDS = 0.1
"""Between two looks at whether a print has begun."""


class PrintMethods:
    """Answers them: OctoPrint prints its own files, the board those on its card.

    ``printer()`` is OctoPrint's, ``run(command, parameters)`` runs a command to the machine and
    returns status and sentence of one that is refused. ``roots()`` are ``Roots``.
    """

    def __init__(self, printer, run, roots):
        self._printer = printer
        self._run = run
        self._roots = roots

    def rows(self):
        """Return the rows; which permission is needed depends on who prints."""
        return (
            Method("printer.print.start", self._start, verbs=("POST",)),
            *(
                Method(f"printer.print.{name}", self._change(name), verbs=("POST",))
                for name in CHANGES
            ),
        )

    def _start(self, call):
        place, _ = self._roots().file(call.text("filename"))
        self.check(place.root, call)
        self.start(place.root, place.path, call)
        return "ok"

    def check(self, root, call):
        """Raise ``RequestRefused`` for who may not begin a print of a root's files."""
        for permission in (CONTROL,) if root == CARD else (SELECT, PRINT):
            call.needs(permission)

    def start(self, root, path, call):
        """Begin a print."""
        if root == CARD:
            self._command("start", path=f"{ROOT}/{path}")
            return
        files, printer = self._roots().own.files, self._printer()
        found = files.find(path)
        if found is None or not found.is_printable:
            raise RequestRefused(415, gettext("That is no file that can be printed."))
        if not printer.is_operational():
            raise RequestRefused(409, gettext("No printer is connected. Connect it first."))
        if not printer.is_ready():
            raise RequestRefused(409, gettext("The printer prints already."))
        files.select(path, call.caller.name, is_printed=True)

    def _change(self, name):
        def change(call):
            if not self._is_octoprints():
                call.needs(CONTROL)
                self._command(name)
                return "ok"
            call.needs(PRINT)
            method, fits = CHANGES[name]
            printer = self._printer()
            if not fits(printer):
                raise RequestRefused(409, _misfit(name, printer))
            act = partial(getattr(printer, method), tags=set(TAGS), user=call.caller.name)
            # other plugins' hooks run in it
            on_a_thread_of_its_own(_once_begun, printer, act, name="rrfmodel.print")
            return "ok"

        return change

    def _is_octoprints(self):
        """Return whether what is under way is a print of OctoPrint's own file."""
        printer = self._printer()
        file = (printer.get_current_job() or {}).get("file") or {}
        states = (printer.is_printing, printer.is_paused, printer.is_pausing, printer.is_cancelling)
        return file.get("origin") == LOCAL and any(state() for state in states)

    def _command(self, action, **more):
        refused = self._run("job", {"action": action, **more})
        if refused:
            raise RequestRefused(*refused)


CHANGES = {
    "pause": ("pause_print", lambda printer: printer.is_printing() and not printer.is_paused()),
    "resume": ("resume_print", lambda printer: printer.is_paused()),
    "cancel": ("cancel_print", lambda printer: printer.is_printing() or printer.is_paused()),
}
"""What is done to a print, OctoPrint's method for it, and whether that does anything now."""


def _once_begun(printer, act):
    """Do something to a print; OctoPrint would forget it while the print is still starting."""
    while printer.get_state_id() == STARTING:
        time.sleep(LOOK_SECONDS)
    act()


def _misfit(name, printer):
    if name == "resume":
        if printer.is_pausing():
            # to a client it is paused already
            return gettext("The print is still being paused. Try again in a moment.")
        return gettext("The print is not paused.")
    return gettext("The print is paused already, or about to end.")
