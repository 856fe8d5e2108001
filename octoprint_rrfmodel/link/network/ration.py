"""How often a board is asked what can wait: three times a second at most, of any ten seconds."""

AT_ONCE = 6
"""Questions in a row that wait for nothing: a page that is opened, a key that has changed."""

A_SECOND = 2.0
"""With those in a row 26 in any ten seconds; what waits for nothing is counted with them."""


class Ration:
    """A bucket of questions that fills by itself, one thread's. ``clock`` gives seconds."""

    def __init__(self, clock, at_once=AT_ONCE, a_second=A_SECOND):
        self._clock = clock
        self._most = at_once
        self._a_second = a_second
        self._left = float(at_once)
        self._at = clock()

    def wait(self, spare=0):
        """Return the seconds until the next question may go out, 0 for now.

        ``spare`` is how many others are to be free to go out at once behind it.
        """
        self._fill()
        return max(0.0, (1.0 + spare - self._left) / self._a_second)

    def take(self):
        """Note that a question goes out."""
        self._fill()
        self._left = max(0.0, self._left - 1.0)

    def take_spare(self):
        """Note what waits for nothing; one question may go out behind it all the same."""
        self._fill()
        self._left = max(min(self._left, 1.0), self._left - 1.0)

    def _fill(self):
        now = self._clock()
        self._left = min(self._most, self._left + (now - self._at) * self._a_second)
        self._at = now
