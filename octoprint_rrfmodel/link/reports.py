"""Temperatures that the line tells by itself, while the model can't be asked for."""

FRESH_SECONDS = 2.0
"""Age of the model from which on a report is news; younger, it tells the same in fewer digits."""


class TemperatureReports:
    """Puts reports into the model; runs on the worker.

    ``follower`` has the model, ``known`` knows how old it is, and ``warmed(changes, heaters)`` is
    told which heaters a report has told of.
    """

    def __init__(self, follower, known, warmed):
        self._follower = follower
        self._known = known
        self._warmed = warmed

    def take(self, line):
        """Take a line that may be a report."""
        age = self._known.age()
        if age is None or age < FRESH_SECONDS:
            return
        warmed = self._follower.warm(line)
        if warmed is not None:
            self._warmed(warmed)
