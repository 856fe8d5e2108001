"""PSUControl switches the machine's supply through the plugin and is told its state."""

from pathlib import Path

import pytest

from tests.support import plugins

from .. import helpers

PSUCONTROL = Path(plugins.__file__).with_name("psucontrol.py")
ENDPOINT = "/api/plugin/psucontrol"


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(
        plugin_files=(PSUCONTROL,), plugins_config={"psucontrol": {"plugin": "rrfmodel"}}
    )


@pytest.fixture(scope="module")
def board(server, module_board_factory):
    board = module_board_factory(machine="cartesian")
    helpers.connect(server, board)
    return board


def is_on(server):
    response = server.get(ENDPOINT)
    assert response.status_code == 200, response.text
    return response.json()["isPSUOn"]


def switch(server, word):
    assert server.post(ENDPOINT, json={"command": f"turnPSU{word}"}).status_code == 204


def test_switches_and_knows_the_state(server, board):
    assert is_on(server) is True
    for word, command, state in (("Off", "M81", False), ("On", "M80", True)):
        before = len(board.board.received())
        switch(server, word)
        server.wait_for(lambda state=state: is_on(server) is state, 10, f"the supply to be {word}")
        assert board.board.model["state"]["atxPower"] is state
        sent = [line for line in helpers.commands(board)[before:] if line.startswith("M8")]
        assert sent == [command]


@pytest.mark.both_hosts("each streams and pauses with its own code")
def test_refusal_is_logged_and_nothing_is_sent(server, board):
    server.commands("G28")
    helpers.wait_value(server, "move.axes[].homed", lambda homed: all(homed), 60)
    server.upload("long.gcode", "".join(f"G1 X{20 + n % 100} F600\n" for n in range(2000)))
    server.select_and_print("long.gcode")
    server.wait_state("Printing")
    before = len(board.board.received())
    try:
        switch(server, "Off")
        helpers.wait_polls(server, 2)
        assert "M81" not in helpers.commands(board)[before:]
        assert "ValueError" in server.log()
        assert is_on(server)
    finally:
        server.post("/api/job", json={"command": "cancel"})
        server.wait_state("Operational", 40)


def test_without_a_machine_it_is_off(server, board):
    helpers.disconnect(server)
    assert is_on(server) is False
