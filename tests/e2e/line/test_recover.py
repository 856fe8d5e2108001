"""Going on after an emergency stop: the restart is offered, and OctoPrint connects again."""

import time
from pathlib import Path

import pytest

from tests.support import plugins
from tests.support.basedir import ADMIN, OPERATOR, READER
from tests.support.push import PushListener
from tests.support.waiting import within

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts("each has its own code for the serial line", once_for=("firmware",)),
    pytest.mark.slow,
]

RECOVER_SECONDS = 40
TIMES = Path(plugins.__file__).with_name("recovery_times.py")


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(plugin_files=(TIMES,))


@pytest.fixture
def times(server):
    """Function that gives the restart other times until the test is over."""

    def give(**seconds):
        request = {"command": "set", **seconds}
        response = server.post("/api/plugin/recovery_times", json=request)
        assert response.status_code == 204, response.text

    yield give
    give()


@pytest.fixture(autouse=True)
def disconnected(server, board_factory):
    yield
    if server.state().startswith(("Printing", "Paus")):
        server.post("/api/job", json={"command": "cancel"})
        server.wait_state("Operational", 40)
    helpers.disconnect(server)


def recover(client):
    return client.post("/api/plugin/rrfmodel", json={"command": "recover"})


def halted(server):
    return [found for found in helpers.status(server)["warnings"] if found["code"] == "halted"]


def connected_again(server, board):
    """Return once OctoPrint has a board that was restarted, with a fresh model."""
    server.wait_for(lambda: not board.board.is_halted, 20, "the restart")
    server.wait_state("Operational", RECOVER_SECONDS)
    helpers.wait_ready(server, 20)
    assert helpers.value(server, "state.status") != "halted"
    assert halted(server) == []
    helpers.wait_equal(server, board)


def emergency_stop(server, board):
    server.post("/api/printer/command", json={"command": "M112"})
    server.wait_disconnected()
    server.wait_for(lambda: board.board.is_halted, 5, "the emergency stop")


@pytest.mark.parametrize("firmware", ["3.5.3", "3.3"])
def test_after_octoprints_emergency_stop(server, board_factory, firmware):
    board = board_factory(firmware=firmware)
    helpers.connect(server, board)
    emergency_stop(server, board)
    (warning,) = server.wait_for(lambda: halted(server), 5, "the offer")
    assert warning["fix"] == "recover"
    before = len(board.board.received())
    started = time.monotonic()
    assert recover(server).status_code == 204
    assert time.monotonic() - started < within(2)
    connected_again(server, board)
    assert "M999" in helpers.commands(board)[before:]


def test_connected_and_halted(server, board_factory):
    board = board_factory()
    helpers.connect(server, board)
    board.board.inject("halted")
    server.wait_for(lambda: halted(server), 5, "the warning")
    with server.client(OPERATOR) as operator:
        assert recover(operator).status_code == 204
        # once more does no harm
        assert recover(operator).status_code == 204
    connected_again(server, board)
    assert helpers.commands(board).count("M999") == 1


def test_connecting_to_a_halted_board(server, board_factory):
    board = board_factory()
    board.board.inject("halted")
    helpers.disconnect(server)
    server.connect(board.link)
    server.wait_state("Operational", 20)
    (warning,) = server.wait_for(lambda: halted(server), 10, "the warning")
    assert warning["fix"] == "recover"


def test_row_12_who_connects_to_another_board_meanwhile_stays_connected(
    server, board_factory, times
):
    # time enough to be quicker than the restart
    times(SENDING_SECONDS=20)
    board = board_factory()
    helpers.connect(server, board)
    board.board.inject("halted")
    helpers.wait_value(server, "state.status", "halted", 10)
    assert recover(server).status_code == 204
    helpers.disconnect(server)
    other = board_factory(machine="toolchanger")
    helpers.connect(server, other)
    server.wait_for(
        lambda: "Somebody has connected to another printer" in server.log(), 60, "the restart's end"
    )
    helpers.wait_polls(server, 2)
    assert server.state() == "Operational"
    helpers.wait_equal(server, other)


def test_a_port_that_stays(server, board_factory):
    """An adapter's port is there all the time, and so is the one that OctoPrint was told."""
    board = board_factory()
    helpers.connect(server, board)
    board.board.power_cycle = board.board.reset
    board.board.inject("halted")
    server.wait_for(lambda: halted(server), 5, "the warning")
    assert recover(server).status_code == 204
    connected_again(server, board)


def test_board_that_does_not_come_back(server, board_factory, times):
    times(RETURN_SECONDS=3)
    board = board_factory()
    helpers.connect(server, board)
    board.board.inject("halted")
    server.wait_for(lambda: halted(server), 5, "the warning")
    with PushListener(server, ADMIN) as push:
        assert recover(server).status_code == 204
        server.wait_disconnected()
        board.stop()
        notice = push.wait_for_plugin(lambda found: found.get("code") == "recover_failed", 60)
        assert notice["text"].endswith(".")


def test_refused(server, board_factory):
    board = board_factory(speed=5)
    helpers.connect(server, board)
    with server.client(READER) as reader:
        assert recover(reader).status_code == 403
    server.commands("G28")
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 30)
    server.upload("slow.gcode", "".join(f"G1 X{20 + n % 100} F600\n" for n in range(2000)))
    server.select_and_print("slow.gcode")
    server.wait_state("Printing")
    response = recover(server)
    assert response.status_code == 409
    assert response.json()["error"].endswith(".")
    assert "M999" not in helpers.commands(board)
