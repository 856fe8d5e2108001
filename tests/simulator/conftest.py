"""A board on a clock that only moves when a test says so."""

from __future__ import annotations

import json

import pytest

from octoprint_rrfmodel.simulator.board import Board
from tests.support.recordings import RECORDINGS


class Bench:
    """A board, a host that speaks to it, and their clock."""

    def __init__(self, machine="cartesian", firmware="3.5.3", **options):
        self.time = 0.0
        self.board = Board(machine, firmware, clock=lambda: self.time, **options)

    def send(self, *lines):
        """Return what the board answers at once to these lines."""
        self.board.receive("".join(line + "\n" for line in lines).encode("utf-8"))
        return self.board.transmit().decode("utf-8", "surrogateescape")

    def wait(self, seconds):
        """Return what the board says in that time."""
        self.time += seconds
        return self.board.transmit().decode("utf-8", "surrogateescape")

    def until(self, condition, most=3600.0, step=0.5):
        """Let time pass until the condition holds; return what the board has said meanwhile."""
        said = ""
        end = self.time + most
        while not condition(self.board):
            assert self.time < end, "that never happened"
            said += self.wait(step)
        return said

    def done(self, *lines, most=3600.0):
        """Return everything up to the end of these lines, however long they take."""
        said = self.send(*lines)
        return said + self.until(lambda board: board.channels["USB"].is_idle, most)

    def ask(self, key="", flags=""):
        """Return the result of an M409 from USB."""
        return self.reply(key, flags)["result"]

    def reply(self, key="", flags=""):
        text = self.send(f'M409 K"{key}" F"{flags}"')
        assert text.endswith("\n\nok\n")
        return json.loads(text[: -len("\n\nok\n")])

    @property
    def status(self):
        return self.board.model["state"]["status"]

    def homed(self):
        """Return itself with all axes homed and time standing at a quiet moment."""
        self.done("G28")
        return self


@pytest.fixture
def bench():
    return Bench


@pytest.fixture
def captures():
    """The folder of captured replies of real boards."""
    folder = RECORDINGS / "captures"
    if not folder.is_dir():
        pytest.skip(f"no captures: {folder} isn't there, set RRF_SHARED")
    return folder


@pytest.fixture
def golden():
    """Answers of the firmware's own code on a synthetic tree."""
    path = RECORDINGS / "golden" / "m409-small.json"
    if not path.is_file():
        pytest.skip(f"no golden answers: {path} isn't there, set RRF_SHARED")
    return json.loads(path.read_text(encoding="utf-8"))
