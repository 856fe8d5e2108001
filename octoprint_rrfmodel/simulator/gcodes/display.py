"""What people see and hear: M42, M117, M118, M300, M550."""

from __future__ import annotations

import re

from ..clock import Clock
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome
from ..line.output import Output
from ..line.replies import Replies
from ..model.tree import ObjectModel
from ..text.command import Command, GCodeError

TO_ALL, TO_USB, TO_HTTP = 0, 1, 3
"""``P`` of M118."""


class Display:
    """Shows texts, beeps, names the machine and sets its outputs."""

    def __init__(self, *, model: ObjectModel, clock: Clock, output: Output, replies: Replies):
        self._model = model
        self._clock = clock
        self._output = output
        self._say_to = {
            TO_ALL: output.text,
            TO_USB: output.to_usb,
            TO_HTTP: replies.writer("HTTP"),
        }

    def rows(self) -> Rows:
        return {
            "M42": Row(self._output_port),
            "M117": Row(self._display),
            "M118": Row(self._say),
            "M280": Row(self._output_port),
            "M300": Row(self._beep),
            "M550": Row(self._name_machine),
        }

    def _display(self, channel: Channel, command: Command) -> Outcome:
        """M117: the text goes to the model, not to USB."""
        self._model.data["state"]["displayMessage"] = command.unquoted_text()
        self._model.bump("state")
        return None

    def _say(self, channel: Channel, command: Command) -> Outcome:
        """M118: P1 to USB, P3 to the network, P0 to all."""
        text = command.needed_string("S")
        say = self._say_to.get(command.integer("P", TO_ALL) or TO_ALL)
        if say is not None:
            say(text + "\n")
        return None

    def _beep(self, channel: Channel, command: Command) -> Outcome:
        """M300: in the model for as long as it sounds."""
        duration = command.integer("P", 100) or 0
        self._model.data["state"]["beep"] = {
            "duration": duration,
            "frequency": command.integer("S", 4600) or 0,
        }
        self._model.bump("state")
        self._clock.after_seconds(duration / 1000, self._silence)
        return None

    def _silence(self) -> None:
        self._model.data["state"]["beep"] = None
        self._model.bump("state")

    def _name_machine(self, channel: Channel, command: Command) -> Outcome:
        """M550."""
        name = command.string("P")
        network = self._model.data.get("network") or {}
        if name is None:
            return f"RepRap name: {network.get('name')}"
        network["name"] = name
        network["hostname"] = re.sub(r"[^A-Za-z0-9]", "", name).lower() or "duet"
        self._model.bump("network")
        return None

    def _output_port(self, channel: Channel, command: Command) -> Outcome:
        """M42 and M280: ``state.gpOut``; a port that isn't there is no error."""
        ports = self._model.data["state"].get("gpOut") or []
        for letter in "PS":
            if letter not in command:
                raise GCodeError(f"missing parameter '{letter}'")
        number, value = command.integer("P", 0) or 0, command.number_of("S", 0.0) or 0.0
        if 0 <= number < len(ports) and ports[number] is not None:
            ports[number]["pwm"] = min(1.0, value / 255 if value > 1 else value)
        return None
