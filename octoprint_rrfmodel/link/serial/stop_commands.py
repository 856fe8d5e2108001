"""M0 and M1 of a file that OctoPrint streams: at its end they reach the board."""

import logging
import os

from ...rrf.gcode.operations import NOTHING, Lines
from ...rrf.gcode.stops import ROW, is_at_end, stop_lines

MOST_BEHIND = 512 * 1024
"""Bytes behind a command that may be comments alone: slicers keep their settings there."""

BEFORE = 1024
"""Bytes in front of that place, for the line itself."""


class StopCommands:
    """Ends a print on the board where its file does; elsewhere OctoPrint pauses, as ever.

    ``link`` is the ``SerialLink``, ``files`` knows its file (``FileLines``), ``machine()`` the view
    of the model. ``is_others(comm)`` says whether the board has a job that isn't OctoPrint's,
    ``is_on(row)`` whether a row of the operations is switched on.
    """

    def __init__(self, link, files, machine, *, is_others, is_on):
        self._link = link
        self._files = files
        self._machine = machine
        self._is_others = is_others
        self._is_on = is_on
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.stops")

    def instead(self, cmd, gcode, tags):
        """Return what to queue in place of a stop of a file, ``None`` to leave it to OctoPrint."""
        comm = self._link.connection
        if not self._is_on(ROW) or not self._is_last(cmd, tags):
            return None
        if self._is_others(comm):
            # M0 would end that one, if it is paused
            self._logger.info("Not sending %r: the board has a job of its own", cmd)
            return NOTHING
        machine = self._machine()
        return Lines(tuple(self._link.carried(stop_lines(cmd, gcode, machine), machine)))

    def _is_last(self, cmd, tags):
        place = self._files.place(cmd, tags)
        if not place.path:
            return False
        try:
            return _is_last_of(place.path, place.position)
        except OSError as error:
            self._logger.warning("Could not look for the end of the file: %s", error)
            return False


def _is_last_of(path, place):
    """Return whether nothing comes behind a place of a file; reads no more than its last part."""
    place = min(place, os.path.getsize(path))
    with open(path, "rb") as file:
        begin = max(0, place - BEFORE)
        file.seek(begin)
        before = file.read(place - begin)
        behind = file.read(MOST_BEHIND + 1)
    if len(behind) > MOST_BEHIND:
        return False
    return is_at_end(before.decode("utf-8", "replace"), behind.decode("utf-8", "replace"))
