"""The parts of a board, each made once with what it uses, from the bottom to the top."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from .captured import completed, identity
from .clock import Clock
from .device.activity import Activity
from .device.boxes import MessageBoxes
from .device.card import Card
from .device.emergency import Emergency
from .device.events import Events
from .device.extrusion import ExtrusionWarnings
from .device.incidents import DriveFaults, HeaterFault, UnaskedBox
from .device.job import Job
from .device.live_members import LiveMembers
from .device.motion import Motion
from .device.network_access import NetworkAccess
from .device.outages import Outages
from .device.power import Power
from .device.printing.file_text import FileText, FolderText
from .device.restart import Restart
from .device.status import Status
from .device.temperature_lines import TemperatureLines
from .device.thermal import Thermal
from .firmware import firmware_called
from .gcodes.accepted import Accepted
from .gcodes.atx import Atx
from .gcodes.box_codes import BoxCodes
from .gcodes.coordinates import Coordinates
from .gcodes.display import Display
from .gcodes.factors import Factors
from .gcodes.fans import Fans
from .gcodes.filaments import Filaments
from .gcodes.heaters import Heaters
from .gcodes.homing import Homing
from .gcodes.meta import MetaCommands
from .gcodes.modes import Modes
from .gcodes.monitors import Monitors
from .gcodes.moves import Moves
from .gcodes.network_settings import NetworkSettings
from .gcodes.queries.diagnostics import Diagnostics
from .gcodes.queries.identity import Identity
from .gcodes.queries.m408_values import Names, Values
from .gcodes.queries.object_model import ObjectModelCode
from .gcodes.queries.old_status import OldStatus
from .gcodes.queries.reports import Reports
from .gcodes.queries.settings import Settings
from .gcodes.spindles import Spindles
from .gcodes.storage.files import Files
from .gcodes.storage.information import Information
from .gcodes.storage.listing import Listing
from .gcodes.storage.prints import Prints
from .gcodes.system import System
from .gcodes.tools import Tools
from .gcodes.tuning import Tuning
from .gcodes.upkeep import Upkeep
from .hardware.blank import INPUT_NAMES, USB
from .interpreter.decoder import Decoder
from .interpreter.execution import Interpreter
from .interpreter.macros import Macros
from .interpreter.table import GCodes
from .interpreter.urgent import Urgent
from .line.channel import Channel
from .line.output import Output
from .line.plug import Plug
from .line.replies import Replies
from .line.switches import FaultSwitches
from .line.usb_input import UsbInput
from .machines import machine_called, mainboard
from .model.build import full_model
from .model.om import ModelText
from .model.tree import ObjectModel


class Assembly:
    """A board's parts, wired; nothing is decided here, and no part is given the whole."""

    def __init__(self, machine: str, firmware: str, given: Mapping[str, Any] | None = None):
        """Names of machine and firmware; ``given`` is an object model in the machine's place."""
        self.firmware = firmware_called(firmware)
        self.machine = machine_called(machine)
        self.mainboard = mainboard(self.machine, self.firmware)
        if given is None:
            build = partial(full_model, self.machine, self.firmware)
        else:
            self.firmware, self.mainboard = identity(given, self.firmware, self.mainboard)
            build = partial(completed, given, self.firmware)
        self.clock = Clock()
        self.object_model = ObjectModel(self.firmware, build)
        self.model_text = ModelText(self.firmware, self.mainboard.buffers(self.firmware))
        self._make_line()
        self._make_device()
        self._make_interpreter()
        self._register_gcodes()
        self._register_restart()
        self._register_incidents()
        self.live.refresh()

    def _make_line(self) -> None:
        self.faults = FaultSwitches(self.clock)
        self.plug = Plug(self.clock)
        self.output = Output(self.clock, self.faults, self.plug)
        self.replies = Replies(self.object_model)
        self.network_access = NetworkAccess(self.object_model)
        self.channels = {name: self._channel(name) for name in INPUT_NAMES}
        self.usb_input = UsbInput(self.clock, self.channels[USB])
        self.usb_input.said = lambda: self.output.said

    def _channel(self, name: str) -> Channel:
        write = self.output.reply if name == USB else self.replies.writer(name)
        return Channel(name, self.object_model, write, echoes=name != "File")

    def _make_device(self) -> None:
        model, clock, output = self.object_model, self.clock, self.output
        self.card = Card()
        self.folder_text = FolderText(self.card)
        self.file_text = FileText(model, self.model_text, self.firmware)
        self.activity = Activity()
        self.motion = Motion(model, clock, self.firmware)
        self.warnings = ExtrusionWarnings(clock, output)
        self.power = Power(model, self.motion)
        self.thermal = Thermal(model=model, power=self.power, clock=clock, firmware=self.firmware)
        self.boxes = MessageBoxes(model, clock)
        self.job = Job(
            model=model,
            card=self.card,
            motion=self.motion,
            channel=self.channels["File"],
            output=output,
        )
        self.status = Status(
            firmware=self.firmware,
            activity=self.activity,
            power=self.power,
            motion=self.motion,
            job=self.job,
            boxes=self.boxes,
        )
        self.monitors = Monitors(model)
        self.live = LiveMembers(
            model=model,
            clock=clock,
            motion=self.motion,
            job=self.job,
            status=self.status,
            channels=self.channels,
        )
        self.emergency = Emergency(
            model=model,
            activity=self.activity,
            thermal=self.thermal,
            motion=self.motion,
            job=self.job,
            channels=self.channels,
        )
        self.restart = Restart(plug=self.plug, usb_input=self.usb_input, output=output)
        self.temperature_lines = TemperatureLines(
            clock=clock,
            firmware=self.firmware,
            thermal=self.thermal,
            usb=self.channels[USB],
            output=output,
            faults=self.faults,
        )

    def _make_interpreter(self) -> None:
        self.gcodes = GCodes(self.firmware, self.activity)
        self.decoder = Decoder(self.object_model, self.motion, self.live.member)
        self.interpreter = Interpreter(
            gcodes=self.gcodes,
            decoder=self.decoder,
            firmware=self.firmware,
            clock=self.clock,
            output=self.output,
            job=self.job,
        )
        if self.firmware.looks_at_usb:
            urgent = Urgent(
                gcodes=self.gcodes,
                decoder=self.decoder,
                emergency=self.emergency,
                channel=self.channels[USB],
            )
            self.usb_input.takes = urgent.takes
        self.macros = Macros(
            activity=self.activity,
            card=self.card,
            interpreter=self.interpreter,
            output=self.output,
        )

    def _register_gcodes(self) -> None:
        model, motion, thermal, job = self.object_model, self.motion, self.thermal, self.job
        clock, card, macros, output = self.clock, self.card, self.macros, self.output
        live, faults, firmware = self.live, self.faults, self.firmware
        values = partial(
            Values,
            model=model,
            motion=motion,
            thermal=thermal,
            job=job,
            clock=clock,
            names=Names(firmware, self.mainboard),
        )
        self.old_status = OldStatus(live, values)
        self.gcodes.register(
            Accepted(),
            macros,
            MetaCommands(model, self.decoder, output),
            Moves(
                model=model,
                motion=motion,
                thermal=thermal,
                job=job,
                clock=clock,
                warnings=self.warnings,
            ),
            Coordinates(model, motion),
            Homing(model=model, motion=motion, clock=clock, macros=macros, card=card),
            Factors(model, motion),
            Modes(model, thermal),
            Tools(
                model=model,
                motion=motion,
                thermal=thermal,
                clock=clock,
                macros=macros,
                firmware=firmware,
            ),
            self.monitors,
            Filaments(model=model, motion=motion, card=card, macros=macros),
            Heaters(model, motion, thermal),
            Tuning(model=model, motion=motion, thermal=thermal, clock=clock, output=output),
            Upkeep(model=model, card=card, macros=macros, clock=clock, restart=self.restart),
            Fans(model),
            Spindles(model),
            Atx(model, thermal, firmware),
            Display(model=model, clock=clock, output=output, replies=self.replies),
            NetworkSettings(self.network_access),
            BoxCodes(
                clock=clock, firmware=firmware, boxes=self.boxes, faults=faults, output=output
            ),
            Reports(model=model, clock=clock, live=live, motion=motion, thermal=thermal),
            Identity(firmware, self.mainboard),
            Diagnostics(model=model, clock=clock, firmware=firmware, mainboard=self.mainboard),
            ObjectModelCode(
                model=model, live=live, model_text=self.model_text, firmware=firmware, faults=faults
            ),
            Settings(model=model, motion=motion, thermal=thermal, card=card, firmware=firmware),
            self.old_status,
            Listing(card, self.folder_text, faults),
            Files(model=model, card=card, job=job, clock=clock, output=output),
            Information(card, job, self.file_text),
            Prints(job=job, card=card, motion=motion, macros=macros, live=live, output=output),
            System(
                model=model,
                clock=clock,
                emergency=self.emergency,
                restart=self.restart,
                usb=self.channels[USB],
                output=output,
            ),
        )

    def _register_restart(self) -> None:
        """What a restart forgets: commands that run first, so that they end in what there was."""
        self.restart.register(
            *(channel.restart for channel in self.channels.values()),
            self.replies.restart,
            self.clock.restart,
            self.object_model.restart,
            self.activity.restart,
            self.motion.restart,
            self.warnings.restart,
            self.power.restart,
            self.thermal.restart,
            self.boxes.restart,
            self.job.restart,
            self.monitors.restart,
            self.live.refresh,
            self.faults.restart,
        )

    def _register_incidents(self) -> None:
        events = Events(firmware=self.firmware, job=self.job, boxes=self.boxes, output=self.output)
        self.faults.register(
            HeaterFault(self.thermal, events),
            DriveFaults(self.object_model, self.job, events),
            UnaskedBox(self.firmware, self.boxes),
            Outages(
                clock=self.clock,
                power=self.power,
                emergency=self.emergency,
                restart=self.restart,
            ),
        )
