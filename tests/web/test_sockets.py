"""What sockets are told without a question, and when."""

from types import SimpleNamespace
from typing import NamedTuple

import pytest

pytest.importorskip("octoprint")

import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

from octoprint_rrfmodel.web.moonraker.sockets import Sockets


class Loop:
    """Tornado's, which does at once what it is given."""

    def add_callback(self, function, *arguments):
        function(*arguments)


class Socket(NamedTuple):
    is_named: bool


class Hub:
    """Keeps what its sockets are told."""

    def __init__(self):
        self.sockets = set()
        self.told = []

    def notify(self, method, params, permission, is_for_named=False):
        self.told.append((method, params, permission, is_for_named))

    def responded(self, line):
        self.told.append(line)

    def changed(self):
        pass

    look_again = changed


@pytest.fixture
def made():
    at = SimpleNamespace(now=100.0, hub=Hub(), asked=0)

    def params():
        at.asked += 1
        return [at.now]

    at.sockets = Sockets(None, None, None, clock=lambda: at.now, redeem=None)
    at.sockets._hub, at.sockets._loop = at.hub, Loop()
    at.sockets.each_second("notify_proc_stat_update", params, "READ")
    return at


def test_each_second_those_who_may_are_told(made):
    made.hub.sockets.add(Socket(True))
    for made.now in (100.0, 100.4, 101.0):
        made.sockets.tick()
    told = [("notify_proc_stat_update", [now], "READ", True) for now in (100.0, 101.0)]
    assert made.hub.told == told


def test_nothing_is_measured_for_nobody(made):
    # nor for one that has not said what it is
    made.hub.sockets.add(Socket(False))
    made.sockets.tick()
    assert (made.hub.told, made.asked) == ([], 0)


def test_who_looks_at_no_answer_sees_a_refusal(made):
    made.hub.sockets.add(Socket(False))
    made.sockets.refused("No printer is connected.")
    assert made.hub.told == ["!! No printer is connected."]
