"""Commands that would hang the line, dropped or put so that they don't, in the queuing hook."""

import logging

from ...host.tags import FILE_TAG
from ...rrf.gcode.operations import NOTHING, Lines
from ...rrf.gcode.plain_lines import with_safe_stars
from ...rrf.gcode.quotes import ROW as QUOTES
from ...rrf.gcode.quotes import completed, has_odd_quote
from ...rrf.gcode.stops import STOPS
from ...rrf.gcode.unsendable import (
    CHANGES_FILAMENT,
    PAUSE_ROW,
    PAUSES,
    text_of_box,
    unsendable,
)
from ...rrf.wire.masking import masked

PAUSE = Lines(("@pause",))
"""OctoPrint's own command that pauses the print where it stands; the printer doesn't see it."""


class UnsendableCommands:
    """Says which commands are better not sent, whoever wants to.

    ``machine()`` is the view of the model that it depends on. ``is_on(row)`` says whether a row
    of the table is switched on. ``notify(name, *arguments)`` only takes note:
    ``refused_operation`` (code, detail), ``print_waits`` (message), ``print_stops`` (code, place).
    ``stop(cmd, gcode, tags)`` gives what to queue for a stop of a file, ``files`` knows the file.
    """

    def __init__(self, machine, is_on, notify, *, stop, files):
        self._machine = machine
        self._is_on = is_on
        self._notify = notify
        self._stop = stop
        self._files = files
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.unsendable")

    def instead(self, cmd, gcode, tags):
        """Return what to queue in place of ``cmd``, ``None`` to queue it as it is.

        Who waits for it is told. A print pauses where a person was to act, as it does at M0.
        """
        if has_odd_quote(cmd) and self._is_on(QUOTES):
            return self._closed(cmd, gcode, tags)
        safe = with_safe_stars(cmd, gcode)
        if safe is None:
            self._logger.info("Not sending %r: its asterisk would begin a checksum", cmd)
            self._refused("asterisk", cmd)
            return NOTHING
        if safe != cmd:
            return Lines((safe,))
        if gcode in PAUSES:
            return self._pause(cmd, gcode, tags)
        if gcode in STOPS:
            return self._stop(cmd, gcode, tags) if FILE_TAG in tags else None
        row = unsendable(cmd, gcode, self._machine())
        if row is None or not self._is_on(row.name):
            return None
        self._logger.info("Not sending %r: %s", masked(cmd), row.reason)
        if row.pauses and FILE_TAG in tags:
            self._notify("print_waits", text_of_box(cmd))
            return PAUSE
        if row.is_told:
            self._refused(row.name, cmd)
        return NOTHING

    def _refused(self, code, cmd):
        self._notify("refused_operation", code, cmd)

    def _pause(self, cmd, gcode, tags):
        """Pause where a file wants it; a person's own is left to the firmware, which refuses it."""
        if FILE_TAG not in tags or not self._is_on(PAUSE_ROW):
            return None
        code = "file_filament" if gcode == CHANGES_FILAMENT else "file_pause"
        self._notify("print_stops", code, self._files.place(cmd, tags))
        return PAUSE

    def _closed(self, cmd, gcode, tags):
        """Return a line without the end of a quote as it was meant, if that can be known."""
        whole = self._files.whole(cmd, tags)
        if whole is not None:
            return self.instead(whole, gcode, tags) or Lines((whole,))
        if gcode == "M291" and FILE_TAG in tags:
            # whether it waits for a person stands behind the text
            self._notify("print_waits", cmd)
            return PAUSE
        closed = completed(cmd, gcode)
        if closed is not None:
            return self.instead(closed, gcode, tags) or Lines((closed,))
        self._logger.info("Not sending %r: its quote isn't closed", masked(cmd))
        self._refused(QUOTES, cmd)
        return NOTHING
