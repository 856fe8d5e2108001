"""Commands that would hang the line, dropped or put so that they don't, in the queuing hook."""

import logging

from ...host.tags import FILE_TAG
from ...rrf.gcode.operations import NOTHING, Lines
from ...rrf.gcode.plain_lines import with_safe_stars
from ...rrf.gcode.stops import STOPS
from ...rrf.gcode.unsendable import text_of_box, unsendable
from ...rrf.wire.masking import masked

PAUSE = Lines(("@pause",))
"""OctoPrint's own command that pauses the print where it stands; the printer doesn't see it."""


class UnsendableCommands:
    """Says which commands are better not sent, whoever wants to.

    ``machine()`` is the view of the model that it depends on. ``is_on(row)`` says whether a row
    of the table is switched on. ``refused(code, detail)`` and ``paused(message)`` only take note.
    ``stop(cmd, gcode, tags)`` gives what to queue for a stop of a file.
    """

    def __init__(self, machine, is_on, refused, *, paused, stop):
        self._machine = machine
        self._is_on = is_on
        self._refused = refused
        self._paused = paused
        self._stop = stop
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.unsendable")

    def instead(self, cmd, gcode, tags):
        """Return what to queue in place of ``cmd``, ``None`` to queue it as it is.

        Who waits for it is told. A print pauses where a person was to act, as it does at M0.
        """
        safe = with_safe_stars(cmd, gcode)
        if safe is None:
            self._logger.info("Not sending %r: its asterisk would begin a checksum", cmd)
            self._refused("asterisk", cmd)
            return NOTHING
        if safe != cmd:
            return Lines((safe,))
        if gcode in STOPS:
            return self._stop(cmd, gcode, tags) if FILE_TAG in tags else None
        row = unsendable(cmd, gcode, self._machine())
        if row is None or not self._is_on(row.name):
            return None
        self._logger.info("Not sending %r: %s", masked(cmd), row.reason)
        if row.pauses and FILE_TAG in tags:
            self._paused(text_of_box(cmd))
            return PAUSE
        if row.is_told:
            self._refused(row.name, cmd)
        return NOTHING
