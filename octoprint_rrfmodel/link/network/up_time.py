"""How long a board has been up, by which a reset in a gap is known."""

LATE = 5
"""Seconds by which a board's clock may be late that was not reset."""


class UpTime:
    """Knows what a board told last of its up-time, and when; on the worker alone."""

    def __init__(self):
        self._told, self._at = None, 0.0

    def note(self, model, asked_at):
        """Take it from a model."""
        told = (model.get("state") or {}).get("upTime")
        if told != self._told and type(told) is int:
            self._told, self._at = told, asked_at

    def has_gone_back(self, up_time, asked_at):
        """Return whether the board was reset meanwhile.

        Its clock may have caught up with what it told before.
        """
        if None in (up_time, self._told):
            return False
        return up_time + LATE < self._told + asked_at - self._at

    def forget(self):
        """Know nothing: another board, perhaps."""
        self._told, self._at = None, 0.0
