"""A print that OctoPrint streams, paused when the machine can't print: RRF leaves that to hosts."""

import re
import time
from functools import partial
from typing import NamedTuple

import flask
from flask_babel import gettext
from octoprint.access.permissions import Permissions

from ..host.answers import refusal
from ..host.own_thread import on_a_thread_of_its_own
from ..host.print_files import STARTING
from ..host.request_json import json_of
from ..host.warning_texts import waiting_text, warning_text
from ..host.warnings import FILE_PAUSES
from ..rrf.gcode.file_place import named
from ..rrf.views.warnings import (
    OFF,
    POSITION_LOST,
    RESET,
    MachineWarning,
    faults,
    is_resumable,
    is_unhomed,
    said,
)
from ..rrf.wire.errors import guarded_warning
from ..rrf.wire.masking import masked
from ..rrf.wire.refusals import CODES as REFUSALS

OF_A_LINE = frozenset((*REFUSALS, *FILE_PAUSES))
"""Codes of what a print meets at one of its lines; when that is mended only a person knows."""

FOR_EVER = float("inf")

PAUSING_SECONDS = 0.5
"""Time that the worker gives a pause to begin; hooks of other plugins may hold it up."""

LET_GO_SECONDS = 60.0
"""Time without a refusal behind which one of the same kind is news again."""

JOB_ENDPOINT = "api.controlJob"
"""OctoPrint's view of ``POST /api/job``."""


class Pause(NamedTuple):
    """Why the plugin has paused OctoPrint's print, and what a person can do about it."""

    causes: tuple
    """Warnings; those that hold now, or where none does any more those that were."""
    message: str
    """The text of a message box that the print came to, empty where it was none."""
    what_next: str
    """``wait`` until the causes are over, ``resume``, ``cancel``, ``answer`` the message, ``mend``
    what a line of the file has met, then resume."""


class PrintGuard:
    """Pauses OctoPrint's own print, once for each cause, and keeps it paused until that is over.

    ``printer()`` is OctoPrint's printer. ``has_print()`` says whether it prints, or has paused,
    one of its own files on RepRapFirmware. ``model()`` is the snapshot. ``is_on("guard", code)``
    says whether a cause is watched. ``tell(code, detail)`` reaches the pages. ``causes``,
    ``pause``, ``refusal``, ``stops`` and ``handles`` may be called by any thread, all else by the
    worker.
    """

    def __init__(self, printer, has_print, model, *, is_on, tell, clock=time.monotonic):
        self._printer = printer
        self.has_print = has_print
        self._model = model
        self._is_on = partial(is_on, "guard")
        self._tell = tell
        self._clock = clock
        self._refused = {}
        self._was_reset = False
        self._was_off = False
        self._told = frozenset()
        self._paused_for = None
        # events come late: the next pause may be under way before the end of the last one is told
        self._pausing_for = None
        self._pausing = None
        # what was found while the print was still starting
        self._early = ()

    def causes(self):
        """Return why the print may not go on, the worst first; nothing where there is none."""
        if not self.has_print():
            return []
        found = [cause for cause in faults(self._model()) if self._is_on(cause.code)]
        if self._was_off and is_unhomed(self._model()):
            found.append(POSITION_LOST)
        return [RESET, *found] if self._was_reset else found

    def pause(self):
        """Return why the print was paused by the plugin, ``None`` where it wasn't."""
        paused_for = self._pausing_for or self._paused_for
        if paused_for is None or not self.has_print():
            return None
        causes, message = paused_for
        if message:
            return Pause((), message, "answer")
        now = self.causes()
        if not now:
            is_of_a_line = any(cause.code in OF_A_LINE for cause in causes)
            return Pause(causes, "", "mend" if is_of_a_line else "resume")
        may_go_on = all(is_resumable(cause) for cause in now)
        return Pause(tuple(now), "", "wait" if may_go_on else "cancel")

    def look(self):
        """Pause if there is a reason to; tell each reason once."""
        causes = self.causes()
        self._was_off |= any(cause.code == OFF for cause in causes)
        self._told &= frozenset((*causes, *self._early))
        self._pause_for(causes)

    def _pause_for(self, causes):
        causes = [*causes, *(cause for cause in self._early if cause not in causes)]
        if causes and self._takes_over(causes):
            return
        printer = self._printer()
        # what has begun to end or to pause needs nothing; cancelling is what a person wants
        if not causes or printer.is_pausing() or printer.is_cancelling() or printer.is_finishing():
            return
        # last: OctoPrint counts a pause that has only begun as printing, and may be through by now;
        # 2.0 counts the pause itself as printing, too
        if not printer.is_printing() or printer.is_paused():
            return
        if self._pausing is not None and self._pausing.is_alive():
            # hung up, and pauses as soon as it can
            return
        is_starting = printer.get_state_id() == STARTING
        self._early = tuple(causes) if is_starting else ()
        if is_starting:
            # pausing now would be undone: OctoPrint goes on to printing behind its script
            return
        self._pausing_for = (tuple(causes), "")
        self._pausing = on_a_thread_of_its_own(printer.pause_print, name="rrfmodel.pause")
        # as good as always it is through at once, and told behind it
        self._pausing.join(PAUSING_SECONDS)
        self._tell_new(causes)

    def _takes_over(self, causes):
        """Return whether the print is paused for a refused line, which has come of these causes."""
        if _is_refused(self._pausing_for):
            self._pausing_for = tuple(causes), ""
        elif self._pausing_for is None and _is_refused(self._paused_for):
            self._paused_for = tuple(causes), ""
        else:
            return False
        self._tell_new(causes)
        return True

    def _tell_new(self, causes):
        new = [cause for cause in causes if cause not in self._told]
        self._told = frozenset(causes)
        if new:
            self._tell("print_paused", _sentences(new))

    def waits_for(self, message):
        """Note that the print pauses at a message box that nobody could answer."""
        self._pausing_for = ((), message)
        self._tell("print_paused", waiting_text(message))

    def stops(self, code, text, print_started):
        """Return whether a refused line pauses that print; OctoPrint's receiving thread asks.

        Once: who resumes it lets those that follow go, until there is none for a while.
        """
        if not self._is_on(code):
            return False
        kind = print_started, code, re.sub(r"\d+", "", text)
        now = self._clock()
        is_new = now - self._refused.get(kind, -LET_GO_SECONDS) >= LET_GO_SECONDS
        # of another print nothing is of use any more; while it is paused no time counts
        known = {known: at for known, at in self._refused.items() if known[0] == print_started}
        self._refused = {**known, kind: FOR_EVER if is_new else now}
        return is_new

    def stopped(self, code, place, text=""):
        """Note that the print pauses at a line of its file (``rrf.gcode.file_place.Place``)."""
        cause = MachineWarning(
            code, texts=(("place", masked(named(place))), ("text", masked(text)))
        )
        self._pausing_for = ((cause,), "")
        self._tell("print_paused", _sentences([cause]))

    ##~~ a listener

    def replied(self, taken, asked_at):
        """Look at the model that a reply has changed."""
        self.look()

    def line(self, text):
        """Pause for a fault that the firmware says in words; not every model shows each.

        When it is over nobody can tell: somebody has to look, and may then resume.
        """
        if self.has_print():
            self._pause_for([each for each in said(text, self._model()) if self._is_on(each.code)])

    def heard(self, what):
        """Note that a line of text tells of a new beginning of the board."""
        if what == "reset":
            self.reset()

    def reset(self):
        """Note that the board has begun anew."""
        if self.has_print() and self._is_on(RESET.code):
            self._was_reset = True
            self.look()

    ##~~ OctoPrint's own events, on the worker

    def paused(self):
        """Note that the print is paused, by whomever."""
        self._paused_for = self._pausing_for or self._paused_for
        self._pausing_for = None

    def resumed(self):
        """Note that somebody has resumed the print: it is paused again if it may not go on."""
        self._told = frozenset()
        self._paused_for = None
        # what a file does to its axes at its end is nobody's concern
        self._was_off &= is_unhomed(self._model())
        if self._pausing_for is not None and not _is_of_a_line(self._pausing_for):
            # a line may be what stops the print next, a cause would be found again
            self._pausing_for = None
        now = self._clock()
        self._refused = {kind: min(at, now) for kind, at in self._refused.items()}
        self.look()

    def started(self):
        """Note that a print has begun, which may have come to a line already that pauses it."""
        pausing_for, early = self._pausing_for, self._early
        self.forgotten()
        self._early = early
        if pausing_for is not None and _is_of_a_line(pausing_for):
            self._pausing_for = pausing_for

    def forgotten(self):
        """Note that there is no print any more, or another one."""
        self._was_reset, self._was_off, self._early = False, False, ()
        self._told = frozenset()
        self._paused_for = self._pausing_for = None

    def handles(self, error):
        """Return whether a serious error of the firmware only pauses the print."""
        code = guarded_warning(error)
        return code is not None and self.has_print() and self._is_on(code)

    def refusal(self):
        """Return why the print may not be resumed, ``None`` where it may."""
        causes = self.causes()
        if not causes:
            return None
        if all(is_resumable(cause) for cause in causes):
            return gettext("The print stays paused. %(why)s", why=_sentences(causes))
        return gettext("The print can only be cancelled. %(why)s", why=_sentences(causes))

    ##~~ octoprint.server.api.before_request

    def refuse(self):
        """Return an answer for a request that would resume the print, ``None`` for others."""
        request = flask.request
        if request.endpoint != JOB_ENDPOINT or request.method != "POST":
            return None
        # without the permission OctoPrint's own answer is the right one
        if not self._wants_to_go_on(json_of(request)) or not Permissions.PRINT.can():
            return None
        why = self.refusal()
        return refusal(409, why) if why else None

    def _wants_to_go_on(self, data):
        if not isinstance(data, dict):
            return False
        if data.get("command") == "restart":
            return True
        if data.get("command") != "pause":
            return False
        action = data.get("action", "toggle")
        return action == "resume" or (action == "toggle" and self._printer().is_paused())


def _is_refused(paused_for):
    """Return whether it is a refused line that a print is paused for."""
    return paused_for is not None and any(cause.code in REFUSALS for cause in paused_for[0])


def _is_of_a_line(paused_for):
    """Return whether it is a line of the file that a print is paused for."""
    causes, message = paused_for
    return bool(message) or any(cause.code in OF_A_LINE for cause in causes)


def _sentences(warnings):
    return " ".join(warning_text(found.code, found.values) for found in warnings)
