"""Whoever wants to know of the machine, told in one order.

A listener is any object that has some of these methods; all are called by the plugin's worker:

* ``identified()``: a board with RepRapFirmware has just told what it is.
* ``replied(taken, asked_at)``: a reply was applied (``rrf.follow.follower.Taken``).
* ``warmed(warmed)``: a line has told temperatures while no reply comes
  (``rrf.follow.follower.Warmed``); the rest of the model is as old as before.
* ``reset()``: a reply has shown that the board began anew; the model is empty.
* ``line(text)``: the board has said a line that is neither a reply nor the plugin's own.
* ``heard(what)``: such a line tells of something (``rrf.wire.heard``).
* ``halted(doing)``: an emergency stop goes out on a line that does that (``link.Doing``).
* ``forgotten()``: the connection is gone, and with it what was known.
* ``tick() -> seconds``: called when so many seconds have gone by, or sooner.
"""

import logging


class Listeners:
    """Calls each listener that has the method, in the order of the table.

    One that raises is logged, and the others are called all the same.
    """

    def __init__(self):
        self._table = ()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.listeners")

    def attach(self, table):
        """Take the listeners, in the order in which they are to be called."""
        self._table = tuple(table)

    def identified(self):
        """Tell of a board that is known now; what was known of another is forgotten first."""
        self.forgotten()
        self._call("identified")

    def replied(self, taken, asked_at):
        """Tell of a reply that was applied."""
        if taken.reset:
            self._call("reset")
        else:
            self._call("replied", taken, asked_at)

    def warmed(self, warmed):
        """Tell of temperatures that a line has told, and nothing but those."""
        self._call("warmed", warmed)

    def line(self, text):
        """Tell of a line of text."""
        self._call("line", text)

    def heard(self, what):
        """Tell of what a line of text tells."""
        self._call("heard", what)

    def halted(self, doing):
        """Tell of an emergency stop."""
        self._call("halted", doing)

    def forgotten(self):
        """Tell of the end of a connection."""
        self._call("forgotten")

    def ticks(self):
        """Return the ``tick`` of each listener that has one."""
        return [each.tick for each in self._table if hasattr(each, "tick")]

    def _call(self, name, *arguments):
        for listener in self._table:
            method = getattr(listener, name, None)
            if method is None:
                continue
            try:
                method(*arguments)
            except Exception:
                self._logger.exception("Could not tell %s: %s", listener, name)
