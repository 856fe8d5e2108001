"""What the plugin gives to OctoPrint of its own accord, where it may wait.

OctoPrint queues a command on the thread of whoever gives it, and calls the hooks of other plugins
there: one that waits would stop the worker, and the guard of a print with it.
"""

from .worker import Worker


class Sender:
    """Calls functions one after the other, in the order in which they came."""

    def __init__(self):
        self._worker = Worker("rrfmodel.sender")
        self._worker.attach({"call": lambda function, *arguments: function(*arguments)})
        self.start = self._worker.start
        self.stop = self._worker.stop

    def later(self, function, *arguments):
        """Have a function called, and return."""
        self._worker.notify("call", function, *arguments)
