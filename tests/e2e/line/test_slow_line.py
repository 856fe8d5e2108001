"""On a UART of 115200 baud: a poll never shows in a part that OctoPrint streams."""

import json
import time

import pytest

from octoprint_rrfmodel.rrf.follow.follower import LIVE_ROOT
from octoprint_rrfmodel.rrf.follow.parts import MOST_BYTES
from tests.support.waiting import within

from .. import helpers

pytestmark = pytest.mark.both_hosts("each has its own code for the serial line")

BAUD = 115200
SHARE = 0.03
LONGEST_STOP = 0.04
"""Seconds of the line that may lie between two lines of a print, beside the answers to those."""

GUARD = ("state", "heat.heaters[].state")
GUARD_SECONDS = 2.0
SCATTER_SECONDS = 0.5
"""What a board that waits for a move adds; a busy machine adds to both (``waiting.within``)."""

WATCHED_SECONDS = 15
PAUSED_SECONDS = 3.0


@pytest.fixture
def board(board_factory):
    return board_factory(machine="idex", baud=BAUD, speed=1)


IDLE_SECONDS = 8
SETTLED_POLLS = 8

OTHERS = ("d99fp", "d99fno")
"""Flags with which PanelDue and Duet Web Control ask for all live values again and again."""

SHOWN_SECONDS = 2.0
"""Age of temperatures and positions that both would have to keep to as well."""


def bytes_of_others(board):
    """Return the bytes a second that the thriftiest of their plans would take for the same age."""
    wholes = [helpers.own_reply(board, "", flags) for flags in OTHERS]
    return min(len(json.dumps(whole, separators=(",", ":"))) for whole in wholes) / SHOWN_SECONDS


def print_lines(count):
    """Return a file of short moves, of which each takes a tenth of a second."""
    return "\n".join(["G92 X0 Y0 Z0", *(f"G1 X{n % 2 * 2 + 1} F1200" for n in range(count))])


def watch(server, board, seconds):
    """Return what came in on the wire meanwhile, with the bytes that the board had said."""
    first = len(board.board.log)
    until = time.monotonic() + seconds
    server.wait_for(lambda: time.monotonic() >= until, seconds + 10, "the print to go on")
    return list(board.board.log[first:])


def has_come_once(board):
    """Return whether the board has last been asked for nothing that it wasn't asked for before."""
    polls = [command for command in helpers.commands(board) if helpers.is_poll(command)]
    return set(polls[-SETTLED_POLLS:]) <= set(polls[:-SETTLED_POLLS])


def test_streamed_print_hardly_sees_the_polls(server_factory, board):
    server = server_factory()
    server.connect(board.link, BAUD)
    helpers.wait_ready(server, 60)
    server.wait_for(lambda: has_come_once(board), 60, "all parts to have come once")
    log = watch(server, board, IDLE_SECONDS)
    taken = log[-1].said - log[0].said + sum(len(line.text) + 1 for line in log)
    asked = [helpers.NUMBERED.match(line.text)["command"] for line in log]
    if LIVE_ROOT.line in asked:
        # comes every five minutes, and when something has happened; not so often as to count here
        taken -= bytes_of_others(board) * SHOWN_SECONDS
    assert taken / (log[-1].time - log[0].time) <= bytes_of_others(board) / 2, asked

    board.board.execute("G92 X0 Y0 Z0", channel="http")
    server.upload("long.gcode", print_lines(2000))
    server.select_and_print("long.gcode")
    server.wait_state("Printing")
    helpers.wait_polls(server, 3, 60)
    log = watch(server, board, WATCHED_SECONDS)
    assert server.state().startswith("Printing")

    polls, stops, taken = {}, [], 0
    for before, line, after in zip(log, log[1:], log[2:]):
        command = helpers.NUMBERED.match(line.text)["command"]
        if not helpers.is_poll(command):
            continue
        said = after.said - line.said
        assert said <= MOST_BYTES + len("\n\nok\n"), command
        # a line of the print stands between any two of them
        assert not helpers.is_poll(helpers.NUMBERED.match(after.text)["command"])
        assert not helpers.is_poll(helpers.NUMBERED.match(before.text)["command"])
        polls.setdefault(command.split('"')[1], []).append(line.time)
        stops.append((len(line.text) + 1 + said) * 10 / BAUD)
        taken += stops[-1]
    assert max(stops) <= LONGEST_STOP
    seconds = log[-1].time - log[0].time
    assert taken / seconds <= SHARE
    assert taken * BAUD / 10 / seconds <= bytes_of_others(board) / 2
    for key in GUARD:
        times = polls[key]
        gaps = [later - sooner for sooner, later in zip(times, times[1:])]
        assert max(gaps) <= within(GUARD_SECONDS + SCATTER_SECONDS), key

    server.wait_for(lambda: not helpers.status(server)["stale"], 10, "fresh values")
    status = helpers.status(server)
    assert status["age"] <= within(GUARD_SECONDS + SCATTER_SECONDS)
    # what nobody looks at is older, and said to be so
    assert status["ages"]["heat"] >= status["age"]
    assert set(status["ages"]) == set(helpers.value(server, "", "d1vno"))

    board.board.inject("heater_fault:1")
    server.wait_state("Paused", PAUSED_SECONDS + SCATTER_SECONDS)
    # with the line free all is fetched that has changed meanwhile
    helpers.wait_equal(server, board, 30)
    server.post("/api/job", json={"command": "cancel"})
    helpers.disconnect(server)
