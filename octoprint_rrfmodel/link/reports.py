"""What the line tells by itself: temperatures, a message box while the model can't be asked for.

Beside a print on a slow line nobody has to ask for temperatures: OctoPrint does.
"""

TEMPERATURES = "heat.heaters[].current"

FRESH_SECONDS = 2.0
"""Age of the model from which on a report is news; younger, it tells the same in fewer digits."""

SPARING_SECONDS = 1.0
"""The same where each temperature that a report tells is one that needn't be asked for."""


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
        age = self._known.age_of(TEMPERATURES)
        if age is None or age < (SPARING_SECONDS if self._follower.is_sparing else FRESH_SECONDS):
            return
        warmed = self._follower.warm(line)
        if warmed is None:
            return
        if self._follower.rows.came(TEMPERATURES, len(warmed.heaters)):
            self._known.note_report(TEMPERATURES)
        self._warmed(warmed)


class BoxReports:
    """Puts boxes into the model that text has told of; runs on the worker.

    ``follower`` has the model, ``replied(taken, asked_at)`` is told.
    """

    def __init__(self, follower, replied):
        self._follower = follower
        self._replied = replied

    def show(self, box):
        """Show a box, or take it away."""
        # nobody has asked, so that nothing is newer than before
        self._replied(self._follower.show_box(box), 0.0)
