"""What the serial link knows from its hooks alone, without a port."""

import threading
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.link import Doing, Link
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
        self.comm = SimpleNamespace(_clear_to_send=threading.Event())
        self.link = SerialLink(dict, dict, lambda: self.now)
        card = SimpleNamespace(is_talking=False, reword=lambda line: line)
        self.received = ReceivedLines(self.link, card, self.note, guards=lambda error: False)
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

    def send(self, cmd, gcode):
        return self.sent.on_sending(self.comm, "sending", cmd, None, gcode, tags={"api:x"})


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
