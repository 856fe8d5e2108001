"""A board on the network that is reset, can't be reached, or answers nonsense."""

import concurrent.futures
import time

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener
from tests.support.waiting import within

from .. import helpers
from . import bench

BOARD = {"machine": "cartesian", "speed": 5}

HEIGHTMAP = "/plugin/rrfmodel/heightmap"

LONG = "G28\n" + "".join(
    f"G1 X{20 + n % 100} Y{20 + n // 100} Z0.{n % 10} F3000\n" for n in range(20000)
)


def prepare(board):
    board.card.write("0:/gcodes/long.gcode", LONG)


@pytest.fixture
def printing(server, face):
    bench.at_panel(face, 'M32 "0:/gcodes/long.gcode"')
    server.wait_state("Printing", 30)
    yield
    face.board.clear("net_loss")
    bench.at_panel(face, "M25")
    bench.at_panel(face, "M0")
    server.wait_state("Operational", 60)


def test_print_is_still_there_after_a_gap(server, face, printing):
    with PushListener(server, ADMIN) as push:
        face.board.inject("net_loss")
        server.wait_for(
            lambda: helpers.status(server)["blocked"] == "unreachable", 30, "the gap to be seen"
        )
        assert bench.command(server, "fan", fan=0, speed=1).status_code == 409
        assert server.state() == "Printing"
        face.board.clear("net_loss")
        server.wait_for(lambda: helpers.status(server)["blocked"] is None, 60, "the end of the gap")
        helpers.wait_polls(server, 2)
        assert server.state() == "Printing"
        assert push.events("PrintFailed") + push.events("PrintStarted") == []
        assert push.events("Disconnected") == []


def test_reset_ends_the_print_and_not_the_connection(server, face):
    assert bench.reset_in_a_print(server, face) == (0, 1)
    assert helpers.status(server)["is_rrf"]
    wait_reachable(server)
    server.commands('M117 "again"')
    helpers.wait_value(server, "state.displayMessage", "again", 20)


def test_forgotten_session_is_made_anew_once(server, face):
    face.board.inject("net_stale_key")
    wait_reachable(server)
    server.commands('M117 "anew"')
    helpers.wait_value(server, "state.displayMessage", "anew", 20)
    assert helpers.status(server)["is_rrf"]


COUNT = "set global.retries = global.retries + 1"


def wait_reachable(server):
    server.wait_for(lambda: helpers.status(server)["blocked"] is None, 60, "the end of the gap")
    helpers.wait_polls(server, 2)


def test_no_command_is_sent_twice_when_its_answer_is_lost(server, face):
    server.commands("set global.retries = 0")
    helpers.wait_value(server, "global.retries", 0, 20)
    codes = ("unsent_doubtful", "unsent_away")
    with PushListener(server, ADMIN) as push:
        face.board.inject("net_slow:8")
        server.commands(COUNT)
        told = push.wait_for_plugin(lambda data: data.get("code") in codes, 60, "the doubt")
        face.board.clear("net_slow")
    wait_reachable(server)
    # a question may have been under way, so that it was known at once that it would come late
    is_carried_out = told["code"] == "unsent_doubtful"
    helpers.wait_value(server, "global.retries", int(is_carried_out), 20)
    server.commands(COUNT)
    wanted = int(is_carried_out) + 1
    helpers.wait_value(server, "global.retries", wanted, 60)
    # and none comes behind it
    helpers.wait_polls(server, 2)
    assert helpers.value(server, "global.retries") == wanted


PATHS = ("/api/version", "/api/files/printer", "/api/connection", "/api/job", HEIGHTMAP)

MORE_SECONDS = 0.1
"""By how much a request to OctoPrint may take longer while the board is slow."""


def times_of(server, count):
    """Return how long each of so many requests takes, the shortest first."""
    times = []
    for number in range(count):
        began = time.monotonic()
        server.get(PATHS[number % len(PATHS)])
        times.append(time.monotonic() - began)
    return sorted(times)


def test_slow_board_holds_up_nobody(server, face):
    """Neither OctoPrint's few threads for requests nor its loop wait for a board."""
    with face.board.lock:
        face.board.volumes_changed(True)
    path = "/api/files/printer/long.gcode"
    server.wait_for(lambda: server.get(path, headers=bench.NEW).ok, 30, "the file to be listed")
    before = times_of(server, 40)
    # longer than this machine takes for anything else, and answers are waited for
    pause = min(4.0, within(2))
    face.board.inject(f"net_slow:{pause}")
    with concurrent.futures.ThreadPoolExecutor() as pool:
        download = pool.submit(server.get, "/downloads/files/printer/long.gcode")
        began = time.monotonic()
        for _ in range(3):
            bench.printer(server, "tool", command="target", targets={"tool0": 0})
        # each of the three would have waited for it at least once
        assert time.monotonic() - began < 2.5 * pause
        slow = times_of(server, 40)
        assert download.result(60).text == LONG
    face.board.clear("net_slow")
    wait_reachable(server)
    middle = len(slow) // 2
    assert slow[middle] - before[middle] < within(MORE_SECONDS), (before, slow)
    # and none of them has waited for an answer of the board's, whatever else this machine did
    assert slow[-3] < 0.75 * pause, slow


@pytest.mark.parametrize("fault", ["net_503:5", "net_foreign:4", "net_redirect:4", "net_reset:3"])
def test_nonsense_ends_nothing(server, face, fault):
    replies = helpers.status(server)["counters"]["replies"]
    face.board.inject(fault)
    server.wait_for(
        lambda: helpers.status(server)["counters"]["replies"] >= replies + 4,
        90,
        "replies behind the fault",
    )
    assert server.state() == "Operational"
    assert helpers.status(server)["is_rrf"]
