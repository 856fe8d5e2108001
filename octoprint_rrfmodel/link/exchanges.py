"""What polls have asked lately and what was answered, for a support bundle.

All of it runs on the worker, a few times a second: nothing is decoded, and lines of a print don't
come by here.
"""

import collections

MOST_LENGTH = 200_000
"""Characters that are kept: about forty whole answers, or the parts of two minutes."""

SENT, RECEIVED, REFUSED = "sent", "received", "refused"


class Exchanges:
    """Notes what goes by on its way to the poller; the oldest goes when there is too much.

    ``poller`` knows what it asks, ``clock`` is the plugin's.
    """

    def __init__(self, poller, clock):
        self._poller = poller
        self._clock = clock
        self._noted = collections.deque()
        self._length = 0

    def latest(self):
        """Return what was said, oldest first, as ``(seconds ago, direction, text)``; any thread."""
        now = self._clock()
        return [(round(now - at, 2), direction, text) for at, direction, text in self._copy()]

    def _copy(self):
        while True:
            try:
                return list(self._noted)
            except RuntimeError:
                # the worker has noted something meanwhile
                continue

    ##~~ notes, on the worker

    def poll_sent(self, at, number=None):
        """Note that the poll went out."""
        asked = self._poller.asked()
        if asked is not None:
            self._note(at, SENT, asked)
        self._poller.poll_sent(at, number)

    def reply(self, text, number=None):
        """Note what was found on the line."""
        self._note(self._clock(), RECEIVED, text)
        self._poller.reply(text, number)

    def refused(self, line):
        """Note a line that says that a command isn't known."""
        self._note(self._clock(), REFUSED, line)
        self._poller.refused(line)

    def _note(self, at, direction, text):
        text = text[:MOST_LENGTH]
        self._noted.append((at, direction, text))
        self._length += len(text)
        while self._length > MOST_LENGTH:
            self._length -= len(self._noted.popleft()[-1])
