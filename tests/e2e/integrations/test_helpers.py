"""The example plugin in a real OctoPrint: helpers, hook and events, as another plugin sees them."""

import pytest

from octoprint_rrfmodel.simulator.machines import MACHINES
from tests.support.basedir import DISABLED_PLUGINS, OPERATOR, READER
from tests.support.places import ROOT

from .. import helpers

EXAMPLE = ROOT / "extras" / "example_plugin" / "rrfmodel_example.py"
ENDPOINT = "/api/plugin/rrfmodel_example"
HEATER = 1


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(plugin_files=(EXAMPLE,))


@pytest.fixture(scope="module")
def board(server, module_board_factory):
    board = module_board_factory(machine="cartesian")
    helpers.connect(server, board)
    return board


def seen(server):
    response = server.get(ENDPOINT)
    assert response.status_code == 200, response.text
    return response.json()


@pytest.mark.both_hosts("each hands helpers and hooks to plugins")
def test_sees_the_model(server, board):
    server.wait_for(lambda: "heat" in seen(server)["keys_seen"], 10, "the hook to be called")
    now = seen(server)
    assert now["installed"] is now["ready"] is True
    assert now["machine"] == MACHINES["cartesian"].name
    assert set(now["keys_seen"]) <= set(board.board.model)
    assert len(now["temperatures"]) == len(board.board.model["heat"]["heaters"])
    bed = board.board.model["heat"]["heaters"][0]
    assert now["bed"]["temperature"] == pytest.approx(bed["current"], abs=2)
    assert now["bed"]["target"] == 0


def test_lamp_follows_a_fault(server, board):
    assert seen(server)["lamp"] is False
    told = len(seen(server)["faults_told"])
    board.board.inject(f"heater_fault:{HEATER}")
    server.wait_for(lambda: seen(server)["lamp"], 10, "the lamp to be on")
    server.wait_for(lambda: len(seen(server)["faults_told"]) > told, 10, "the event")
    assert seen(server)["faults_told"][told:] == [HEATER]
    board.board.clear(f"heater_fault:{HEATER}")
    reset = server.post(ENDPOINT, json={"command": "reset", "heater": HEATER})
    assert reset.status_code == 204, reset.text
    server.wait_for(lambda: not seen(server)["lamp"], 10, "the lamp to be off")
    assert "The lamp is on" in server.log()


@pytest.mark.both_hosts("lines go through the queue of the host")
def test_asks_the_printer(server, board):
    asked = server.post(ENDPOINT, json={"command": "ask", "key": "move.axes[0].letter"})
    assert asked.status_code == 204, asked.text
    answers = server.wait_for(lambda: seen(server)["answers"], 10, "the printer's answer")
    assert answers["move.axes[0].letter"] == "X"


@pytest.mark.parametrize(
    "request_body, said",
    [
        ({"command": "reset", "heater": 999}, "999"),
        ({"command": "reset", "heater": "G28"}, ""),
        ({"command": "ask", "key": 'a"\nM112'}, ""),
    ],
    ids=["no such heater", "no number", "a line break"],
)
def test_refusal_is_a_sentence_and_nothing_is_sent(server, board, request_body, said):
    before = len(board.board.received())
    response = server.post(ENDPOINT, json=request_body)
    assert response.status_code == 409
    assert said in response.text
    helpers.wait_polls(server, 2)
    sent = helpers.commands(board)[before:]
    assert not [line for line in sent if line.startswith(("M562", "M112", "G28"))]


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_needs_the_permissions(server, board):
    with server.client(READER) as reader:
        assert reader.get(ENDPOINT).status_code == 200
        body = {"command": "reset", "heater": HEATER}
        assert reader.post(ENDPOINT, json=body).status_code == 403
    with server.client(OPERATOR) as operator:
        assert operator.post(ENDPOINT, json={"command": "ask", "key": "state"}).status_code == 204


def test_without_the_plugin_it_says_so(server_factory):
    disabled = [*DISABLED_PLUGINS, "rrfmodel"]
    server = server_factory(plugin_files=(EXAMPLE,), settings={"plugins": {"_disabled": disabled}})
    assert seen(server) == {"installed": False}
    response = server.post(ENDPOINT, json={"command": "ask", "key": "state"})
    assert response.status_code == 409
