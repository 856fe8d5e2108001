"""What was said on the line, for the page's Console: who may watch OctoPrint's terminal sees it.

``GET /plugin/rrfmodel/console?since=`` has the latest lines, and pages are pushed
``{"type": "console", "lines": [...], "missed": n, "at"}``. A line is ``{"number", "message",
"time", "type", "asked"}``: ``type`` is ``command`` or ``response`` as in Moonraker, and ``asked``
says whether a person gave the command or is answered by the line, by the plugin's own means.
"""

from flask_babel import gettext
from octoprint.access.permissions import Permissions

from ..host.answers import answer, may_read, refusal

MOST_LINES = 500
"""Lines that one answer has."""

MOST_PUSHED = 100
"""Lines that one message has; a macro that says more is read in the console as it opens."""

SHORTEST_SECONDS = 0.3


class Console:
    """Gives the lines of the store to those who may see them; a listener.

    ``store`` keeps them, ``pages`` reach the open pages.
    """

    def __init__(self, store, pages, clock):
        self._store = store
        self._pages = pages
        self._clock = clock
        self._told = 0
        self._looked_at = 0.0

    def get_console(self, arguments):
        """Return the latest lines, with ``since`` those behind that number (Flask)."""
        if not (may_read() and Permissions.MONITOR_TERMINAL.can()):
            return refusal(403, gettext("You may not watch OctoPrint's terminal."))
        since = arguments.get("since", "0")
        if not (since.isascii() and since.isdigit() and len(since) < 16):
            return refusal(400, gettext("since is the number of a line."))
        return answer({"lines": self._store.since(int(since))[-MOST_LINES:]})

    def tick(self):
        """Push what was said; return the seconds until something may be."""
        now = self._clock()
        due = self._looked_at + SHORTEST_SECONDS - now
        if due > 0:
            return due
        self._looked_at = now
        if not self._pages.are_there():
            # a page that opens reads what was said until then
            self._told = self._store.newest
        if self._told == self._store.newest or self._pages.are_behind():
            return SHORTEST_SECONDS
        lines = self._store.since(self._told)
        if lines:
            self._told = lines[-1]["number"]
            missed = max(0, len(lines) - MOST_PUSHED)
            self._pages.tell(
                {
                    "type": "console",
                    "lines": lines[missed:],
                    "missed": missed,
                    "at": round(now, 3),
                }
            )
        return SHORTEST_SECONDS
