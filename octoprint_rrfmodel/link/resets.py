"""A reset of the board that its model can't show: its clock has caught up with what was known."""

from ..rrf.follow.follower import Taken


class Resets:
    """Begins anew with a board; runs on the worker."""

    def __init__(self, follower, poller, listeners):
        self._follower = follower
        self._poller = poller
        self._listeners = listeners

    def note(self):
        """Note that the board was reset, as somebody else has found out."""
        self._follower.resets += 1
        self._poller.forgotten()
        self._poller.identified()
        self._listeners.replied(Taken({}, True), 0.0)
