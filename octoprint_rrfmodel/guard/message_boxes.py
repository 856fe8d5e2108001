"""Message boxes: those that hold the line, and answers on their way."""

import collections

from ..rrf.gcode.commands import identity_of_box
from ..rrf.views.machine import Machine
from ..rrf.views.told_box import FIRST_NUMBER, MOST_LINES, box_told
from ..rrf.views.warnings import UNANSWERABLE, loses_boxes, warnings_of

ANSWER_SECONDS = 10.0
"""Time after which an answer to a message box is no longer waited for."""


BOX_WAITS = "box_waits"
"""The code of the notification that nothing goes on until somebody answers elsewhere."""

AT_WORK = ("heating", "long_command")
"""Why no poll goes out while a command is under way that may have opened a box."""


class MessageBoxes:
    """Remembers that the firmware asked for M292, until it answers something else again.

    A macro that OctoPrint has started holds the line while its box is open, so that no reply can
    tell of it. From 3.5.0 to 3.6.0 nothing that is sent over this line ends it, and nothing but
    text comes back: somebody answers elsewhere, or restarts the board. On other firmware the text
    is shown as the box that it is, and its answer goes past what is queued. ``model()`` is the
    snapshot, ``link`` the line, ``tell(code)`` reaches the pages, ``show(box)`` puts a box into the
    model, ``None`` for none.
    """

    def __init__(self, model, clock, *, link, tell, show):
        self._model = model
        self._clock = clock
        self._link = link
        self._tell = tell
        self._show = show
        self._opened_at = None
        self._answered, self._answered_at = None, 0.0
        self._lines = collections.deque(maxlen=MOST_LINES)
        self._next = FIRST_NUMBER
        self._is_shown = False

    @property
    def is_open(self):
        """Whether nobody can answer the box over this line."""
        return self._opened_at is not None

    def holds_the_line(self):
        """Return whether the line waits for somebody to answer a box; any thread may ask."""
        return self.is_open and self._link.blocked() in AT_WORK

    def wait_for_a_person(self):
        """Return whether the line waits for somebody to answer a box, here or elsewhere."""
        return self._link.waits_in_a_box() or self.holds_the_line()

    @property
    def is_waiting(self):
        """Whether such a box is open, by the text or by the model."""
        return self.is_open or UNANSWERABLE in warnings_of(self._model())

    ##~~ a listener

    def heard(self, what):
        """Note the text that comes with a box."""
        if what == "box" and loses_boxes(Machine(self._model()).version):
            was_open = self.is_open
            self._opened_at = self._clock()
            if not was_open and self.holds_the_line():
                self._tell(BOX_WAITS)
        if what == "box":
            self._look_back()

    def line(self, text):
        """Note a line of text, which may be the last of a box."""
        self._lines.append(text)
        self._look_back()

    def _look_back(self):
        """Show the box that lines of text tell of, where the line waits for its answer.

        Which is noted first, the line or that it is one of a box, is OctoPrint's affair.
        """
        if not self._link.waits_in_a_box() or loses_boxes(Machine(self._model()).version):
            return
        box = box_told(self._lines)
        if box is not None:
            self._lines.clear()
            # no number of the board's, and another one for each
            self._is_shown = True
            self._show({**box, "seq": self._next})
            self._next += 1

    def tick(self):
        """Take the box away that is answered, or whose macro is through."""
        if self._is_shown and not self._link.waits_in_a_box():
            self._is_shown = False
            self._show(None)
        return 0.25 if self._is_shown else 60.0

    def replied(self, taken, asked_at):
        """Note a reply: asked for after the text, it shows that the line is free."""
        if self._opened_at is not None and asked_at > self._opened_at:
            self._opened_at = None

    def forgotten(self):
        """Know of no box: the connection is gone."""
        self._opened_at = None
        self._is_shown = False
        self._lines.clear()

    ##~~ answers, from any thread

    def note_answer(self):
        """Note that the box that the model shows is about to be answered."""
        self._answered = identity_of_box(self._model())
        self._answered_at = self._clock()

    def is_answered(self):
        """Return whether the model still shows the box that was answered last.

        Before 3.5 an answer names no box: a second one would be for the next, which nobody has
        read yet.
        """
        if self._answered is None or self._clock() - self._answered_at > ANSWER_SECONDS:
            return False
        return identity_of_box(self._model()) == self._answered
