"""The device: a mainboard with its firmware, machine, card and channels, without any I/O."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterable, Mapping
from typing import Any, Callable

from .assembly import Assembly
from .hardware.blank import INPUT_NAMES, USB
from .line.channel import Channel
from .line.usb_input import Received

STEP = 0.25
"""Longest step of simulated time while something is going on, in seconds."""
IDLE_STEP = 10.0
"""Longest step while nothing but temperatures can change."""


class Board(Assembly):
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
        self.lock = threading.RLock()
        self._port = USB
        self._use_first_channels()
        self.restart.register(self._use_first_channels)
        self.pumps: list[Callable[[], None]] = []
        """Called whenever the channels have done what they can: they may have further input."""
        self._speed = speed
        self._wall_clock = clock
        self._started_at = clock()
        self._started_now = 0.0
        for text in faults:
            self.inject(text)

    def _use_first_channels(self) -> None:
        self._used_channels = [self.channels[self._port], self.channels["File"]]

    @property
    def model(self) -> dict[str, Any]:
        """The current object model; hold :attr:`lock` to change it, :meth:`bump` to announce it."""
        with self.lock:
            self.live.refresh()
            return self.data

    @property
    def data(self) -> dict[str, Any]:
        """The object model as it was when somebody looked at it last."""
        return self.object_model.data

    def bump(self, *keys: str) -> None:
        """Count up ``seqs`` of these keys: something that isn't live has changed."""
        self.object_model.bump(*keys)

    def volumes_changed(self, mounted: bool) -> None:
        """Show whether the card is mounted, and announce that files on it have changed."""
        self.object_model.volumes_changed(mounted)

    def tools(self) -> list[dict[str, Any]]:
        """Return the tools there are, in the order of their numbers."""
        return self.object_model.tools()

    def tool(self, number: int | None) -> dict[str, Any] | None:
        """Return the tool of that number; ``None`` without one."""
        return self.object_model.tool(number)

    @property
    def is_halted(self) -> bool:
        return self.activity.is_halted

    @property
    def is_plugged_in(self) -> bool:
        """Whether the port exists at the moment."""
        return self.plug.is_plugged_in

    @property
    def sessions(self) -> int:
        """How often USB has enumerated anew; a port opened before is dead."""
        return self.plug.sessions

    @property
    def speed(self) -> float:
        """Simulated seconds in a second of the clock; may be changed at any time."""
        return self._speed

    @speed.setter
    def speed(self, value: float) -> None:
        with self.lock:
            self.advance()
            self._started_at, self._started_now = self._wall_clock(), self.clock.now
            self._speed = value

    def plug_into(self, name: str) -> None:
        """Put the host on another channel over USB; 3.7 has two."""
        with self.lock:
            host, other = self.channels[self._port], self.channels[name]
            host.name, other.name = name, self._port
            self.channels[name], self.channels[self._port] = host, other
            self._port = name

    @property
    def has_room(self) -> bool:
        """Whether the board takes further bytes; a busy channel leaves them in its buffer."""
        return self.usb_input.has_room

    @property
    def log(self) -> list[Received]:
        """The lines received on USB, with their times."""
        return self.usb_input.log

    def received(self) -> list[str]:
        """Return the lines received on USB."""
        with self.lock:
            return [entry.text for entry in self.log]

    def receive(self, data: bytes) -> None:
        """Take bytes from the host on USB."""
        with self.lock:
            self.advance()
            if not self.is_plugged_in:
                return
            self.usb_input.receive(data)
            self._pump()

    def transmit(self) -> bytes:
        """Return the bytes sent to USB since the last call."""
        with self.lock:
            self.advance()
            return self.output.take()

    def execute(self, gcode: str, channel: str = "http") -> str:
        """Run G-code on another channel and return what it has replied so far.

        Several lines are run one after the other; a command that takes its time goes on in
        simulated time, its reply is part of a later call's answer.
        """
        with self.lock:
            self.advance()
            name = next((n for n in INPUT_NAMES if n.lower() == channel.lower()), None)
            if name is None or name == self._port:
                raise ValueError(f"no channel {channel!r} to execute on")
            self.use_channel(name).lines.extend(gcode.splitlines())
            self._pump()
            return self.replies.take(name)

    def use_channel(self, name: str) -> Channel:
        """Return a channel that the board looks at from now on."""
        with self.lock:
            used = self.channels[name]
            if used not in self._used_channels:
                self._used_channels.append(used)
            return used

    def message(self, text: str) -> None:
        """Send text to all outputs, USB among them."""
        self.output.text(text)

    def inject(self, fault: str) -> None:
        """Switch a fault on, ``name`` or ``name:argument``."""
        with self.lock:
            self.faults.inject(fault)

    def clear(self, fault: str) -> None:
        """Switch a fault off."""
        with self.lock:
            self.faults.clear(fault)

    def reset(self) -> None:
        """Restart; the port stays, what was to be sent is lost."""
        with self.lock:
            self.restart.reset()

    def power_cycle(self) -> None:
        """Restart with USB enumerating anew: the port is gone for a second."""
        with self.lock:
            self.restart.power_cycle()

    def unplug(self, seconds: float) -> None:
        """Let the port vanish for so many simulated seconds; opened ports are dead for good."""
        with self.lock:
            self.restart.unplug(seconds)

    def advance(self) -> None:
        """Let simulated time go on to the clock."""
        with self.lock:
            passed = self._wall_clock() - self._started_at
            target = self._started_now + passed * self._speed
            now = self.clock.now
            if now >= target:
                self._pump()
            while now < target:
                step = STEP if self.is_at_work else IDLE_STEP
                self._step(min(target, now + step, max(self.motion.next_end, now)))
                now = self.clock.now

    @property
    def is_at_work(self) -> bool:
        """Whether something waits for a moment in time."""
        return bool(
            self.clock.is_awaited
            or self.motion.is_moving
            or self.job.is_printing
            or self.boxes.current
            or self.warnings.is_waiting
            or self.faults.names()
            or not all(channel.is_idle for channel in self._used_channels)
        )

    def _step(self, until: float) -> None:
        seconds = until - self.clock.now
        self.clock.now = until
        self.motion.follow(until)
        self.thermal.follow(until)
        self.job.step(seconds)
        self.boxes.expire()
        self._pump()

    def _is_locked(self) -> bool:
        """Return whether another channel than the file's waits for standstill: no moves until then.

        RRF 3.5 GCodes.cpp, LockMovementAndWaitForStandstill.
        """
        return any(
            channel.wait == self.motion.has_stopped and channel.name != "File"
            for channel in self._used_channels
        )

    def _pump(self) -> None:
        """Let every channel do what it can do now."""
        self.motion.follow(self.clock.now)
        self.clock.run_due()
        is_stalled = self.faults.is_on("stall")
        for channel in self._used_channels:
            if is_stalled and channel.name == self._port:
                continue
            if (
                channel.name == "File"
                and channel.wait == self.motion.has_room
                and self._is_locked()
            ):
                continue
            self.interpreter.pump(channel)
        file_channel = self.channels["File"]
        while self.job.is_running and not self._is_locked():
            position = self.job.position
            self.job.feed()
            self.interpreter.pump(file_channel)
            if self.job.position == position or not file_channel.is_idle:
                break
        for pump in self.pumps:
            pump()
        self.warnings.tick()
        self.temperature_lines.tick()
