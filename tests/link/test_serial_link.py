"""What the serial link knows from its hooks alone, without a port."""

import threading
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.link import Doing, Link
from octoprint_rrfmodel.link.serial.patience import STILL_BUSY, Patience
from octoprint_rrfmodel.link.serial.received import ReceivedLines
from octoprint_rrfmodel.link.serial.sent import SentCommands
from octoprint_rrfmodel.link.serial.serial_link import SerialLink
from tests.support.places import ROOT

FIRMWARE = "RepRapFirmware for Duet 3 Mini 5+"


class Rig:
    """The link with the hooks that tell it what goes out and comes in, and a clock to turn."""

    def __init__(self):
        self.now = 100.0
        self.notes = []
        # an acknowledgement that OctoPrint is to wait for is taken from it
        self.comm = SimpleNamespace(
            _clear_to_send=threading.Event(),
            _long_running_command=False,
            _heating=False,
            _dwelling_until=False,
            _manualStreaming=False,
            isStreaming=lambda: False,
        )
        self.minutes = 60.0
        self.is_held = False
        self.link = SerialLink(dict, dict, lambda: self.now)
        card = SimpleNamespace(is_talking=False, reword=lambda line: line)
        self.received = ReceivedLines(
            self.link,
            card,
            self.note,
            guards=lambda error: False,
            patience=Patience(self.link, lambda: self.minutes, lambda: self.is_held),
            refusals=SimpleNamespace(look=lambda comm, line: None),
        )
        self.sent = SentCommands(
            self.link,
            self.note,
            lambda: self.now,
            show_target=lambda *target: None,
            sent=lambda cmd, tags: None,
        )

    def note(self, *note):
        self.notes.append(note)

    def hear(self, line):
        return self.received.on_received(self.comm, line)

    def send(self, cmd, gcode, tags=("api:x",)):
        return self.sent.on_sending(self.comm, "sending", cmd, None, gcode, tags=set(tags))

    def stream(self, cmd, gcode):
        return self.send(cmd, gcode, ("source:file", "fileline:12"))


@pytest.fixture
def rig():
    made = Rig()
    made.received.on_firmware_info(made.comm, FIRMWARE, {"FIRMWARE_NAME": FIRMWARE})
    return made


def test_says_what_it_is_doing_from_the_sending_to_the_ok(rig):
    assert rig.link.doing() is None
    rig.send("G28 X", "G28")
    rig.now += 6
    assert rig.link.doing() == Doing("G28 X", "homing", 100.0)
    rig.hear("T0:20.0 /0.0 B:20.0 /0.0")
    assert rig.link.doing().command == "G28 X"
    rig.hear("ok")
    assert rig.link.doing() is None


@pytest.mark.parametrize(
    "cmd, gcode, what",
    [
        ("T3", "T", "tool_change"),
        ("T-1", None, "tool_change"),
        ("M109 S200", "M109", "heating"),
        ('M98 P"purge.g"', "M98", "macro"),
        ("M115", "M115", "other"),
    ],
)
def test_says_it_in_the_words_of_the_contract(rig, cmd, gcode, what):
    rig.send(cmd, gcode)
    assert rig.link.doing().what == what


@pytest.mark.parametrize(
    "cmd, gcode",
    [
        *(("G28", "G28"), ("G29", "G29"), ("G32", "G32"), ("T1", "T"), ("T-1", None)),
        *(('M98 P"a.g"', "M98"), ("G6511", "G6511"), ("M120 G28 M121", "M120")),
    ],
)
def test_silence_of_a_long_command_is_no_silence_to_octoprint(rig, cmd, gcode):
    rig.send(cmd, gcode)
    # OctoPrint's own settings need not know it
    assert rig.comm._long_running_command
    for _ in range(100):
        rig.now += 30
        assert rig.hear("") == STILL_BUSY
    assert rig.link.silent_for() == 3000
    rig.hear("ok")
    rig.now += 30
    assert rig.hear("") == ""
    assert rig.link.silent_for() == 0


@pytest.mark.parametrize("cmd, gcode", [("G1 X10", "G1"), ("M105", "M105"), ("M117 G28", "M117")])
def test_silence_of_a_quick_command_is_silence(rig, cmd, gcode):
    rig.send(cmd, gcode)
    assert not rig.comm._long_running_command
    assert rig.hear("") == ""


def test_a_board_that_stays_silent_is_found_dead(rig):
    rig.minutes = 10.0
    rig.send("G29", "G29")
    rig.now += 600
    assert rig.hear("") == STILL_BUSY
    # a sign of life begins the time anew
    rig.hear("T0:20.0 /0.0 B:20.0 /0.0")
    rig.now += 600
    assert rig.hear("") == STILL_BUSY
    rig.now += 1
    assert rig.hear("") == ""
    # a person may take any time
    rig.is_held = True
    assert rig.hear("") == STILL_BUSY
    rig.is_held, rig.minutes = False, 0.0
    assert rig.hear("") == STILL_BUSY


def test_a_command_that_was_dropped_on_its_way_out_holds_nothing_up(rig):
    rig.send("T1", "T")
    rig.comm._clear_to_send.set()
    rig.now += 30
    assert rig.hear("") == ""
    assert (rig.link.awaited, rig.comm._long_running_command) == (None, False)


def test_row_20_blocked_says_heating_only_where_the_line_waits_for_heat(rig):
    rig.send("M190 S60", "M190")
    assert rig.link.blocked() == "heating"
    rig.hear("ok")
    rig.comm._long_running_command = False  # as OctoPrint does at each ok
    # a report while a move waits for room, which OctoPrint takes for a heat-up
    rig.send("G1 X10", "G1")
    rig.comm._heating = True
    assert rig.link.blocked() is None
    rig.hear("ok")
    rig.send("G28", "G28")
    assert rig.link.blocked() == "long_command"
    rig.send("M120 M116 M121", "M120")
    assert rig.link.blocked() == "heating"


def test_temperatures_of_the_line_go_to_the_worker_and_to_octoprint(rig):
    rig.notes.clear()
    report = "T0:20.0 /0.0 B:20.0 /0.0"
    for line in (report, f"ok {report}", "ok", "B:20.0 /0.0", "Begin file list"):
        assert rig.hear(line) == line
    assert rig.notes == [("report", report), ("report", f"ok {report}"), ("report", "B:20.0 /0.0")]


def test_does_nothing_once_the_connection_is_gone(rig):
    rig.send("G29", "G29")
    rig.link.forget()
    assert rig.link.doing() is None
    assert not rig.link.is_rrf


def test_another_firmware_is_none_of_its_business():
    rig = Rig()
    rig.received.on_firmware_info(rig.comm, "Marlin 2.1", {})
    rig.send("G28", "G28")
    assert (rig.link.is_rrf, rig.link.doing(), rig.notes) == (False, None, [])


def test_is_asked_about_no_line_of_another_firmware_until_it_is_one_of_ours():
    """1.11 tells of firmware for whatever line has a NAME in it, the wrong one first perhaps."""
    rig = Rig()
    received, queuing = {"other": 1, "rrfmodel": 2}, {"rrfmodel": 3}
    rig.comm._received_message_hooks = received
    rig.comm._gcode_hooks = {"queuing": queuing, "sent": {}}
    for _ in range(2):
        rig.received.on_firmware_info(rig.comm, "Marlin 2.1", {})
        assert rig.comm._received_message_hooks == {"other": 1}
        assert rig.comm._gcode_hooks == {"queuing": {}, "sent": {}}
    rig.received.on_firmware_info(rig.comm, FIRMWARE, {"FIRMWARE_NAME": FIRMWARE})
    assert rig.comm._received_message_hooks is received
    assert rig.comm._gcode_hooks["queuing"] is queuing


def test_has_every_member_of_the_seam():
    """A link that lacks one can't be made."""
    assert isinstance(Rig().link, Link)
    assert SerialLink.__abstractmethods__ == frozenset()
    with pytest.raises(TypeError):
        Link()


def test_nobody_else_asks_octoprint_for_its_connection():
    """Whoever wants to know more of the line asks the link."""
    folder = ROOT / "octoprint_rrfmodel"
    asking = {
        str(path.relative_to(folder))
        for path in folder.rglob("*.py")
        if "link.connection." in path.read_text("utf-8")
    }
    assert {path for path in asking if not path.startswith("link/serial/")} == set()


@pytest.mark.parametrize(
    "cmd, gcode, waits",
    [
        ("X20 Y5", None, True),
        ("g1 x5", None, True),
        ("N10 G1 X5", None, True),
        ("echo 1", None, True),
        ("T-1", None, True),
        ("@pause", None, False),
        ("Q0", None, False),
        # OctoPrint counts that by itself
        ("G1 X5", "G1", False),
    ],
)
@pytest.mark.parametrize("setting", [False, True])
def test_waits_for_what_octoprint_takes_for_no_command(rig, cmd, gcode, waits, setting):
    cleared = []
    rig.comm._clear_to_send = SimpleNamespace(clear=lambda: cleared.append(cmd))
    rig.comm._unknownCommandsNeedAck = setting
    rig.send(cmd, gcode)
    assert bool(cleared) == (waits and not setting)
    assert (rig.link.awaited is not None) == (waits or gcode is not None)


@pytest.mark.parametrize("ok", ["ok", "ok\n", "ok\r\n", "ok T:20.0 /0.0 B:20.0 /0.0\n"])
def test_a_move_of_a_file_is_awaited_until_its_ok(rig, ok):
    rig.stream("G1 X1 E0.2", "G1")
    assert rig.link.doing() == Doing("G1 X1 E0.2", "other", 100.0)
    assert rig.link.extruded == ("G1 X1 E0.2", {"source:file", "fileline:12"})
    rig.stream("G1 X2", "G1")  # OctoPrint has given up the ok before
    assert rig.link.awaited_command == "G1 X2"
    assert rig.hear(ok) == ok
    assert rig.link.doing() is None
    assert rig.link.extruded[0] == "G1 X1 E0.2"


@pytest.mark.parametrize("cmd", ["G1 H1 X-200", "G1 X5 M400", "G1 X5 G28"])
def test_a_move_with_more_to_it_is_no_plain_one(rig, cmd):
    rig.stream(cmd, "G1")
    rig.now += 1
    rig.hear("ok\n")
    assert not rig.link.awaits_a_move
    assert rig.link.settled_at == 101.0


def test_behind_a_long_command_a_move_of_a_file_is_a_move_again(rig):
    rig.stream("G28", "G28")
    rig.hear("ok\n")
    rig.stream("G1 X1", "G1")
    rig.now += 30
    assert rig.link.awaits_a_move
    assert rig.hear("") == ""  # its silence is silence
    rig.hear("ok\n")
    rig.stream("G28", "G28")
    assert rig.hear("") == STILL_BUSY


def test_the_ok_too_many_is_taken_out_behind_a_move_of_a_file(rig):
    rig.stream("G1 X1", "G1")
    rig.link.extra_ok.asks(("ok T",))
    assert rig.hear("ok\n") != "ok\n"
    assert rig.link.awaited is not None
    assert rig.hear("ok T:20.0\n") == "ok T:20.0\n"
    assert rig.link.awaited is None


class Later:
    """The thread on which other plugins' hooks run, as a list that a test works through."""

    def __init__(self):
        self.calls = []
        self.queued = []
        self.link = SerialLink(lambda: self, dict, lambda: 100.0, later=self.later)

    def later(self, function, *arguments):
        self.calls.append((function, arguments))

    def commands(self, lines, tags, force=False):
        self.queued.append(lines)

    def go_on(self):
        while self.calls:
            function, arguments = self.calls.pop(0)
            function(*arguments)


def test_what_is_handed_over_stays_in_order():
    later = Later()
    later.link.connection = "one"
    later.link.ask(SimpleNamespace(line='M409 K"heat"'))
    later.link.send_later(["G28"], set())
    assert later.queued == []
    later.go_on()
    assert later.queued == ["M105", ["G28"]]


def test_polls_that_pile_up_behind_a_hook_are_one_and_the_newest():
    later = Later()
    for key in ("heat", "move", "state"):
        later.link.ask(SimpleNamespace(line=f'M409 K"{key}"'))
    # the one that has hung leaves first
    assert later.link.take_asked() == 'M409 K"state"'
    later.go_on()
    assert later.queued == []


def test_nothing_that_was_to_be_sent_goes_into_the_next_connection():
    later = Later()
    later.link.connection = "one"
    later.link.send_later(["G28"], set())
    later.link.connection = "another"
    later.go_on()
    assert later.queued == []
