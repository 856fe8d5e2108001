"""The hooks of a connection without a port, and all that look at a line."""

import contextlib
import threading
from types import SimpleNamespace

from octoprint_rrfmodel.link.serial.display import Display
from octoprint_rrfmodel.link.serial.file_lines import FileLines
from octoprint_rrfmodel.link.serial.operation_translator import OperationTranslator
from octoprint_rrfmodel.link.serial.queued import QueuedCommands
from octoprint_rrfmodel.link.serial.received import ReceivedLines
from octoprint_rrfmodel.link.serial.refused_lines import RefusedLines
from octoprint_rrfmodel.link.serial.sdcard import SdCard
from octoprint_rrfmodel.link.serial.sent import SentCommands
from octoprint_rrfmodel.link.serial.serial_link import SerialLink
from octoprint_rrfmodel.link.serial.unsendable_commands import UnsendableCommands
from octoprint_rrfmodel.link.terminal import PollTrace
from octoprint_rrfmodel.rrf.card.listing import CardPlan
from octoprint_rrfmodel.rrf.card.wording import Situation, reword
from octoprint_rrfmodel.rrf.klipper import Kept
from octoprint_rrfmodel.rrf.views.event_facts import ending
from octoprint_rrfmodel.rrf.views.machine import Machine
from octoprint_rrfmodel.rrf.views.temperatures import temperatures
from octoprint_rrfmodel.rrf.wire.errors import guarded_warning, is_halted, is_serious
from octoprint_rrfmodel.rrf.wire.heard import heard
from octoprint_rrfmodel.rrf.wire.line import find_reply, without_warning
from octoprint_rrfmodel.rrf.wire.masking import masked
from octoprint_rrfmodel.rrf.wire.refusals import is_plain_refusal, refusal
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply, decode, decode_page, foreign_strings
from octoprint_rrfmodel.web.moonraker.gcode_store import GcodeStore


class Rig:
    """All hooks of a connection with RepRapFirmware, and a model to choose."""

    def __init__(self):
        self.model = {}
        self.comm = SimpleNamespace(
            _clear_to_send=threading.Event(),
            _serial_encoding="utf-8",
            last_temperature=SimpleNamespace(set_tool=lambda *args, **more: None),
            getCurrentTool=lambda: 0,
            isPrinting=lambda: True,
            isPausing=lambda: False,
            isPaused=lambda: False,
            isCancelling=lambda: False,
            isFinishing=lambda: False,
            isStarting=lambda: False,
            isSdFileSelected=lambda: False,
            setPause=self.note,
        )
        self.link = SerialLink(dict, dict, float)
        job = SimpleNamespace(
            forget=lambda: None,
            cancel=lambda gcode: None,
            allow_opening=lambda comm: None,
            situation=lambda *known: Situation(),
            reworded=lambda comm, line: (),
        )
        card = SdCard(
            CardPlan(), job, self.link, model=lambda: self.model, is_reworded=lambda row: True
        )
        self.link.attach(card)
        self.received = ReceivedLines(
            self.link,
            card,
            self.note,
            guards=lambda error: False,
            patience=SimpleNamespace(feed=lambda comm: ""),
            refusals=RefusedLines(
                self.link, self.note, stops=lambda *refused: True, clock=lambda: 0.0
            ),
        )
        self.received.on_firmware_info(self.comm, "RepRapFirmware for Duet 2 WiFi", {})
        operations = OperationTranslator(
            self.machine, lambda row: True, self.note, profile=lambda: {"extruder": {"count": 1}}
        )
        unsendable = UnsendableCommands(
            self.machine,
            lambda row: True,
            self.note,
            stop=lambda *command: None,
            files=FileLines(self.link),
        )
        self.queued = QueuedCommands(
            self.link,
            self.note,
            unsendable.instead,
            translators=(card.translate, operations.translate),
        )
        self.sent = SentCommands(self.link, self.note, float, show_target=self.note, sent=self.note)
        known = SimpleNamespace(heat=lambda: (temperatures(self.model), True))
        self.display = Display(self.link, known, lambda: False, fire=self.note)

    def machine(self):
        return Machine(self.model)

    def note(self, *note):
        pass

    def hear(self, line):
        return self.received.on_received(self.comm, line)


def is_answer(queued):
    """Return whether OctoPrint can take this for what to queue: as it is, nothing, or lines."""
    if queued is None or queued == (None,):
        return True
    return all(isinstance(line, str) for line, *_ in queued)


def read(line):
    found = find_reply(line)
    for how in (decode, decode_page):
        with contextlib.suppress(MalformedReply):
            how(found.reply if found else line)
    foreign_strings(line)


def fresh_store():
    link = SimpleNamespace(is_rrf=True, has_polled=lambda command: False)
    return GcodeStore(link, lambda line: None)


LOOKS = {
    "on_received": lambda: Rig().hear,
    "on_error": lambda: lambda line: Rig().received.on_error(None, line),
    "is_serious": lambda: is_serious,
    "guarded_warning": lambda: guarded_warning,
    "is_halted": lambda: is_halted,
    "refusal": lambda: refusal,
    "is_plain_refusal": lambda: is_plain_refusal,
    "heard": lambda: heard,
    "without_warning": lambda: without_warning,
    "reword": lambda: lambda line: reword(line, Situation),
    "read": lambda: read,
    "masked": lambda: masked,
    "ended": lambda: ending,
    "kept": lambda: Kept().heard,
    "store": lambda: lambda line: fresh_store().on_printer_add_log("Recv: " + line),
    "hides": lambda: lambda line: PollTrace(lambda command: False).hides("Send: " + line),
}
"""All that see a line, each made anew."""
