"""The device: a mainboard with its firmware, machine, card and channels, without any I/O."""

from __future__ import annotations

import contextlib
import copy
import threading
import time
from typing import (
    Any,
    Callable,
    Dict,
    Iterable,
    Iterator,
    List,
    Mapping,
    NamedTuple,
    Optional,
    Tuple,
)

from octoprint_rrfmodel.rrf.m409 import answer

from . import gcodes, reports, state
from .build import full_model
from .card import SYSTEM, Card
from .channel import Channel, Outcome, Running
from .command import Command
from .faults import Faults
from .firmware import firmware_called
from .jobs import Job
from .machines import machine_called, mainboard
from .members import for_firmware
from .messagebox import MessageBoxes
from .motion import Motion
from .om import ModelText
from .output import Output
from .parts import INPUT_NAMES, gcode_input, no_job
from .thermal import Thermal

STEP = 0.25
"""Longest step of simulated time, in seconds."""
THERMAL_STEP = 0.1
START_SECONDS = 1.0
"""From a reset until the port is back."""
RECEIVE_BUFFER = 512
"""Bytes that the board takes from USB while it is busy; the host has to wait with the rest."""


class Received(NamedTuple):
    """A line as it came in on USB."""

    time: float
    text: str


class Board:
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
        model: Optional[Mapping[str, Any]] = None,
        faults: Iterable[str] = (),
        speed: float = 1.0,
        clock: Callable[[], float] = time.monotonic,
    ):
        self.lock = threading.RLock()
        self.firmware = firmware_called(firmware)
        self.machine = machine_called(machine)
        self.mainboard = mainboard(self.machine, self.firmware)
        self.speed = speed
        self._clock = clock
        self._started_at = clock()
        self._given_model = model
        self.now = 0.0
        """Simulated seconds since this object was made."""
        self.log: List[Received] = []
        self.faults = Faults(self)
        self.output = Output(self)
        self.card = Card()
        self._input = bytearray()
        self.unplugged_until = 0.0
        self.sessions = 0
        """How often USB has enumerated anew; a port opened before is dead."""
        self._begin()
        for text in faults:
            self.inject(text)

    def _begin(self) -> None:
        """Power up: everything that a reset forgets."""
        self._booted_at = self.now
        self._pending: List[Tuple[Callable[[], bool], Callable[[], None]]] = []
        self.is_halted = False
        self.has_power = True
        self.is_changing_tool = False
        self.cold_extrusion_allowed = False
        self.macros_running = 0
        if self._given_model is None:
            self.data: Dict[str, Any] = full_model(self.machine, self.firmware)
        else:
            self.data = copy.deepcopy(dict(self._given_model))
        self.model_text = ModelText(self.firmware, self.mainboard.buffers(self.firmware))
        self.motion = Motion(self)
        self.thermal = Thermal(self)
        self.boxes = MessageBoxes(self)
        self.job = Job(self)
        self._thermal_at = self.now
        self._input.clear()
        self.channels: Dict[str, Channel] = {
            name: Channel(self, name, self._writer(name), echoes=name != "File")
            for name in INPUT_NAMES
        }
        self._texts: Dict[str, List[str]] = {}
        self._spare_inputs: Dict[str, Dict[str, Any]] = {}
        self.refresh()

    def _writer(self, name: str) -> Callable[[str], None]:
        if name == "USB":
            return self.output.reply
        return lambda text: self._texts.setdefault(name, []).append(text)

    # what a host or a test calls

    @property
    def model(self) -> Dict[str, Any]:
        """The current object model; hold :attr:`lock` to change it, :meth:`bump` to announce it."""
        with self.lock:
            self.refresh()
            return self.data

    @property
    def up_time(self) -> float:
        return self.now - self._booted_at

    @property
    def is_plugged_in(self) -> bool:
        """Whether the port exists at the moment."""
        return self.now >= self.unplugged_until

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
            target = (self._clock() - self._started_at) * self.speed
            while self.now < target:
                self._step(min(target, self.now + STEP, max(self.motion.next_end, self.now)))
            self._pump()

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
            self.channels[name].lines.extend(gcode.splitlines())
            self._pump()
            return "".join(self._texts.pop(name, ()))

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
            self.output.discard()
            self._begin()

    def power_cycle(self) -> None:
        """Restart with USB enumerating anew: the port is gone for a second."""
        with self.lock:
            self.unplug(START_SECONDS)
            self.reset()

    def unplug(self, seconds: float) -> None:
        """Let the port vanish for so many simulated seconds; opened ports are dead for good."""
        with self.lock:
            self.sessions += 1
            self.unplugged_until = self.now + seconds
            self.output.discard()
            self._input.clear()

    def received(self) -> List[str]:
        """Return the lines received on USB."""
        with self.lock:
            return [entry.text for entry in self.log]

    def bump(self, *keys: str) -> None:
        """Count up ``seqs`` of these keys: something that isn't live has changed."""
        seqs = self.data.get("seqs")
        if seqs is None:
            return
        for key in keys:
            if key in seqs:
                seqs[key] = (seqs[key] + 1) & 0xFFFF

    # what the parts of the board call

    def execute_command(self, channel: Channel, command: Command) -> Outcome:
        return gcodes.execute(self, channel, command)

    @property
    def is_cnc(self) -> bool:
        return self.data["state"].get("machineMode") == "CNC"

    @property
    def queue_length(self) -> int:
        queues = self.data["move"].get("queue") or []
        return int(queues[0]["length"]) if queues else 40

    def input(self, name: str) -> Dict[str, Any]:
        """Return the channel's element of ``inputs``, one of its own where the board has none."""
        index = INPUT_NAMES.index(name)
        inputs = self.data.get("inputs") or []
        found = inputs[index] if index < len(inputs) else None
        if found is None:
            found = self._spare_inputs.get(name)
            if found is None:
                found = self._spare_inputs[name] = gcode_input(name)
        return found

    @staticmethod
    def input_index(name: str) -> int:
        return INPUT_NAMES.index(name)

    def current_tool(self) -> Optional[Dict[str, Any]]:
        number = self.data["state"].get("currentTool", -1)
        for tool in self.data.get("tools") or ():
            if tool is not None and tool["number"] == number:
                return tool
        return None

    def member(self, path: str) -> Any:
        """Return a member of the object model by its M409 key, for expressions."""
        self.refresh()
        return answer(self.data, path, "vno")["result"]

    def members_of(self, value: Any, path: str) -> Any:
        """Return that part of a model with only what this firmware has."""
        return for_firmware(value, self.firmware, path)

    def refresh(self) -> None:
        """Bring the live members of the model up to date."""
        state.show(self)

    def date_time(self) -> str:
        return state.date_time(self)

    def message(self, text: str) -> None:
        """Send text to all outputs, USB among them."""
        self.output.text(text)

    def usb_message(self, text: str) -> None:
        self.output.text(text)

    def report_temperatures(self) -> None:
        """Send a temperature line without ``ok``."""
        self.output.text(reports.temperatures(self) + "\n")

    def after(self, seconds: float) -> Callable[[], bool]:
        """Return the condition that so many simulated seconds have passed from now."""
        end = self.now + seconds
        return lambda: self.now >= end

    def after_seconds(self, seconds: Any, action: Callable[[], None]) -> None:
        """Call ``action`` once, that much later."""
        self.when(self.after(float(seconds or 0)), action)

    def when(self, condition: Callable[[], bool], action: Callable[[], None]) -> None:
        """Call ``action`` once, as soon as the condition holds."""
        self._pending.append((condition, action))

    @contextlib.contextmanager
    def running_macro(self, channel: Channel) -> Iterator[None]:
        """While this is entered the board is busy, and the channel in a macro."""
        self.macros_running += 1
        channel.macros += 1
        try:
            yield
        finally:
            self.macros_running -= 1
            channel.macros -= 1

    def run_system_macro(self, channel: Channel, name: str) -> Running:
        """Run a file of ``0:/sys`` where there is one."""
        lines = self.card.lines(f"{SYSTEM}/{name}")
        if lines is not None:
            yield from channel.macro(lines)

    def halt(self) -> None:
        """Everything off, every channel but its input forgotten, until the next reset."""
        self.is_halted = True
        self.thermal.all_off()
        self.motion.stop()
        self.job = Job(self)
        self.data["job"] = self.members_of(no_job(), "job")
        for channel in self.channels.values():
            channel.abandon(keep_input=True)
        self.bump("job", "state")

    def motors_lost(self) -> None:
        """Without motor supply nobody knows where the axes are."""
        self.motion.stop()
        for axis in self.motion.axes:
            axis["homed"] = False
        self.bump("move")

    def volumes_changed(self, mounted: bool) -> None:
        volumes = self.data.get("volumes") or [None]
        if volumes[0] is not None:
            volumes[0]["mounted"] = mounted
        changes = (self.data.get("seqs") or {}).get("volChanges") or []
        if changes:
            changes[0] = (changes[0] + 1) & 0xFFFF
        self.bump("volumes")

    def volume_open(self, is_open: bool) -> None:
        volumes = self.data.get("volumes") or [None]
        if volumes[0] is not None:
            volumes[0]["openFiles"] = is_open
        self.bump("volumes")

    def save_restore_point(self, index: int) -> None:
        points = self.data["state"].get("restorePoints") or []
        if index < len(points):
            self.refresh()
            points[index]["coords"] = [axis["userPosition"] for axis in self.motion.axes]
            points[index]["toolNumber"] = self.data["state"]["currentTool"]
            self.bump("state")

    # time

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
        if self._pending:
            due = [entry for entry in self._pending if entry[0]()]
            self._pending = [entry for entry in self._pending if entry not in due]
            for _, action in due:
                action()
        is_stalled = self.faults.is_on("stall")
        for name, channel in self.channels.items():
            if not channel.is_idle and not (is_stalled and name == "USB"):
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
