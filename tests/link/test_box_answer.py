"""The answer to a box that holds the line: one ok for its macro, never early, whatever comes."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.serial.queued import QueuedCommands
from octoprint_rrfmodel.link.serial.received import ReceivedLines
from octoprint_rrfmodel.link.serial.serial_link import SerialLink
from octoprint_rrfmodel.rrf.gcode.operations import Lines

ASKS = ("- Tool -", "Is it clean?", "Send M292 to continue or M292 P1 to cancel")
MACRO = 'M98 P"ask.g"'
PROMPTS = {"M876 S1": Lines(("M292 P1",))}
"""Answers to OctoPrint's own prompt, as they are translated."""

POSITION = "X:0.000 Y:0.000 Z:0.000 E:0.000"


class Rig:
    def __init__(self):
        self.now = 100.0
        self.wire = []
        self.comm = SimpleNamespace(_do_send=lambda cmd, gcode=None: self.wire.append(cmd))
        self.link = SerialLink(dict, dict, lambda: self.now)
        self.link.connection = self.comm
        self.received = ReceivedLines(
            self.link,
            SimpleNamespace(is_talking=False, reword=lambda line: line),
            lambda *note: None,
            guards=lambda error: False,
            patience=SimpleNamespace(feed=lambda comm: ""),
            refusals=SimpleNamespace(look=lambda comm, line: None),
        )
        self.queued = QueuedCommands(
            self.link,
            lambda *note: None,
            lambda cmd, gcode, tags: None,
            translators=(lambda cmd, gcode, tags: PROMPTS.get(cmd),),
        )

    def send(self, command):
        self.now += 1
        self.comm._long_running_command = False
        self.link.awaits(command, command.split()[0], {"source:api"})

    def oks(self, *lines):
        """Return how many acknowledgements OctoPrint hears in some lines."""
        heard = [self.received.on_received(self.comm, line) for line in lines]
        return sum(line.startswith("ok") for line in heard)

    def answer(self, line="M292 P0"):
        return self.queued.on_queuing(self.comm, "queuing", line, None, "M292", tags={"api:x"})


@pytest.fixture
def asked():
    """A macro of OctoPrint's that has opened a box."""
    rig = Rig()
    rig.send(MACRO)
    assert rig.oks(*ASKS) == 0
    assert rig.link.waits_in_a_box()
    return rig


def test_one_ok_behind_the_end_of_the_macro(asked):
    assert asked.answer() == (None,)
    assert asked.wire == ["M292 P0"]
    # the macro's end, and the question's own
    assert asked.oks("went on", "ok") == 0
    assert asked.wire == ["M292 P0", "M114"]
    assert asked.oks(POSITION, "ok") == 1
    # and the next command has its own again
    asked.send("G1 X1")
    assert asked.oks("ok") == 1


def test_one_ok_where_the_answer_has_one_too(asked):
    """No firmware is known to; none too many all the same."""
    asked.answer()
    assert asked.oks("ok") == 0
    # the question waits until the macro is through
    assert asked.oks("went on", "ok") == 0
    assert asked.oks(POSITION, "ok") == 1
    asked.send("G1 X1")
    assert asked.oks("ok") == 1


def test_one_ok_where_another_box_comes(asked):
    asked.answer()
    assert asked.oks(*ASKS) == 0
    asked.answer("M292 P1")
    # nothing is in front of the second answer
    assert asked.wire == ["M292 P0", "M292 P1"]
    assert asked.oks("ok") == 0
    assert asked.oks(POSITION, "ok") == 1


def test_an_answer_to_octoprints_own_prompt_goes_the_same_way(asked):
    tags = {"api:x"}
    queue = asked.queued.on_queuing
    assert queue(asked.comm, "queuing", "M876 S1", None, "M876", tags=tags) == (None,)
    assert asked.wire == ["M292 P1"]
    # where none waits it is a command as any other
    assert queue(asked.comm, "queuing", "M876 S1", None, "M876", tags=tags) == [("M292 P1", None)]


def test_an_answer_is_given_once(asked):
    asked.answer()
    assert not asked.link.waits_in_a_box()
    # a second one isn't for the next box, nor written past anything
    assert asked.answer() is None
    assert asked.wire == ["M292 P0"]


def test_box_of_another_channel_or_another_command_is_answered_in_its_turn():
    rig = Rig()
    rig.oks(*ASKS)
    assert rig.answer() is None
    rig.send(MACRO)
    rig.oks(*ASKS, "ok")
    assert not rig.link.waits_in_a_box()
    rig.send("G1 X1")
    assert rig.answer() is None
    assert rig.wire == []
