"""What happens on the machine, as events of OctoPrint."""

from ..rrf.views.events import BOX_UNANSWERABLE, MODEL_READY, NAMES, Chronicle

PREFIX = "plugin_rrfmodel_"


def custom_events(*args, **kwargs):
    """Return the names of the events, in the form of OctoPrint's hook."""
    return list(NAMES)


class MachineEvents:
    """Fires an event for each thing that happens; a listener.

    ``fire(name, payload)`` is OctoPrint's. ``known`` is what is known of the machine, ``boxes`` of
    message boxes that hold the line.
    """

    def __init__(self, fire, known, boxes):
        self._fire = fire
        self._known = known
        self._boxes = boxes
        self._was_held = False
        self._chronicle = Chronicle()
        self._was_ready = False

    def replied(self, taken, asked_at):
        """Find out what has happened since the model before."""
        self._was_held = self._boxes.holds_the_line()
        self._look()

    def reset(self):
        """Tell that the board began anew."""
        self._look()

    def _look(self):
        for event in self._chronicle.look(self._known.model()):
            self._fire(PREFIX + event.name, event.payload)
        is_ready = self._known.is_ready()
        if is_ready and not self._was_ready:
            self._fire(PREFIX + MODEL_READY, {})
        self._was_ready = is_ready

    def heard(self, what):
        """Tell of a box that holds the line; no model will."""
        is_held = self._boxes.holds_the_line()
        if is_held and not self._was_held:
            self._fire(PREFIX + BOX_UNANSWERABLE, {})
        self._was_held = is_held

    def line(self, line):
        """Take a line of text from the printer."""
        self._chronicle.heard(line)

    def forgotten(self):
        """Begin anew with the next connection."""
        self._chronicle = Chronicle()
        self._was_ready = False
