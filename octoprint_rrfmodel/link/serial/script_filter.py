"""What OctoPrint runs for a print: kept from a board with a job of its own, and made complete.

Runs with whoever queues a command, first of all.
"""

import logging

from ...rrf.gcode.operations import NOTHING, Lines
from ...rrf.gcode.switch_off import ROW, all_off, switched_off

ABORT_TAG = "trigger:abort_heatup"
"""OctoPrint's own, of the M108 by which it begins to cancel; RRF ends the waits of all by it."""

POSITION_TAG = "trigger:record_position"
"""OctoPrint's own, of the M400 and M114 by which it learns where a print was cancelled."""

CANCEL_TAG = "trigger:cancel"

CANCELLED_TAG = "script:afterPrintCancelled"

SCRIPTS = frozenset(
    f"script:{name}"
    for name in (
        "beforePrintStarted",
        "beforePrintPaused",
        "afterPrintPaused",
        "beforePrintResumed",
        "afterPrintResumed",
        "afterPrintCancelled",
        "afterPrintDone",
    )
)
"""OctoPrint's tags of the scripts that it runs for a print."""

LEAVING_TAG = "script:beforePrinterDisconnected"
"""Of the one that it runs for no print, and that one of the machine's might not survive."""

OF_PRINTS = SCRIPTS | {LEAVING_TAG, ABORT_TAG, POSITION_TAG}
"""What to look at; few commands have any of these tags, and those of files none."""

IN_PLACE_OF_WAITING = Lines(("M105",))
"""OctoPrint goes on when its M400 has left; a job would stop for a moment at that."""


LETTERS = {"tool": "T", "bed": "B", "chamber": "C"}
"""Letters of heaters as the firmware's own reports have them."""


class ScriptFilter:
    """Holds back what OctoPrint would run for a print that isn't its own, or into another one.

    And its script for a cancelled print, which goes by the printer profile, switches off the
    heaters of all that the machine has of a kind where it switches one of them off.

    ``link`` is the ``SerialLink``, ``card`` the ``SdCard``, which knows whose a print is.
    ``machine()`` is the view of the model. ``is_on(row)`` says whether a row of the operations is
    switched on. ``tell(code, detail)`` only takes note.
    """

    def __init__(self, link, card, machine, *, is_on, tell):
        self._link = link
        self._card = card
        self._machine = machine
        self._is_on = is_on
        self._tell = tell
        self._done = {}
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.scripts")

    def translate(self, cmd, gcode, tags):
        """Return what to queue in place of ``cmd``, ``None`` to leave it to others."""
        if OF_PRINTS.isdisjoint(tags):
            return None
        comm = self._link.connection
        if POSITION_TAG in tags:
            waits = gcode == "M400" and CANCEL_TAG in tags
            return IN_PLACE_OF_WAITING if waits and self._holds(comm) else None
        if self._card.is_others(comm) if LEAVING_TAG in tags else self._holds(comm):
            self._logger.info("Not sending %r: the board has, or had, a job of its own", cmd)
            return NOTHING
        return self._completed(comm, cmd, gcode) if CANCELLED_TAG in tags else None

    def _holds(self, comm):
        return self._card.is_foreign(comm) or self._card.is_others(comm)

    def _completed(self, comm, cmd, gcode):
        """Return a command that switches a heater off with the lines for all others of its kind."""
        kind = switched_off(cmd, gcode)
        if kind is None or not self._is_on(ROW):
            return None
        shown = comm._currentFile and comm._currentFile.getStartTime()
        if self._done.get(kind) == (comm, shown):
            # once for each print: a script has a line for each heater that it knows
            return None
        self._done[kind] = comm, shown
        machine = self._machine()
        off = all_off(machine, (kind,))
        left_on = [found for found in off if found.is_on and not self._is_known(found, machine)]
        if left_on:
            names = ", ".join(f"{LETTERS[found.kind]}{found.number}" for found in left_on)
            self._logger.info("Switching off what the script doesn't know: %s", names)
            self._tell(ROW, names)
        return Lines((cmd, *self._link.carried([found.line for found in off], machine)))

    def _is_known(self, found, machine):
        """Return whether OctoPrint's own script has a line for it."""
        profile = self._link.profile()
        if found.kind == "tool":
            return found.number < profile["extruder"]["count"]
        return found.number == machine.slot(f"{found.kind}Heaters")
