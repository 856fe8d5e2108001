"""Commands on their way to a board's input, which is kept nearly empty.

An emergency stop is only seen if it fits behind what waits in those 255 bytes (3.5 GCodeInput.cpp);
firmware before 3.4.5 loses what doesn't fit without a word. So one command of ours waits at most.
"""

import json

from ...rrf.wire.rr import path_of
from .waiting_lines import WaitingLines

EMPTY = 255
"""Free bytes of an input in which nothing waits."""

LOOK_SECONDS = 0.25
"""Between two looks whether the board has taken what waits."""


class Command(str):
    """A line of G-code, with the tags that it was given."""

    tags = frozenset()

    @classmethod
    def of(cls, line, tags):
        """Return a line with its tags."""
        made = cls(line)
        made.tags = frozenset(tags or ())
        return made


class Outgoing(WaitingLines):
    """Hands commands to the board of ``session`` one by one; ``at`` is when to look again."""

    def __init__(self, session, clock):
        super().__init__()
        self._session = session
        self._clock = clock
        self._free = EMPTY
        self.at = 0.0

    def clear(self):
        self._free = EMPTY
        return super().clear()

    def is_due(self):
        """Return whether there is something to do now."""
        return bool(self._lines) and self._clock() >= self.at

    def next(self):
        """Return the command to send now, ``None`` while the board has one that it didn't take."""
        if self._free < EMPTY:
            self._free = self._told(path_of("gcode"), 0)
            if self._free < EMPTY:
                self._look_later()
                return None
        try:
            return self._lines.popleft()
        except IndexError:
            # an emergency stop has emptied the queue
            return None

    def send(self, line):
        """Send a command; return whether the board has it, else it is the next again."""
        self._free = self._told(path_of("gcode", gcode=line), -1)
        if self._free >= 0:
            return True
        self._lines.appendleft(line)
        self._free = 0
        self._look_later()
        return False

    def _told(self, path, otherwise):
        """Return how many bytes are free, or what stands for a refusal."""
        try:
            told = json.loads(self._session.ask(path))
        except ValueError:
            return otherwise
        free = told.get("buff") if isinstance(told, dict) else None
        return free if type(free) is int else otherwise

    def _look_later(self):
        self.at = self._clock() + LOOK_SECONDS
