"""Macros: files of the card that run in the place of a command, and the firmware's own."""

from __future__ import annotations

from contextlib import AbstractContextManager

from ..device.activity import Activity
from ..device.card import SYSTEM, Card
from ..line.channel import Channel
from ..line.outcome import Outcome, Running
from ..line.output import Output
from ..text.command import Command, GCodeError
from ..text.serial_line import Reply
from .execution import Interpreter
from .table import UNKNOWN, Row, Rows


class Macros:
    """Runs macros on the channel whose command asks for them; M98, and commands that are files."""

    def __init__(self, *, activity: Activity, card: Card, interpreter: Interpreter, output: Output):
        self.activity = activity
        self._card = card
        self._interpreter = interpreter
        self._output = output

    def rows(self) -> Rows:
        return {"M98": Row(self._run_file), UNKNOWN: Row(self._unknown)}

    def running(self, channel: Channel) -> AbstractContextManager[None]:
        """Return what is entered while the board is busy with a macro on that channel."""
        return self.activity.running_macro(channel)

    def system(self, channel: Channel, *names: str) -> Running:
        """Run the first of these files of ``0:/sys`` that there is."""
        for name in names:
            lines = self._card.lines(f"{SYSTEM}/{name}")
            if lines is not None:
                yield from self._interpreter.macro(channel, lines)
                return

    def file(self, channel: Channel, path: str) -> Running:
        """Run a file with the board being busy, an empty one where there is none."""
        lines = self._card.lines(path) or []
        with self.running(channel):
            yield from self._interpreter.macro(channel, lines)

    def _run_file(self, channel: Channel, command: Command) -> Running:
        """M98: the macro's own replies add no ok."""
        if "P" not in command and "R" not in command:
            raise GCodeError("No P or R parameter")
        if "P" not in command:
            return
        name = command.needed_string("P")
        path = self._card.path_of(name, SYSTEM)
        if self._card.lines(path) is None:
            self._output.text(f"Warning: Macro file {name} not found\n")
            return
        yield from self.file(channel, path)

    def _unknown(self, channel: Channel, command: Command) -> Outcome:
        """Try the command as a macro of its name."""
        lines = self._card.lines(f"{SYSTEM}/{command.name}.g")
        if lines is not None:
            return self._interpreter.macro(channel, lines)
        return Reply(f"Warning: {command.name}: Command is not supported")
