"""Polls without a status request behind them: what depends on one is seen to otherwise."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.tags import FILE_TAG, POLL_TAG
from octoprint_rrfmodel.link.serial.patience import LONGEST_MOVE_SECONDS, STILL_BUSY
from octoprint_rrfmodel.link.serial.queued import QueuedCommands

from .test_serial_link import FIRMWARE, Rig

POLL = 'M409 K"state" F"fin"'


class Line(Rig):
    """The rig of the link with the hook that everything is queued through."""

    def __init__(self):
        super().__init__()
        self.received.on_firmware_info(self.comm, FIRMWARE, {"FIRMWARE_NAME": FIRMWARE})
        self.link._printer = lambda: SimpleNamespace(commands=lambda *args, **kwargs: None)
        self.link.polls_alone = True
        self.received._card.fill = lambda: "// a line in its place"
        self.queued = QueuedCommands(
            self.link, self.note, instead=lambda *command: None, translators=()
        )

    def goes_out(self, cmd, gcode=None, tags=(FILE_TAG,), cmd_type=None):
        """Let a command through both hooks; return what goes out."""
        gcode = gcode or cmd.split()[0]
        tags = set(tags)
        queued = self.queued.on_queuing(self.comm, "queuing", cmd, cmd_type, gcode, tags=tags)
        lines = queued or [(cmd, cmd_type)]
        out = []
        for line, kind, *_ in (tuple([*each, None])[:2] for each in lines):
            name = line.split()[0]
            sent = self.sent.on_sending(self.comm, "sending", line, kind, name, tags=tags)
            out.append(sent or line)
        return out

    def poll(self):
        self.link.ask(SimpleNamespace(line=POLL))
        return self.goes_out("M105", tags=(POLL_TAG,))


@pytest.fixture
def line():
    return Line()


def test_poll_goes_alone_and_its_own_ok_is_its_acknowledgement(line):
    assert line.poll() == [POLL]
    assert ("poll_acknowledged",) not in line.notes
    line.hear('{"key":"state","flags":"fin","result":{"status":"idle"}}')
    assert ("poll_acknowledged",) not in line.notes
    assert line.hear("ok") == "ok"
    assert line.notes.count(("poll_acknowledged",)) == 1
    line.goes_out("G1 X1")
    line.hear("ok")
    assert line.notes.count(("poll_acknowledged",)) == 1


def test_where_polls_are_not_alone_a_status_request_stands_behind_each(line):
    line.link.polls_alone = False
    assert line.poll() == [POLL, "M105"]
    assert line.goes_out("M1234") == ["M1234"]


@pytest.mark.parametrize("cmd", ["M109 S200", "G28", 'M98 P"a.g"', "T1", "M1234 S5", "G6511"])
def test_whatever_may_take_long_has_a_status_request_in_front(line, cmd):
    line.poll()
    line.goes_out("G1 X1")
    assert line.goes_out(cmd) == ["M105", cmd]


def test_one_status_request_is_enough_until_the_next_poll(line):
    line.poll()
    assert line.goes_out("M1234") == ["M105", "M1234"]
    assert line.goes_out("M1234") == ["M1234"]
    line.poll()
    # OctoPrint's own does as well
    line.goes_out("M105", tags=("trigger:comm.poll_temperature",))
    assert line.goes_out("M1234") == ["M1234"]


@pytest.mark.parametrize("cmd", ["G1 X1 E2", "M106 S255", "M117 hi", "M204 P500", "G92 E0"])
def test_lines_of_a_print_go_out_as_they_are(line, cmd):
    line.poll()
    assert line.goes_out(cmd) == [cmd]


def test_move_that_waits_in_silence_is_waited_for(line):
    line.poll()
    line.hear("ok")
    line.goes_out("G1 X500 F60")
    line.now += LONGEST_MOVE_SECONDS - 1
    assert line.hear("") == STILL_BUSY
    line.now += 2
    assert line.hear("") == ""


def test_where_reports_come_silence_behind_a_move_is_a_loss(line):
    line.poll()
    line.goes_out("M105", tags=("trigger:comm.poll_temperature",))
    line.goes_out("G1 X500 F60")
    line.now += 60
    assert line.hear("") == ""


def test_answer_to_the_request_behind_a_poll_is_not_octoprints(line):
    line.link.polls_alone = False
    line.poll()
    # there is more to show than it knows: a tool, another target
    assert line.hear("ok T:20.0 /0.0 B:21.0 /0.0") == "ok T:20.0 /0.0 B:21.0 /0.0"
    line.sent._is_shown = lambda: True
    line.poll()
    assert line.hear("ok T:20.0 /0.0 B:21.0 /0.0") == "ok"
    assert ("report", "ok T:20.0 /0.0 B:21.0 /0.0") in line.notes
    line.goes_out("M105", tags=("trigger:comm.poll_temperature",))
    assert line.hear("ok T:20.0 /0.0 B:21.0 /0.0") == "ok T:20.0 /0.0 B:21.0 /0.0"
