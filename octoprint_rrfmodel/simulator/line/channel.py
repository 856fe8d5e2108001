"""One G-code channel: a sequential queue of lines, its modal state, and what holds it up."""

from __future__ import annotations

from collections import deque
from typing import Any, Callable

from ..clock import Condition
from ..model.tree import ObjectModel
from ..text.command import BareError, Command
from .outcome import Running

STACK_DEPTH = 10
_STACK_MEMBERS = ("axesRelative", "drivesRelative", "distanceUnit", "feedRate", "selectedPlane")
"""What M120 keeps (RRF 3.5 GCodeMachineState.cpp:41)."""


class Channel:
    """Input, modal state and the running command of one channel; ``write`` sends its replies.

    A channel that doesn't echo has nobody who waits for an ``ok``: what its commands answer goes to
    everybody.
    """

    def __init__(
        self, name: str, model: ObjectModel, write: Callable[[str], None], *, echoes: bool = True
    ):
        self.name = name
        self._model = model
        self.write = write
        self.echoes = echoes
        self.restart()

    def restart(self) -> None:
        """Forget everything; a command that runs is ended where it waits."""
        self.lines: deque[str] = deque()
        self.pending: deque[Command] = deque()
        """Commands of a line that has been read."""
        self.running: Running | None = None
        self.wait: Condition | None = None
        """What the running command waits for."""
        self.current: Command | None = None
        self._stack: list[dict[str, Any]] = []
        self.macro_depth = 0
        self.macros = 0
        """Macros of the firmware's own that run, homing and the like."""
        self.upload: Callable[[str], None] | None = None
        """Where lines go between M28 and M29."""
        self.status_request: str | None = None
        """The last of M105, M408 S0 and M409 that came on this channel."""
        self.requires_checksum = False
        self.awaits_acknowledgement = False
        self.is_lost_in_box = False
        """Whether its macro waits for an answer to a box that none can be given to."""
        self.is_stuck = False
        self.line_number: int | None = None
        """Number of the line that is being run, ``None`` without one."""
        self.line_count = 0
        """Lines received since the restart."""
        self.blocked_since: float | None = None
        self.reported_at = 0.0
        self.variables: dict[str, Any] = {}

    @property
    def input(self) -> dict[str, Any]:
        """The channel's element of ``inputs``."""
        return self._model.input(self.name)

    @property
    def is_blocked(self) -> bool:
        return self.running is not None

    @property
    def is_idle(self) -> bool:
        return self.running is None and not self.pending and not self.lines

    def has_finished(self) -> bool:
        """Return whether it is idle, as a condition to wait for."""
        return self.is_idle

    @property
    def is_marlin(self) -> bool:
        return bool(self.input["compatibility"] == "Marlin")

    @property
    def state(self) -> str:
        """As ``inputs[].state`` names it."""
        if self.awaits_acknowledgement:
            return "awaitingAcknowledgement"
        if self.wait is not None:
            return "waiting"
        if self.current is not None:
            return "executing"
        return "idle"

    @property
    def is_in_macro(self) -> bool:
        return self.macros > 0 or self.macro_depth > 0

    def push(self) -> None:
        """Keep the modal state (M120)."""
        if len(self._stack) >= STACK_DEPTH:
            raise BareError(f"Push(): stack overflow on {self.name}")
        channel = self.input
        self._stack.append({name: channel.get(name) for name in _STACK_MEMBERS if name in channel})
        self.input["stackDepth"] = len(self._stack)

    def pop(self) -> None:
        """Go back to the modal state kept last (M121)."""
        if not self._stack:
            raise BareError(f"Pop(): stack underflow on {self.name}")
        self.input.update(self._stack.pop())
        self.input["stackDepth"] = len(self._stack)

    def abandon(self, keep_input: bool = False) -> None:
        """Forget what runs, and what has come in unless that is to be kept."""
        if not keep_input:
            self.lines.clear()
        self.pending.clear()
        self.running = self.current = self.wait = None
        self.macro_depth = 0
        self.upload = None
        self.blocked_since = None
        self.awaits_acknowledgement = self.is_lost_in_box = False

    def acknowledged(self) -> None:
        """Go on after the message box that the channel has opened."""
        self.awaits_acknowledgement = False
