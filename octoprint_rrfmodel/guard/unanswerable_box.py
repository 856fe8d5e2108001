"""A message box that waits on OctoPrint's line, where the firmware takes no answer to it there."""

from ..rrf.views.machine import Machine
from ..rrf.views.warnings import UNANSWERABLE, alerts, loses_boxes


class UnanswerableBox:
    """Remembers that the firmware asked for M292, until it answers something else again.

    A macro that OctoPrint has started holds the line while its box is open, so that no reply can
    tell of it. ``model()`` is the snapshot.
    """

    def __init__(self, model, clock):
        self._model = model
        self._clock = clock
        self._opened_at = None

    @property
    def is_open(self):
        """Whether nobody can answer the box over USB."""
        return self._opened_at is not None

    @property
    def is_waiting(self):
        """Whether such a box is open, by the text or by the model."""
        return self.is_open or UNANSWERABLE in alerts(self._model())

    def opened(self):
        """Note the text that comes with a box."""
        if loses_boxes(Machine(self._model()).version):
            self._opened_at = self._clock()

    def answered(self, asked_at):
        """Note a reply: asked for after the text, it shows that the line is free."""
        if self._opened_at is not None and asked_at > self._opened_at:
            self._opened_at = None

    def forget(self):
        """Know of no box: the connection is gone."""
        self._opened_at = None
