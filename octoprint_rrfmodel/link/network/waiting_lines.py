"""Commands that wait to be sent to a board."""

import collections


class WaitingLines:
    """Keeps them in their order; any thread may add, look and clear."""

    def __init__(self):
        self._lines = collections.deque()

    def add(self, line, first=False):
        """Queue a command; ``first`` goes in front of those that wait."""
        (self._lines.appendleft if first else self._lines.append)(line)

    def lines(self):
        """Return what waits."""
        return list(self._lines)

    def clear(self):
        """Forget what waits, and return it."""
        lines = self.lines()
        self._lines.clear()
        return lines
