"""What the board's network channel is busy with, from what was sent and what the model tells."""

from typing import NamedTuple

from ...rrf.gcode.blocking import SETTLING, TARGETING, may_change
from ...rrf.gcode.plain_lines import name_of
from ...rrf.views.channels import channel_called

CHANNEL = "HTTP"

IDLE = "idle"


class Sent(NamedTuple):
    """A command that went out."""

    line: str
    gcode: str
    at: float
    is_done: bool = False
    """Whether it is known to be through, and the model only has to show it."""

    @property
    def changes(self):
        """Whether what was known of axes, heat and tools may be wrong once it is through."""
        return self.gcode in SETTLING or may_change(self.gcode, self.line)


class UnderWay:
    """Knows the last command; ``model()`` is the snapshot."""

    def __init__(self, model, clock):
        self._model = model
        self._clock = clock
        self.last = None
        """The command that the board may still be busy with."""
        self.settled_at = 0.0
        self.target_command_at = 0.0
        self.tool_command_at = 0.0

    def sent(self, line):
        """Note a command that went out."""
        now = self._clock()
        before, self.last = self.last, Sent(line, gcode_of(line), now)
        if before is not None and before.changes and not self.last.changes:
            # it may still run: what changes counts for longer
            self.last = before._replace(at=now)
        if self.last.gcode in TARGETING:
            self.target_command_at = now
        if self.last.gcode in ("T", "M109"):
            self.tool_command_at = now

    def done(self, line):
        """Note that a command is through."""
        last = self.last
        if last is not None and last.line == line:
            self.last = last._replace(at=self._clock(), is_done=True) if last.changes else None

    def replied(self, asked_at, dialect):
        """Look whether the channel is through with it."""
        last = self.last
        if last is None or asked_at < last.at + dialect.settle_seconds or dialect.is_executing:
            return
        if channel_called(self._model(), CHANNEL).get("state", IDLE) == IDLE:
            if last.changes:
                # this very answer is newer than it
                self.settled_at = last.at
            self.last = None

    def is_changing(self, waiting):
        """Return whether a command that may change something waits or is under way."""
        last = self.last
        return (last is not None and last.changes) or any(
            may_change(gcode_of(line), line) for line in waiting
        )

    def forget(self):
        """Know of none: the connection is gone."""
        self.last = None
        self.settled_at = self.target_command_at = self.tool_command_at = 0.0


def gcode_of(line):
    """Return the code of a line as the tables of commands have it."""
    return name_of(line).partition(".")[0]
