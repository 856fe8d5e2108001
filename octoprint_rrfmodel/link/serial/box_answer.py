"""The answer to a message box that a command over this line has opened.

The box's macro has to end before the command is acknowledged, and until then OctoPrint keeps back
all it has, the answer too. So that goes out past OctoPrint's queue. The firmware acknowledges
nothing that it is sent while a macro waits (seen in 3.5.3), but its end: still OctoPrint isn't
given the first ``ok`` behind the answer, which might be the answer's. The board is asked something
then, whose own ``ok`` is the one that OctoPrint waits for; what comes before, ``extra_ok`` takes
out. Nothing is asked earlier: a question in front of the answer to the next box would keep that
from being read where the firmware takes nothing else meanwhile (3.6 and later).
"""

ANSWER = "M292"

QUESTION = "M114"

REPLY = ("X:",)
"""How the line begins that only this question brings; ``ok`` isn't in it."""


class BoxAnswer:
    """Knows whether the awaited command waits in a box; ``link`` is the ``SerialLink``."""

    def __init__(self, link):
        self._link = link
        self._of = None

    def opened(self):
        """Note that the board has asked for an answer; on OctoPrint's receiving thread."""
        if self._link.awaited is not None:
            self._of = self._link.awaited_since

    def is_wanted(self):
        """Return whether the awaited command waits for an answer; any thread may ask."""
        link = self._link
        return self._of is not None and link.awaited is not None and self._of == link.awaited_since

    def give(self, comm, line):
        """Write the answer, once: the next box asks for itself."""
        self._of = None
        # first, for the board may be quick
        self._link.extra_ok.answers_a_box()
        comm._do_send(line, gcode=ANSWER)

    def finds_out(self, comm, line):
        """Return whether a line is the first ``ok`` behind an answer; the board is asked then."""
        extra_ok = self._link.extra_ok
        if not (extra_ok.is_behind_a_box and line.startswith("ok")):
            return False
        extra_ok.asks(REPLY)
        comm._do_send(QUESTION, gcode=QUESTION)
        return True
