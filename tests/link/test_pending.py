"""What is in OctoPrint's queues counts before it has left."""

import threading
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.known import Known
from octoprint_rrfmodel.link.serial.serial_link import SerialLink
from octoprint_rrfmodel.rrf.wire.request import ModelRequest

try:
    from octoprint.plugins.serial_connector.serial_comm import (
        CommandQueue,
        SendQueue,
        SendQueueMarker,
    )
except ImportError:
    from octoprint.util.comm import CommandQueue, SendQueue, SendQueueMarker

LIVE = ModelRequest("", "d99fin")


class Rig:
    def __init__(self):
        self.now = 100.0
        self.comm = SimpleNamespace(
            _send_queue=SendQueue(), _command_queue=CommandQueue(), _clear=threading.Event()
        )
        self.link = SerialLink(dict, dict, lambda: self.now)
        self.link.is_known_now(self.comm)
        store = SimpleNamespace(model={})
        follower = SimpleNamespace(store=store, behind=False, live_keys=())
        self.known = Known(follower, self.link, lambda: self.now)
        self.ask()

    def ask(self):
        self.now += 1
        self.known.note(LIVE, self.now)

    def queue(self, line):
        self.comm._send_queue.put((line, None, None, None, False, set()))


@pytest.fixture
def rig():
    return Rig()


@pytest.mark.parametrize(
    "line", ["G28", "g28 x", "T1", "T-1", "M109 S200", "M1234", 'M98 P"a.g"', "M120 G28 M121"]
)
def test_what_was_known_is_old_once_a_change_is_queued(rig, line):
    assert rig.known.is_current()
    rig.queue(line)
    rig.ask()
    assert not rig.known.is_current()


@pytest.mark.parametrize("line", ["G1 X5", "M105", 'M409 K"heat"', "M104 S200", "M106 S1", "X20"])
def test_harmless_lines_change_nothing(rig, line):
    rig.queue(line)
    rig.comm._command_queue.put((line, None, None, set()))
    assert rig.known.is_current()


@pytest.mark.parametrize("marker", [SendQueueMarker(), (SendQueueMarker(), None, None, set())])
def test_a_marker_is_no_command(rig, marker):
    # alone it ends the sending when OctoPrint disconnects
    rig.comm._send_queue.put(marker)
    assert rig.known.is_current()
    rig.queue("G28")
    assert not rig.known.is_current()


def test_what_a_print_holds_back_counts_too(rig):
    rig.comm._command_queue.put(("G28", None, None, set()))
    assert not rig.known.is_current()


def test_from_the_sending_to_the_answer_after_the_ok(rig):
    rig.link.connection = rig.comm
    rig.link.awaits("M1234", "M1234")
    rig.ask()
    assert not rig.known.is_current()
    rig.now += 1
    rig.link.acknowledged()
    assert not rig.known.is_current()
    rig.ask()
    assert rig.known.is_current()


def test_no_connection_changes_nothing(rig):
    rig.queue("G28")
    rig.link.forget()
    assert rig.known.is_current()
