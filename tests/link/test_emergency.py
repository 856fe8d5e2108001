"""An emergency stop is sent so that it is read at once, and says truthfully when that is."""

import threading
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.guard.recovery import Recovery
from octoprint_rrfmodel.link.link import Doing
from octoprint_rrfmodel.link.serial import emergency
from octoprint_rrfmodel.link.serial.queued import QueuedCommands
from octoprint_rrfmodel.link.serial.serial_link import SerialLink
from octoprint_rrfmodel.rrf.views.machine import Machine
from tests.support.waiting import wait_for


class Comm:
    """What of OctoPrint's connection is looked at; ``wire`` is what was written past its queue."""

    def __init__(self):
        self._checksum_requiring_commands = ["M110"]
        self._sanity_check_tools = True
        self.wire = b""

    def _do_send_without_checksum(self, cmd, log=True):
        assert not log
        self.wire += cmd + b"\n"


@pytest.fixture
def rig():
    notes = []
    link = SerialLink(dict, dict, lambda: 100.0)
    link.is_known_now(Comm())
    queued = QueuedCommands(
        link, lambda *note: notes.append(note), lambda cmd, gcode, tags: None, translators=()
    )

    def queue(cmd, gcode, tags=()):
        return queued.on_queuing(link.connection, "queuing", cmd, None, gcode, tags=set(tags))

    return SimpleNamespace(link=link, notes=notes, queue=queue)


@pytest.mark.parametrize("tags", [(), ("source:api",), ("source:file",)])
def test_an_empty_line_goes_in_front(rig, tags):
    rig.link.awaited, rig.link.awaited_command = "M109", "M109 S200"
    assert rig.queue("M112", "M112", tags) is None
    assert rig.link.connection.wire == b"\n"
    assert rig.notes == [("halted", Doing("M109 S200", "heating", 0.0))]


def test_nothing_else_brings_one(rig):
    for line in ("M105", "M122", "G28", "M0"):
        rig.queue(line, line)
    assert rig.link.connection.wire == b""
    assert rig.notes == []


def test_row_19_diagnostics_are_numbered_so_that_they_come_in_their_turn(rig):
    comm = rig.link.connection
    assert comm._checksum_requiring_commands == ["M110", "M122"]
    rig.link.is_known_now(comm)
    assert comm._checksum_requiring_commands == ["M110", "M122"]


@pytest.mark.parametrize(
    "version, doing, told",
    [
        ("3.5.3", Doing("M109 S200", "heating", 1.0), [("stop_waits", "M109 S200")]),
        ("3.6.2", Doing("G29", "probing", 1.0), [("stop_waits", "G29")]),
        ("3.6.3", Doing("M109 S200", "heating", 1.0), []),
        ("3.7.0", Doing("M109 S200", "heating", 1.0), []),
        ("", Doing("G28", "homing", 1.0), [("stop_waits", "G28")]),
        ("3.5.3", Doing("G1 X5", "other", 1.0), []),
        ("3.5.3", None, []),
    ],
)
def test_row_19_says_that_it_waits(version, doing, told):
    notices = []
    notifications = SimpleNamespace(tell=lambda *notice: notices.append(notice))
    machine = Machine({"boards": [{"firmwareVersion": version}]})
    recovery = Recovery(dict, None, lambda: machine, notifications=notifications, is_held=bool)
    recovery.halted(doing)
    assert recovery.is_wanted
    assert notices == told


class Hooked(Comm):
    """A connection that stops by itself, and OctoPrint's printer, whose hooks may hang."""

    def __init__(self, hangs):
        super().__init__()
        self._connection_closing = False
        self._goes_on = threading.Event()
        if not hangs:
            self._goes_on.set()

    def commands(self, lines, tags, force):
        assert lines == ["M112"] and force
        self._goes_on.wait(20)
        self._trigger_emergency_stop()

    def _trigger_emergency_stop(self):
        if not self._connection_closing:
            self._connection_closing = True
            self.wire += b"M112\n"


@pytest.mark.parametrize("hangs", [False, True])
def test_goes_past_what_hangs(monkeypatch, hangs):
    monkeypatch.setattr(emergency, "HUNG_SECONDS", 0.05 if hangs else 20)
    comm, notes = Hooked(hangs), []
    link = SerialLink(lambda: comm, dict, lambda: 100.0, notify=lambda *note: notes.append(note))
    link.is_known_now(comm)
    link.stop_now({"api:x"})
    wait_for(lambda: b"M112" in comm.wire, 10, "the emergency stop")
    # in its usual way OctoPrint's hook does both
    assert comm.wire == (b"\nM112\n" if hangs else b"M112\n")
    assert notes == ([("halted", None)] if hangs else [])
    comm._goes_on.set()
