"""Restarts: what the board forgets, and what becomes of the port meanwhile."""

from __future__ import annotations

from typing import Callable

from ..line.output import Output
from ..line.plug import Plug
from ..line.usb_input import UsbInput

START_SECONDS = 1.0
"""From a power-up until the port is back."""


class Restart:
    """Restarts the board; whoever forgets something then has registered for it."""

    def __init__(self, *, plug: Plug, usb_input: UsbInput, output: Output):
        self._plug = plug
        self._usb_input = usb_input
        self._output = output
        self._steps: list[Callable[[], None]] = []

    def register(self, *steps: Callable[[], None]) -> None:
        """Let these be called at every restart, in the order of registration."""
        self._steps += steps

    def reset(self) -> None:
        """Restart; the port stays, what was to be sent is lost."""
        self._output.discard()
        self._usb_input.discard()
        for step in self._steps:
            step()

    def power_cycle(self) -> None:
        """Restart with USB enumerating anew: the port is gone for a second."""
        self.unplug(START_SECONDS)
        self.reset()

    def unplug(self, seconds: float) -> None:
        """Let the port vanish for so many simulated seconds; opened ports are dead for good."""
        self._plug.pull(seconds)
        self._output.discard()
        self._usb_input.discard()
