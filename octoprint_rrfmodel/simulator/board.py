"""The device: a mainboard with its firmware, machine, card and channels, without any I/O."""

from __future__ import annotations

import time
from collections.abc import Iterable, Mapping
from typing import Any, Callable, NamedTuple

from .core import Core
from .hardware.blank import INPUT_NAMES

STEP = 0.25
"""Longest step of simulated time while something is going on, in seconds."""
IDLE_STEP = 10.0
"""Longest step while nothing but temperatures can change."""
THERMAL_STEP = 0.1
RECEIVE_BUFFER = 512
"""Bytes that the board takes from USB while it is busy; the host has to wait with the rest."""


class Received(NamedTuple):
    """A line as it came in on USB."""

    time: float
    text: str


class Board(Core):
    """A RepRapFirmware board: bytes in, bytes out, and simulated time in between.

    ``machine`` and ``firmware`` are names from :mod:`.machines` and :mod:`.firmware`; ``model``
    replaces the machine's own object model; ``faults`` are texts as on the command line. Time goes
    on only in :meth:`advance`, which :meth:`receive` and :meth:`transmit` call.
    """

    def __init__(
        self,
        machine: str = "cartesian",
        firmware: str = "3.5.3",
        *,
        model: Mapping[str, Any] | None = None,
        faults: Iterable[str] = (),
        speed: float = 1.0,
        clock: Callable[[], float] = time.monotonic,
    ):
        super().__init__(machine, firmware, model)
        self._speed = speed
        self._clock = clock
        self._started_at = clock()
        self._started_now = 0.0
        self.log: list[Received] = []
        for text in faults:
            self.inject(text)

    def begin(self) -> None:
        self._input = bytearray()
        self._thermal_at = self.now
        super().begin()
        self._used_channels = [self.channels["USB"], self.channels["File"]]

    @property
    def model(self) -> dict[str, Any]:
        """The current object model; hold :attr:`lock` to change it, :meth:`bump` to announce it."""
        with self.lock:
            self.refresh()
            return self.data

    @property
    def speed(self) -> float:
        """Simulated seconds in a second of the clock; may be changed at any time."""
        return self._speed

    @speed.setter
    def speed(self, value: float) -> None:
        with self.lock:
            self.advance()
            self._started_at, self._started_now = self._clock(), self.now
            self._speed = value

    @property
    def has_room(self) -> bool:
        """Whether the board takes further bytes; a busy channel leaves them in its buffer."""
        usb = self.channels["USB"]
        waiting = len(self._input) + sum(len(line) + 1 for line in usb.lines)
        return waiting < RECEIVE_BUFFER

    def receive(self, data: bytes) -> None:
        """Take bytes from the host on USB."""
        with self.lock:
            self.advance()
            if not self.is_plugged_in:
                return
            self._input += data
            self._read_lines()
            self._pump()

    def transmit(self) -> bytes:
        """Return the bytes sent to USB since the last call."""
        with self.lock:
            self.advance()
            return self.output.take()

    def advance(self) -> None:
        """Let simulated time go on to the clock."""
        with self.lock:
            passed = self._clock() - self._started_at
            target = self._started_now + passed * self._speed
            if self.now >= target:
                self._pump()
            while self.now < target:
                step = STEP if self._has_work() else IDLE_STEP
                self._step(min(target, self.now + step, max(self.motion.next_end, self.now)))

    def execute(self, gcode: str, channel: str = "http") -> str:
        """Run G-code on another channel and return what it has replied so far.

        Several lines are run one after the other; a command that takes its time goes on in
        simulated time, its reply is part of a later call's answer.
        """
        with self.lock:
            self.advance()
            name = next((n for n in INPUT_NAMES if n.lower() == channel.lower()), None)
            if name is None or name == "USB":
                raise ValueError(f"no channel {channel!r} to execute on")
            used = self.channels[name]
            if used not in self._used_channels:
                self._used_channels.append(used)
            used.lines.extend(gcode.splitlines())
            self._pump()
            return "".join(self.texts.pop(name, ()))

    def inject(self, fault: str) -> None:
        """Switch a fault on, ``name`` or ``name:argument``."""
        with self.lock:
            self.faults.inject(fault)

    def clear(self, fault: str) -> None:
        """Switch a fault off."""
        with self.lock:
            self.faults.clear(fault)

    def unplug(self, seconds: float) -> None:
        with self.lock:
            super().unplug(seconds)
            self._input.clear()

    def received(self) -> list[str]:
        """Return the lines received on USB."""
        with self.lock:
            return [entry.text for entry in self.log]

    def _read_lines(self) -> None:
        """Cut the input at CR and LF, both of which end a line."""
        if b"\r" in self._input:
            self._input = self._input.replace(b"\r", b"\n")
        *lines, rest = self._input.split(b"\n")
        if not lines:
            return
        self._input = rest
        usb = self.channels["USB"].lines
        for line in lines:
            if line:
                text = line.decode("utf-8", "surrogateescape")
                self.log.append(Received(self.now, text))
                usb.append(text)

    def _has_work(self) -> bool:
        """Return whether something waits for a moment in time."""
        return bool(
            self.pending
            or self.motion.is_moving
            or self.job.is_printing
            or self.boxes.current
            or self.faults.names()
            or not all(channel.is_idle for channel in self._used_channels)
        )

    def _step(self, until: float) -> None:
        seconds = until - self.now
        self.now = until
        self.motion.follow(until)
        if until - self._thermal_at >= THERMAL_STEP:
            self.thermal.step(until - self._thermal_at)
            self._thermal_at = until
        self.job.step(seconds)
        self.boxes.expire()
        self._pump()
        self._report_while_blocked()
        self.faults.tick()

    def _pump(self) -> None:
        """Let every channel do what it can do now."""
        self.motion.follow(self.now)
        if self.pending:
            due = [entry for entry in self.pending if entry[0]()]
            self.pending = [entry for entry in self.pending if entry not in due]
            for _, action in due:
                action()
        is_stalled = self.faults.is_on("stall")
        for channel in self._used_channels:
            if not (is_stalled and channel.name == "USB"):
                channel.pump()
        file_channel = self.channels["File"]
        while self.job.is_running:
            position = self.job.position
            self.job.feed()
            file_channel.pump()
            if self.job.position == position or not file_channel.is_idle:
                break

    def _report_while_blocked(self) -> None:
        """Send temperatures while USB waits (RRF 3.3 GCodes.cpp:4620, 3.5 GCodes.cpp:4865)."""
        usb = self.channels["USB"]
        if usb.blocked_since is None or usb.input["compatibility"] != "Marlin":
            return
        if self.now - usb.reported_at < self.firmware.report_interval:
            return
        usb.reported_at = self.now
        # after M409 or M408 the report goes to the first aux port instead
        if not self.firmware.report_follows_request or usb.status_request == "M105":
            self.report_temperatures()
