"""How much others may ask of the machine in a second."""

import threading

RATE = 20.0
"""Commands, or lines of G-code, a second."""

BURST = 50
"""Commands that may come at once."""


class Rate:
    """Lets so many through in a second; any thread may ask. ``clock()`` is in seconds."""

    def __init__(self, clock):
        self._clock = clock
        self._lock = threading.Lock()
        self._left = float(BURST)
        self._at = clock()

    def allows(self, count=1):
        """Return whether so many more may go through now, and count them if so."""
        with self._lock:
            now = self._clock()
            self._left = min(float(BURST), self._left + (now - self._at) * RATE)
            self._at = now
            if self._left < count:
                return False
            self._left -= count
            return True
