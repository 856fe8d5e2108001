"""Messages to the open pages, handed to OctoPrint by a thread of their own.

OctoPrint calls one receiver after the other, and plugins may have registered some: one that waits
would stop whoever tells something, the guard of a print among them.
"""

from ..link.worker import Worker

MOST_WAITING = 100
"""Messages that wait for a receiver that hangs; what comes after them is told no more."""


NEEDED = {"console": ("MONITOR_TERMINAL",)}
"""The permissions that a message needs beside READ, by its type."""


class Pages:
    """Tells the pages in order; any thread may call ``tell``.

    ``send(message)`` may take long. ``receivers()`` are those that OctoPrint hands messages to:
    open pages, and plugins that registered for them.
    """

    def __init__(self, send, receivers):
        self._receivers = receivers
        self._worker = Worker("rrfmodel.pages")
        self._worker.attach({"tell": send})
        self.start = self._worker.start
        self.stop = self._worker.stop

    def tell(self, message):
        """Have the pages told, and return."""
        if self._worker.waiting < MOST_WAITING:
            self._worker.notify("tell", message)

    def are_there(self):
        """Return whether anybody would be told."""
        return bool(self._receivers())

    def are_behind(self):
        """Return whether an earlier message has not been taken yet."""
        return self._worker.waiting > 0
