"""What is called between notes: what is due, and behind a note everything."""

import time

import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side
import pytest

from octoprint_rrfmodel.link.worker import LONGEST_WAIT, Worker
from tests.support.waiting import wait_for


class Ticks:
    """Counts its calls; due again after so many seconds."""

    def __init__(self, seconds):
        self.seconds = seconds
        self.calls = 0

    def __call__(self):
        self.calls += 1
        return self.seconds


@pytest.fixture
def worker():
    made = Worker("rrfmodel.test")
    yield made
    made.stop()


def test_between_notes_what_is_not_due_is_left_alone(worker):
    often, seldom = Ticks(0.001), Ticks(60.0)
    worker.attach({}, [often, seldom])
    began = time.monotonic()
    worker.start()
    wait_for(lambda: often.calls >= 50, 10, "the one that is due")
    # what changed on another thread is looked at now and then all the same
    assert 1 <= seldom.calls <= 1 + (time.monotonic() - began) / LONGEST_WAIT


def test_a_note_has_everything_called(worker):
    seldom, heard = Ticks(60.0), []
    worker.attach({"line": heard.append}, [seldom])
    for text in ("a", "b", "c"):
        worker.notify("line", text)
    worker.start()
    wait_for(lambda: seldom.calls >= 4, 10, "a call before and behind each note")
    assert heard == ["a", "b", "c"]


def test_one_that_raises_does_not_stop_the_others(worker):
    other = Ticks(0.001)
    worker.attach({}, [lambda: 1 / 0, other])
    worker.start()
    wait_for(lambda: other.calls >= 3, 10, "the other one")
    assert other.calls >= 3
