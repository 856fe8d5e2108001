"""What happens on the machine, as events of OctoPrint."""

from ..rrf.views.events import MODEL_READY, NAMES, Chronicle

PREFIX = "plugin_rrfmodel_"


def custom_events(*args, **kwargs):
    """Return the names of the events, in the form of OctoPrint's hook."""
    return list(NAMES)


class MachineEvents:
    """Fires an event for each thing that happens; runs on the worker thread.

    ``fire(name, payload)`` is OctoPrint's.
    """

    def __init__(self, fire):
        self._fire = fire
        self._chronicle = Chronicle()
        self._was_ready = False

    def replied(self, model, is_ready):
        """Find out what has happened since the model before."""
        for happening in self._chronicle.look(model):
            self._fire(PREFIX + happening.name, happening.payload)
        if is_ready and not self._was_ready:
            self._fire(PREFIX + MODEL_READY, {})
        self._was_ready = is_ready

    def heard(self, line):
        """Take a line of text from the printer."""
        self._chronicle.heard(line)

    def forget(self):
        """Begin anew with the next connection."""
        self._chronicle = Chronicle()
        self._was_ready = False
