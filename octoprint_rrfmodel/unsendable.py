"""Commands that would hang the line, dropped on their way through the queuing hook."""

import logging

from .rrf.unsendable import unsendable


class UnsendableCommands:
    """Says which commands are better not sent, whoever wants to.

    ``machine()`` is the view of the model that it depends on. ``is_on(row)`` says whether a row
    of the table is switched on. ``refused(code, detail)`` only takes note.
    """

    def __init__(self, machine, is_on, refused):
        self._machine = machine
        self._is_on = is_on
        self._refused = refused
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.unsendable")

    def drops(self, cmd, gcode):
        """Return whether a command isn't to be sent; who waits for it is told."""
        row = unsendable(cmd, gcode, self._machine())
        if row is None or not self._is_on(row.name):
            return False
        self._logger.info("Not sending %r: %s", cmd, row.reason)
        if row.is_told:
            self._refused(row.name, cmd)
        return True
