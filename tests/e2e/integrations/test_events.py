"""Events of the machine in OctoPrint's event bus, as every client gets them."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers

PREFIX = "plugin_rrfmodel_"


@pytest.fixture(scope="module")
def board(module_board_factory):
    return module_board_factory(machine="toolchanger", firmware="3.6", speed=10)


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory()


@pytest.fixture(scope="module")
def push(server, board):
    """Everything from before the connection on."""
    with PushListener(server, ADMIN) as listener:
        helpers.connect(server, board)
        listener.wait_for_event(PREFIX + "model_ready")
        yield listener


def told(push, name):
    return push.events(PREFIX + name)


def wait_told(server, push, name, payload, before=0):
    """Return whether an event with that payload came, after the first ``before`` ones."""
    return server.wait_for(
        lambda: payload in told(push, name)[before:],
        20,
        f"{name} {payload}",
    )


@pytest.mark.both_hosts("each has its own event bus")
def test_complete_model_is_told_once(push):
    assert len(told(push, "model_ready")) == 1
    assert told(push, "heater_fault") == told(push, "firmware_reset") == []


@pytest.mark.both_hosts("each has its own event bus")
def test_tool(server, push, board):
    board.board.execute("G28")
    board.board.execute("T3")
    assert wait_told(server, push, "tool_changed", {"old": -1, "new": 3})


def home_until_told(server, push, board, before):
    """Home again where nobody has asked the machine while it did."""

    def is_told():
        if {"old": "idle", "new": "busy"} in told(push, "status_changed")[before:]:
            return True
        if helpers.value(server, "state.status") == "idle":
            board.board.execute("G28")
        return False

    server.wait_for(is_told, 20, "the machine that homes")


def test_status(server, push, board):
    helpers.wait_value(server, "state.status", "idle", 20)
    before = len(told(push, "status_changed"))
    home_until_told(server, push, board, before)
    assert wait_told(server, push, "status_changed", {"old": "busy", "new": "idle"}, before)


def test_box(server, push, board):
    board.board.execute('M291 P"Secret text" R"Title" S2')
    server.wait_for(lambda: told(push, "message_box_opened"), 10, "the box")
    seq = helpers.value(server, "state.messageBox.seq")
    assert told(push, "message_box_opened")[-1] == {"mode": 2, "seq": seq}
    board.board.execute("M292")
    assert wait_told(server, push, "message_box_closed", {"mode": 2, "seq": seq})
    assert "Secret" not in str(push.events())


def test_fault(server, push, board):
    board.board.inject("heater_fault:1")
    assert wait_told(server, push, "heater_fault", {"heater": 1})
    board.board.clear("heater_fault:1")
    board.board.execute("M562 P1")


def test_job(server, push, board):
    board.board.execute('M23 "square.gcode"')
    board.board.execute("M24")
    assert wait_told(server, push, "job_started", {})
    (finished,) = server.wait_for(lambda: told(push, "job_finished"), 90, "the end of the job")
    assert finished["cancelled"] is False
    assert finished["duration"] > 0


def test_reset(server, push, board):
    ready = len(told(push, "model_ready"))
    board.board.reset()
    server.wait_for(lambda: told(push, "firmware_reset"), 60, "the reset")
    assert server.wait_for(
        lambda: len(told(push, "model_ready")) > ready, 60, "the model to be complete"
    )
