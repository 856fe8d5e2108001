"""The ``ok`` too many: the one that a line of several commands brings when a move on it fails.

The last command on the line has been read already when the move before it fails, and it is
acknowledged too, in the very next line (3.5 GCodeBuffer.cpp:442, GCodes4.cpp:48-80).

And the one that was late: it comes after the question whose ``ok`` OctoPrint gets in its place
(``lost_ok``), and in front of the answer.
"""

from ...rrf.wire.gcode_words import KEEPS_MODES

COUNTS_ALL = ("_unknownCommandsNeedAck", "_unknown_commands_need_ack")
"""Attribute of OctoPrint's connection, in 1.11 and in 2.0: whether it waits for an ok behind what
it takes for no command."""

BLAMED = ("M121", "G0/G1")
"""What the error of such a move names: the command behind it from 3.5 on, before that the move."""


class ExtraOk:
    """Watches for that ``ok``, so that OctoPrint doesn't count it."""

    def __init__(self):
        self.awaits = None
        """``error``, ``ok``, ``extra``, ``answer`` or ``box``: what decides next; ``None`` where
        nothing may come."""
        self._answer = ()

    def asks(self, answer):
        """Note that a question goes out past OctoPrint, and how the answer's line begins."""
        self._answer = answer
        self.awaits = "answer"

    def answers_a_box(self):
        """Note that an answer to a message box goes out past OctoPrint."""
        self.awaits = "box"

    @property
    def is_behind_a_box(self):
        """Whether the next ``ok`` may be that answer's."""
        return self.awaits == "box"

    def given_up(self):
        """Note that OctoPrint goes on without the ``ok`` that it has waited for."""
        if self.awaits == "answer":
            self.awaits = None

    def sending(self, cmd, gcode):
        """Note that a command goes out; only a move with M121 behind it may bring one.

        While nothing is awaited other commands than M120 change nothing.
        """
        if self.awaits not in ("extra", "answer"):
            self.awaits = "error" if gcode == KEEPS_MODES and " G1 " in cmd else None

    def is_in(self, line):
        """Return whether a line is the ``ok`` too many; call it with each one while it awaits."""
        awaits = self.awaits
        if awaits == "answer":
            return self._is_late(line)
        if awaits == "box":
            return False
        if awaits == "extra":
            self.awaits = None
            return line.strip() == "ok"
        if line.startswith("ok"):
            self.awaits = "extra" if awaits == "ok" else None
        elif line.startswith("Error:") and any(blamed in line for blamed in BLAMED):
            self.awaits = "ok"
        return False

    def _is_late(self, line):
        """Return whether a line is an ``ok`` from before the question was read."""
        if line.startswith(self._answer):
            # the ok that it begins with, or the next one, is the question's own
            self.awaits = None
            return False
        return line.startswith("ok")


def count_ok(comm):
    """Let OctoPrint wait for the ok of a line that is about to go out and no command to it.

    The board acknowledges ``X20 Y5`` and ``T-1`` too. OctoPrint would take that ok for another
    line's, and send all such lines of a file at once.
    """
    if not any(getattr(comm, name, False) for name in COUNTS_ALL):
        comm._clear_to_send.clear()
