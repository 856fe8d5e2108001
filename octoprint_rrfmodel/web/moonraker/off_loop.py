"""Work for sockets that may take long, off Tornado's loop, on which OctoPrint's server waits."""

from concurrent.futures import ThreadPoolExecutor


class OffLoop:
    """One thread, which works through what it is given in order; called on Tornado's loop."""

    def __init__(self, loop):
        self._loop = loop
        self._executor = ThreadPoolExecutor(1, "rrfmodel.sockets")

    def run(self, function, then=None):
        """Return a future of ``function()``; ``then`` is called with it when it is done.

        Both are the loop's: whoever waits for one does so there, and lets others have their turn.
        """
        future = self._loop.run_in_executor(self._executor, function)
        if then is not None:
            self._loop.add_future(future, then)
        return future
