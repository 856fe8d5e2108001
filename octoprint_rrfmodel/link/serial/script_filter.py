"""What OctoPrint runs for a print, kept from a board that has a job of its own.

Runs with whoever queues a command, first of all.
"""

import logging

from ...rrf.gcode.operations import NOTHING, Lines

ABORT_TAG = "trigger:abort_heatup"
"""OctoPrint's own, of the M108 by which it begins to cancel; RRF ends the waits of all by it."""

POSITION_TAG = "trigger:record_position"
"""OctoPrint's own, of the M400 and M114 by which it learns where a print was cancelled."""

CANCEL_TAG = "trigger:cancel"

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


class ScriptFilter:
    """Holds back what OctoPrint would run for a print that isn't its own, or into another one.

    ``link`` is the ``SerialLink``, ``card`` the ``SdCard``, which knows whose a print is.
    """

    def __init__(self, link, card):
        self._link = link
        self._card = card
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
        return None

    def _holds(self, comm):
        return self._card.is_foreign(comm) or self._card.is_others(comm)
