"""Commands that keep the line busy: nothing is asked meanwhile, and an M105 goes before each."""

import pytest

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts("each has its own code for the serial line", once_for=("board",)),
    pytest.mark.slow,
]

FIRMWARE = ("3.5.1", "3.5.3")
SECONDS = 10
"""Longer than OctoPrint waits in all."""


@pytest.fixture(scope="module")
def server(module_server_factory):
    # OctoPrint drops a T whose number is beyond the profile's tools
    profile = {"extruder": {"count": 11}}
    return module_server_factory(serial=helpers.SHORT_TIMEOUTS, profile=profile)


@pytest.fixture(scope="module", params=FIRMWARE)
def board(request, server, module_board_factory):
    board = module_board_factory(machine="toolchanger", firmware=request.param)
    board.board.card.write("0:/macros/wait.g", f"G4 S{SECONDS}\n")
    helpers.connect(server, board)
    return board


def home(server):
    response = server.post("/api/printer/printhead", json={"command": "home", "axes": ["x", "y"]})
    assert response.status_code == 204, response.text


@pytest.mark.parametrize(
    "start, command",
    [
        pytest.param(home, "G28 X Y", id="home"),
        pytest.param(lambda server: server.commands("T3"), "T3", id="tool"),
        pytest.param(lambda server: server.commands("T-1"), "T-1", id="no-tool"),
        pytest.param(
            lambda server: server.commands('M98 P"0:/macros/wait.g"'),
            'M98 P"0:/macros/wait.g"',
            id="macro",
        ),
        pytest.param(
            lambda server: server.commands(f"G4 S{SECONDS}"), f"G4 S{SECONDS}", id="dwell"
        ),
        pytest.param(lambda server: server.commands("M400"), "M400", id="moves"),
    ],
)
def test_long_command(server, board, start, command):
    usb = board.board.channels["USB"]
    before = helpers.status(server)["counters"]["replies"]
    count = len(board.board.received())
    if command == "M400":
        server.commands("G92 X0 Y0", f"G1 X{SECONDS} F60")
    if command == "T-1":
        board.board.execute("T1")
        helpers.wait_value(server, "state.currentTool", 1, 15)
    start(server)
    server.wait_for(lambda: command in helpers.commands(board)[count:], 10, f"{command} to arrive")
    reasons = set()

    def is_over():
        reasons.add(helpers.status(server)["blocked"])
        return not usb.is_blocked

    server.wait_for(is_over, 40, "the end of the command")
    assert "long_command" in reasons
    sent = helpers.commands(board)[count:]
    helpers.assert_status_request_in_front(sent, command)
    helpers.wait_polls(server, 2)
    assert helpers.status(server)["counters"]["replies"] > before
    server.wait_for(lambda: helpers.status(server)["blocked"] is None, 10, "the line to be free")
    assert server.state().startswith("Operational")
