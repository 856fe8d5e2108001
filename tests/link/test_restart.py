"""A restart that looks before each step whether the world is still the one that it began in."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.serial import restart as module
from octoprint_rrfmodel.link.serial.restart import Connection, restart


class World:
    """OctoPrint's printer and the link, with a clock that passes by waiting.

    ``events`` are called at their times, as what somebody does meanwhile.
    """

    def __init__(self, monkeypatch, events):
        self.now = 0.0
        self.events = sorted(events, key=lambda event: event[0])
        self.done = []
        self.running = None
        self.prints = self.paused = False
        self.link = SimpleNamespace(connection=None, is_rrf=False, was_identified=self)
        self.current_connection = self._comm = None
        clock = SimpleNamespace(monotonic=lambda: self.now, sleep=self.sleep)
        monkeypatch.setattr(module, "time", clock)
        monkeypatch.setattr(module.os.path, "exists", lambda path: True)

    def sleep(self, seconds):
        self.now += seconds
        while self.events and self.events[0][0] <= self.now:
            self.events.pop(0)[1](self)

    def hold(self, name, is_rrf=True):
        """Let OctoPrint have a connection."""
        self.current_connection = self._comm = name
        self.link.is_rrf = is_rrf
        comm = SimpleNamespace(_do_send_without_checksum=self._write)
        self.link.connection = comm if is_rrf else None

    def _write(self, line):
        self.done.append(line.decode())

    # the event that a board was identified

    def clear(self):
        pass

    def wait(self, seconds):
        self.sleep(seconds)
        return self.link.is_rrf

    # OctoPrint's printer

    def is_operational(self):
        return self.current_connection is not None

    def is_closed_or_error(self):
        return self.current_connection is None

    def is_printing(self):
        return self.prints

    def is_paused(self):
        return self.paused

    def connect(self, **options):
        self.done.append("connect")
        self.hold("ours")

    def disconnect(self):
        self.done.append(f"close {self.current_connection}")
        self.current_connection = self._comm = None
        self.link.connection, self.link.is_rrf = None, False


@pytest.fixture
def run(monkeypatch):
    """Function that restarts in a world in which something happens; returns what was done."""

    def begin(*events, connected=True, prints=False):
        world = World(monkeypatch, events)
        world.prints = prints
        if connected:
            world.hold("first")
        last = Connection("/dev/ttyACM0", 115200, "_default")
        restart(world.link, lambda: world, last, lambda: world.running)
        return world.done

    return begin


def other(is_rrf):
    return lambda world: world.hold("other", is_rrf)


def test_nothing_happens(run):
    assert run() == ["M999", "close first", "close None", "connect"]
    assert run(connected=False) == ["close None", "connect", "M999", "close ours"] + [
        "close None",
        "connect",
    ]


@pytest.mark.parametrize("is_rrf", [True, False])
@pytest.mark.parametrize(
    "when, done",
    [
        # while M999 leaves, and while the port goes
        (0.2, ["M999"]),
        (3.0, ["M999", "close first"]),
    ],
)
def test_somebody_connects_to_another_printer(run, is_rrf, when, done):
    assert run((when, other(is_rrf))) == done


def test_somebody_prints(run):
    assert run((0.2, lambda world: setattr(world, "prints", True))) == ["M999"]


def test_print_that_stands_is_what_the_restart_ends(run):
    assert run((0.2, lambda world: None), prints=True)[0] == "M999"


def test_board_that_prints_by_itself_when_it_is_connected_again(run):
    done = run((3.0, lambda world: setattr(world, "running", True)), connected=False)
    assert done == ["close None", "connect"]
