"""What the parts of a board share: the object model, time as it is now, messages, macros."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Iterator, Mapping
from typing import Any, Callable

from octoprint_rrfmodel.rrf.m409 import answer

from .captured import completed, identity
from .device import live_members as state
from .device.card import SYSTEM, Card
from .device.job import Job
from .device.motion import Motion
from .device.thermal import Thermal
from .faults import Faults
from .firmware import firmware_called
from .gcodes import reports
from .gcodes.messagebox import MessageBoxes
from .hardware.blank import INPUT_NAMES, gcode_input, no_job
from .interpreter import table as gcodes
from .line.channel import Channel, Outcome, Running
from .line.output import Output
from .machines import machine_called, mainboard
from .model.build import full_model
from .model.members import for_firmware
from .model.om import ModelText
from .text.command import Command

START_SECONDS = 1.0
"""From a reset until the port is back."""


class Core:
    """A board's parts and what they ask of each other; time and bytes are the subclass's."""

    def __init__(self, machine: str, firmware: str, model: Mapping[str, Any] | None):
        self.lock = threading.RLock()
        self.firmware = firmware_called(firmware)
        self.machine = machine_called(machine)
        self.mainboard = mainboard(self.machine, self.firmware)
        if model is not None:
            self.firmware, self.mainboard = identity(model, self.firmware, self.mainboard)
        self._given_model = model
        self.now = 0.0
        """Simulated seconds since this object was made."""
        self.faults = Faults(self)
        self.output = Output(self)
        self.card = Card()
        self.pending: list[tuple[Callable[[], bool], Callable[[], None]]] = []
        """Conditions, and what is to happen once they hold."""
        self.unplugged_until = 0.0
        self.sessions = 0
        """How often USB has enumerated anew; a port opened before is dead."""
        self.begin()

    def begin(self) -> None:
        """Power up: everything that a reset forgets."""
        self.booted_at = self.now
        self.is_halted = False
        self.has_power = True
        self.is_changing_tool = False
        self.cold_extrusion_allowed = False
        self.macros_running = 0
        if self._given_model is None:
            self.data: dict[str, Any] = full_model(self.machine, self.firmware)
        else:
            self.data = completed(self._given_model, self.firmware)
        self.model_text = ModelText(self.firmware, self.mainboard.buffers(self.firmware))
        self.motion = Motion(self)
        self.thermal = Thermal(self)
        self.boxes = MessageBoxes(self)
        self.job = Job(self)
        self.texts: dict[str, list[str]] = {}
        """Channel → what it has replied, for channels other than USB."""
        self._spare_inputs: dict[str, dict[str, Any]] = {}
        self.channels: dict[str, Channel] = {
            name: Channel(self, name, self._writer(name), echoes=name != "File")
            for name in INPUT_NAMES
        }
        self.refresh()

    def _writer(self, name: str) -> Callable[[str], None]:
        if name == "USB":
            return self.output.reply
        return lambda text: self._written(name, text)

    def _written(self, name: str, text: str) -> None:
        self.texts.setdefault(name, []).append(text)
        if name == "HTTP":
            self.bump("reply")

    @property
    def up_time(self) -> float:
        return self.now - self.booted_at

    @property
    def is_plugged_in(self) -> bool:
        """Whether the port exists at the moment."""
        return self.now >= self.unplugged_until

    def bump(self, *keys: str) -> None:
        """Count up ``seqs`` of these keys: something that isn't live has changed."""
        seqs = self.data.get("seqs")
        if seqs is None:
            return
        for key in keys:
            if key in seqs:
                seqs[key] = (seqs[key] + 1) & 0xFFFF

    def execute_command(self, channel: Channel, command: Command) -> Outcome:
        return gcodes.execute(self, channel, command)

    @property
    def is_cnc(self) -> bool:
        return bool(self.data["state"].get("machineMode") == "CNC")

    @property
    def queue_length(self) -> int:
        queues = self.data["move"].get("queue") or []
        return int(queues[0]["length"]) if queues else 40

    def input(self, name: str) -> dict[str, Any]:
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

    def tools(self) -> list[dict[str, Any]]:
        """Return the tools there are, in the order of their numbers."""
        return [tool for tool in self.data.get("tools") or () if tool is not None]

    def tool(self, number: int | None) -> dict[str, Any] | None:
        """Return the tool of that number; ``None`` without one."""
        tools: list[dict[str, Any] | None] = self.data.get("tools") or []
        for tool in tools:
            if tool is not None and tool["number"] == number:
                return tool
        return None

    def current_tool(self) -> dict[str, Any] | None:
        return self.tool(self.data["state"].get("currentTool", -1))

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
        self.pending.append((condition, action))

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

    def reset(self) -> None:
        """Restart; the port stays, what was to be sent is lost."""
        with self.lock:
            self.output.discard()
            self.begin()
            self.faults.after_reset()

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
        if 0 <= index < len(points):
            self.refresh()
            points[index]["coords"] = [axis["userPosition"] for axis in self.motion.axes]
            points[index]["toolNumber"] = self.data["state"]["currentTool"]
            self.bump("state")
