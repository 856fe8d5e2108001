"""An ok that is lost is found out soon, and one that was only late is none too many."""

import random
import threading
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint.util import CountedEvent

from octoprint_rrfmodel.link.serial.lost_ok import SILENT_SECONDS
from octoprint_rrfmodel.link.serial.patience import STILL_BUSY, Patience
from octoprint_rrfmodel.link.serial.received import ReceivedLines
from octoprint_rrfmodel.link.serial.sent import SentCommands
from octoprint_rrfmodel.link.serial.serial_link import SerialLink

ANSWERS = {
    "M105": ["ok T0:21.0 /0.0 B:21.3 /0.0"],
    "M114": ["X:0.000 Y:0.000 Z:0.000 E:0.000", "ok"],
    "M115": ["FIRMWARE_NAME: RepRapFirmware for Duet 3 Mini 5+ FIRMWARE_VERSION: 3.5.3", "ok"],
}
"""What the board says to each question; to a machine without heat M105 is just acknowledged."""

COST_SECONDS = 6


class Rig:
    """OctoPrint's counting of acknowledgements, the board as a queue of lines, and a clock."""

    def __init__(self, has_heat=True, minutes=60):
        self.now = 100.0
        self.has_heat = has_heat
        self.is_held = False
        """Whether the board waits for a person."""
        self.wire = []
        """What was sent and isn't answered yet."""
        self.sent = []
        tools = {0: (21.0, 0.0)} if has_heat else {}
        self.comm = SimpleNamespace(
            _clear_to_send=CountedEvent(1, minimum=None, maximum=1),
            _do_send=lambda cmd, gcode=None: self._put(cmd),
            _manualStreaming=False,
            isStreaming=lambda: False,
            isOperational=lambda: True,
            last_temperature=SimpleNamespace(tools=tools, bed=(None, None)),
        )
        self.link = SerialLink(dict, dict, lambda: self.now)
        card = SimpleNamespace(is_talking=False, reword=lambda line: line)
        self.received = ReceivedLines(
            self.link,
            card,
            lambda *note: None,
            guards=lambda error: False,
            patience=Patience(self.link, lambda: minutes, lambda: self.is_held),
            refusals=SimpleNamespace(look=lambda comm, line: None),
        )
        self._sent = SentCommands(
            self.link,
            lambda *note: None,
            lambda: self.now,
            show_target=lambda *target: None,
            sent=lambda cmd, tags: None,
        )
        self.link.is_known_now(self.comm)

    def _put(self, cmd):
        self.wire.append(cmd)
        self.sent.append(cmd)

    @property
    def may_send(self):
        return not self.comm._clear_to_send.blocked()

    def send(self, cmd):
        """Send a line as OctoPrint does."""
        assert self.may_send
        self._sent.on_sending(self.comm, "sending", cmd, None, cmd.split()[0], tags={"api:x"})
        self.comm._clear_to_send.clear()
        self._put(cmd)

    def hear(self, line):
        """Take a line as OctoPrint does."""
        if self.received.on_received(self.comm, line).startswith("ok"):
            self.comm._clear_to_send.set()

    def answer(self, is_lost=False):
        """Let the board be through with its oldest line; return what that was."""
        cmd = self.wire.pop(0)
        answer = ANSWERS.get(cmd, ["ok"])
        if cmd == "M105" and not self.has_heat:
            answer = ["ok"]
        for line in () if is_lost else answer:
            self.hear(line)
        return cmd

    def wait(self, seconds):
        for _ in range(int(seconds * 2)):
            self.now += 0.5
            self.link.tick()


@pytest.mark.parametrize("has_heat, question", [(True, "M105"), (False, "M114")])
def test_a_lost_ok_costs_little(has_heat, question):
    rig = Rig(has_heat)
    rig.send("G1 X1")
    rig.answer(is_lost=True)
    rig.wait(COST_SECONDS - 1)
    assert rig.wire == [question]
    rig.answer()
    assert rig.may_send


def heard_in_silence(rig):
    """Return what OctoPrint is told when reading has timed out."""
    return rig.received.on_received(rig.comm, "")


@pytest.mark.parametrize("long", ["G32", 'M98 P"a.g"', "T1", "G4 S10"])
def test_behind_a_command_that_takes_long_it_is_asked_when_patience_is_over(long):
    rig = Rig(minutes=2)
    rig.send(long)
    rig.answer(is_lost=True)
    rig.wait(119)
    assert heard_in_silence(rig) == STILL_BUSY
    assert rig.wire == []
    rig.wait(2)
    # from here on OctoPrint hangs up soon
    assert heard_in_silence(rig) == ""
    rig.wait(1)
    assert rig.wire == ["M105"]
    rig.answer()
    assert rig.may_send
    # the next one has all the time again
    rig.send("G32")
    rig.wait(COST_SECONDS)
    assert heard_in_silence(rig) == STILL_BUSY
    assert rig.wire == ["G32"]


def test_a_macro_that_takes_longer_than_patience_earns_no_ok_too_many():
    rig = Rig(minutes=1)
    rig.send("G32")
    rig.wait(61)
    assert heard_in_silence(rig) == ""
    rig.wait(1)
    assert rig.wire == ["G32", "M105"]
    rig.answer()
    assert not rig.may_send
    rig.answer()
    rig.send("G1 X2")
    assert not rig.may_send


def test_octoprint_that_hangs_up_meanwhile_holds_nobody_up():
    rig = Rig()
    rig.send("G1 X1")
    # OctoPrint does so on the thread that hangs up, and never gives it back
    rig.comm._clear_to_send.acquire()
    worker = threading.Thread(target=rig.wait, args=(COST_SECONDS,), daemon=True)
    worker.start()
    worker.join(10)
    assert not worker.is_alive()


def test_nobody_is_asked_while_a_person_is_waited_for():
    rig = Rig(minutes=1)
    rig.is_held = True
    rig.send("G32")
    rig.wait(300)
    assert heard_in_silence(rig) == STILL_BUSY
    rig.wait(COST_SECONDS)
    assert rig.wire == ["G32"]


@pytest.mark.parametrize("awaited", ["M105", "M114", "G1 X1", 'M409 K"heat"', "M117 hi"])
@pytest.mark.parametrize("has_heat", [True, False])
def test_a_late_ok_is_none_too_many(awaited, has_heat):
    rig = Rig(has_heat)
    rig.send(awaited)
    rig.wait(COST_SECONDS)
    assert len(rig.wire) == 2
    rig.answer()
    assert not rig.may_send
    rig.answer()
    rig.send("G1 X2")
    assert not rig.may_send
    rig.answer()
    assert rig.may_send


def test_an_ok_that_comes_just_before_the_question_is_none_too_many():
    rig = Rig()
    rig.send("G1 X1")
    rig.wait(SILENT_SECONDS - 0.5)
    asks = rig.link.extra_ok.asks

    def crossing(answer):
        # the receiving thread is quicker than the worker
        rig.answer()
        rig.send("G1 X2")
        asks(answer)

    rig.link.extra_ok.asks = crossing
    rig.wait(0.5)
    assert rig.wire == ["G1 X2", "M105"]
    rig.answer()
    assert not rig.may_send
    rig.answer()
    assert rig.may_send


def test_asks_otherwise_when_the_answer_is_lost_too():
    rig = Rig()
    rig.send("G1 X1")
    rig.answer(is_lost=True)
    rig.wait(COST_SECONDS - 1)
    assert rig.answer(is_lost=True) == "M105"
    rig.wait(COST_SECONDS - 1)
    assert rig.answer() == "M114"
    assert rig.may_send


def test_an_answer_to_the_first_question_doesnt_count_behind_the_second():
    rig = Rig()
    rig.send("G1 X1")
    rig.wait(9)
    assert rig.wire == ["G1 X1", "M105", "M114"]
    rig.answer()
    rig.answer()
    assert not rig.may_send
    rig.answer()
    assert rig.may_send
    rig.send("G1 X2")
    rig.answer()
    assert rig.may_send


def test_leaves_a_dead_board_to_octoprint():
    rig = Rig()
    rig.send("G1 X1")
    rig.wait(60)
    assert rig.sent == ["G1 X1", "M105", "M114", "M115"]
    # OctoPrint goes on by itself
    rig.comm._clear_to_send.set()
    rig.send("M105")
    assert rig.link.extra_ok.awaits is None


@pytest.mark.parametrize("line", ["G28", "M109 S200", "T1", "M999", "M112", "M120 G28 M121"])
def test_asks_nothing_while_the_board_is_busy_for_long(line):
    rig = Rig()
    rig.send(line)
    rig.wait(60)
    assert rig.sent == [line]


def test_asks_nothing_while_the_board_reports():
    rig = Rig()
    rig.send("G1 X1")
    for _ in range(30):
        rig.wait(2)
        rig.hear("T:21.0 /0.0 T0:21.0 /0.0")
    assert rig.sent == ["G1 X1"]


@pytest.mark.parametrize("seed", range(30))
def test_whatever_is_lost_or_late_one_line_is_on_its_way(seed):
    chance = random.Random(seed)
    rig = Rig(has_heat=chance.random() < 0.7)
    plain = 0
    for _ in range(400):
        if rig.may_send:
            plain += 1
            rig.send(f"G1 X{plain}")
        assert sum(line.startswith("G1") for line in rig.wire) <= 1, rig.wire
        if rig.wire and chance.random() < 0.5:
            rig.answer(is_lost=chance.random() < 0.1)
        elif chance.random() < 0.3:
            rig.wait(chance.choice([1, 3, 5]))
        if not rig.wire and not rig.may_send:
            # all was lost; OctoPrint finds out
            rig.wait(5)
            if not rig.wire:
                rig.comm._clear_to_send.set()
    assert plain > 50
    assert [line for line in rig.sent if line[:2] == "G1"] == [
        f"G1 X{number + 1}" for number in range(plain)
    ]
