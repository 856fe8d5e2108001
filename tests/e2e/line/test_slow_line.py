"""Polling on a UART of 115200 baud: how much of the line it takes during a print."""

import time

import pytest

from .. import helpers

pytestmark = pytest.mark.both_hosts("each has its own code for the serial line")

BAUD = 115200
SHARE = 0.05
WATCHED_POLLS = 4


@pytest.fixture
def board(board_factory):
    return board_factory(machine="cartesian", baud=BAUD, speed=1)


def test_polls_take_a_twentieth_of_the_line(server_factory, board):
    server = server_factory()
    server.connect(board.link)
    helpers.wait_ready(server, 60)
    board.board.execute("G92 X0 Y0 Z0", channel="http")
    # slow enough to last, with a line every now and then
    lines = [f"G1 X{number % 2 * 20} F1200" for number in range(400)]
    server.upload("long.gcode", "\n".join(["G92 X0 Y0 Z0", *lines]))
    server.select_and_print("long.gcode")
    server.wait_state("Printing")
    # from one poll to another; the first one may have come at idle pace, after the time before
    helpers.wait_polls(server, 2, 60)
    before = helpers.status(server)["counters"]
    started = time.monotonic()
    helpers.wait_polls(server, WATCHED_POLLS, 180)
    after = helpers.status(server)["counters"]
    seconds = time.monotonic() - started
    assert server.state().startswith("Printing")
    polls = after["polls"] - before["polls"]
    # what stands around each reply: its request, the blank line, two ok, M105 and its answer
    around = polls * 150
    taken = (after["bytes"] - before["bytes"] + around) * 10 / BAUD
    assert polls >= WATCHED_POLLS - 1
    assert taken / seconds <= SHARE * 1.1
