"""Whatever the board sends, and whatever its model holds: no hook raises, or takes long."""

import threading
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

import contextlib

from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.host.tags import POLL_TAG
from octoprint_rrfmodel.link.serial.display import Display
from octoprint_rrfmodel.link.serial.file_lines import FileLines
from octoprint_rrfmodel.link.serial.operation_translator import (
    OPERATION_OF_TAG,
    OperationTranslator,
)
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
from octoprint_rrfmodel.rrf.gcode.recognition import ROWS
from octoprint_rrfmodel.rrf.klipper import Kept
from octoprint_rrfmodel.rrf.views.event_facts import ENDED
from octoprint_rrfmodel.rrf.views.machine import Machine
from octoprint_rrfmodel.rrf.views.temperatures import temperatures
from octoprint_rrfmodel.rrf.wire.errors import guarded_warning, is_halted, is_serious
from octoprint_rrfmodel.rrf.wire.heard import heard
from octoprint_rrfmodel.rrf.wire.line import find_reply, without_warning
from octoprint_rrfmodel.rrf.wire.masking import masked
from octoprint_rrfmodel.rrf.wire.refusals import is_plain_refusal, refusal
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply, decode, decode_page, foreign_strings
from octoprint_rrfmodel.web.moonraker.gcode_store import GcodeStore
from tests.rrf.klipper import model_of
from tests.rrf.klipper.test_fuzz import PLACES, TREES, replaced
from tests.rrf.klipper.test_fuzz import spoilt_models as spoilt

from .hostile import LINES, long_lines, slow_ones


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


@settings(max_examples=300, deadline=None)
@given(st.lists(LINES | st.text(), max_size=5), st.sampled_from((None, "M36", "M120", "M20")))
def test_any_line_is_heard(lines, awaited):
    rig = Rig()
    rig.link.awaited = awaited
    rig.link.asks_of_a_file = awaited == "M36"
    rig.link.extra_ok.awaits = "error" if awaited == "M120" else None
    for line in lines:
        assert isinstance(rig.hear(line), str)
        assert rig.received.on_error(rig.comm, line) in (True, False)


MODELS = spoilt() | TREES.filter(lambda tree: isinstance(tree, dict))

COMMANDS = st.builds(
    lambda gcode, words: " ".join([gcode, *words]),
    st.sampled_from(
        ("G1", "G91", "G28", "M104", "M140", "M141", "M221", "T0", "M111", "M291", "M20")
    ),
    st.lists(
        st.sampled_from(
            ("S0", "S60", "T1", "T0", "X5", "E5", "S" + "9" * 400, "T" + "9" * 400, "P", '"')
        )
        | st.text(max_size=5),
        max_size=3,
    ),
)


def is_answer(queued):
    """Return whether OctoPrint can take this for what to queue: as it is, nothing, or lines."""
    if queued is None or queued == (None,):
        return True
    return all(isinstance(line, str) for line, *_ in queued)


@settings(max_examples=300, deadline=None)
@given(MODELS, st.sampled_from(sorted(OPERATION_OF_TAG)), COMMANDS)
def test_any_model_lets_commands_go_out(model, tag, command):
    rig = Rig()
    rig.model = model
    gcode = "T" if command.startswith("T") else command.split()[0]
    queued = rig.queued.on_queuing(rig.comm, "queuing", command, None, gcode, tags={tag})
    assert is_answer(queued)
    assert rig.sent.on_sending(rig.comm, "sending", command, None, gcode, tags={POLL_TAG}) is None


@pytest.mark.parametrize("gcode", sorted({gcode for row in ROWS for gcode in row.gcodes}))
@pytest.mark.parametrize(
    "odd", [[[]], [[40]], [None], {}, 5, "x", 10**400, [10**400], [{}]], ids=repr
)
@pytest.mark.parametrize("machine", sorted(PLACES), ids="-".join)
def test_each_member_of_a_tool_may_be_of_the_wrong_type(machine, odd, gcode):
    rig = Rig()
    tags = [tag for tag, name in OPERATION_OF_TAG.items() for row in ROWS if name == row.operation]
    for path in (
        ("tools", 0, "standby"),
        ("tools", 0, "heaters"),
        ("tools", 0, "extruders"),
        ("move", "axes", 0, "letter"),
        ("heat", "bedHeaters"),
    ):
        rig.model = replaced(replaced(model_of(*machine), path, odd), ("state", "currentTool"), 0)
        for tag in tags:
            for words in ("S60 X1", "S0", "E5 T0"):
                command = f"{gcode} {words}"
                assert is_answer(
                    rig.queued.on_queuing(rig.comm, "", command, None, gcode, tags={tag})
                )


@settings(max_examples=200, deadline=None)
@given(
    MODELS,
    st.dictionaries(
        st.sampled_from(("T", "T0", "T1", "B", "C", "x")), st.tuples(st.floats(), st.floats())
    ),
)
def test_any_model_leaves_a_report_of_temperatures(model, parsed):
    rig = Rig()
    rig.model = model
    assert isinstance(rig.display.on_temperatures(rig.comm, parsed), dict)


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
    "ended": lambda: ENDED.search,
    "kept": lambda: Kept().heard,
    "store": lambda: lambda line: fresh_store().on_printer_add_log("Recv: " + line),
    "hides": lambda: lambda line: PollTrace(lambda command: False).hides("Send: " + line),
}
"""All that see a line, each made anew."""


@pytest.mark.parametrize("name", LOOKS)
def test_time_grows_with_the_length_alone(name):
    assert slow_ones(LOOKS[name]()) == {}


@pytest.mark.parametrize("name", LOOKS)
@settings(max_examples=100, deadline=None)
@given(LINES | st.text())
def test_any_line_is_looked_at(name, line):
    # the same line means the same, whoever has looked before
    assert repr(LOOKS[name]()(line)) == repr(LOOKS[name]()(line))


def test_many_sensors_of_one_name_take_no_time():
    sensors = [{"name": "x", "lastReading": 1.0} for _ in range(20_000)]
    found = temperatures({"sensors": {"analog": sensors}, "heat": {"heaters": sensors}}).others
    assert len(found) == 20_000 and "Sensor x 20000" in found


def test_there_are_long_lines():
    assert all(len(line) > 60_000 for line in long_lines())
