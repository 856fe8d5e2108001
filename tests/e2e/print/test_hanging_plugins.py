"""Another plugin's code that waits for ever stops neither the guard nor the plugin's worker."""

from pathlib import Path

import pytest

from tests.support import plugins
from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers, prints

pytestmark = pytest.mark.slow

both_hosts = pytest.mark.both_hosts("each calls hooks and receivers with its own code")

SERVER = {"plugin_files": (Path(plugins.__file__).with_name("hanging.py"),)}
HANGING = "/api/plugin/hanging"


def release(server):
    assert server.post(HANGING, json={"command": "release"}).status_code == 204


@pytest.fixture
def hang(server):
    """Function that lets the other plugin's code hang, and returns once it does."""

    def wait(where, cause=lambda: None):
        body = {"command": "hang", "where": where}
        assert server.post(HANGING, json=body).status_code == 204
        cause()
        server.wait_for(
            lambda: server.get(HANGING).json()["hangs"], 20, f"the other plugin to hang at {where}"
        )

    yield wait
    release(server)


@pytest.fixture
def connected(server, board_factory):
    board = board_factory(machine="cartesian", firmware="3.5.3")
    helpers.connect(server, board)
    yield board
    release(server)
    if server.state().startswith(("Printing", "Paus", "Resum")):
        server.post("/api/job", json={"command": "cancel"})
        server.wait_state("Operational", 40)
    helpers.disconnect(server)


@pytest.fixture
def printing(server, connected):
    """A board on which OctoPrint streams a long print."""
    prints.print_long(server)
    return connected


def causes(server):
    found = helpers.status(server)["warnings"]
    paused = next((each for each in found if each["code"] == "print_paused"), {"causes": ()})
    return [cause["code"] for cause in paused["causes"]]


@both_hosts
def test_print_pauses_while_a_receiver_of_messages_hangs(server, printing, hang):
    hang("messages")
    # the model stays fresh, many messages later
    helpers.wait_polls(server, 3)
    printing.board.inject("heater_fault:1")
    server.wait_state("Paused", 20)
    assert causes(server) == ["heater_fault_1"]
    with PushListener(server, ADMIN) as push:
        release(server)
        # what couldn't be told is told then
        server.wait_for(
            lambda: [each for each in push.of_plugin() if each.get("code") == "print_paused"],
            10,
            "the notice",
        )


@both_hosts
def test_pause_that_hangs_leaves_the_way_to_an_emergency_stop(server, printing, hang):
    """The first thing that a pause of OctoPrint's queues; it holds OctoPrint's lock meanwhile."""
    hang("M400", lambda: printing.board.inject("heater_fault:1"))
    assert server.state() == "Pausing"
    # the worker goes on, and tells that nothing comes any more
    server.wait_for(lambda: causes(server) == ["heater_fault_1"], 5, "the cause")
    stop(server)
    server.wait_for(lambda: "M112" in helpers.commands(printing), 5, "the emergency stop")


def test_pause_goes_on_when_nothing_hangs_any_more(server, printing, hang):
    hang("M400", lambda: printing.board.inject("heater_fault:1"))
    release(server)
    server.wait_state("Paused", 20)
    assert causes(server) == ["heater_fault_1"]
    helpers.wait_polls(server, 2)


def stop(server):
    response = server.post("/api/plugin/rrfmodel", json={"command": "emergency_stop"})
    assert response.status_code == 204, response.text


def test_worker_goes_on_while_a_poll_hangs(server, connected, hang):
    """What is received is still taken in, and told; with the hook the polls go on by themselves."""
    with PushListener(server, ADMIN) as push:
        hang("M105")
        seen = len(push.of_plugin())
        server.wait_for(
            lambda: any(each["status"]["stale"] for each in news(push, seen)), 20, "stale"
        )
        connected.board.message("T:123.00 /0.00 B:45.00 /0.00\n")
        server.wait_for(
            lambda: any("heat" in each.get("changed", ()) for each in news(push, seen)),
            10,
            "the temperatures",
        )
    release(server)
    server.wait_for(lambda: not helpers.status(server)["stale"], 40, "the model to be fresh")
    helpers.wait_polls(server, 3)
    assert not helpers.polls_without_status(helpers.commands(connected))


def news(push, seen):
    return [each for each in push.of_plugin()[seen:] if "status" in each]
