"""Plugins that look at the line behind this one see what they know, and can count it."""

from pathlib import Path

import pytest

from tests.support import plugins

from .. import helpers

pytestmark = pytest.mark.both_hosts("each calls hooks with its own code")

ONLOOKER = Path(plugins.__file__).with_name("tasmota.py")
BOARD = {"machine": "manyaxes", "speed": 20}
SERVER = {"plugin_files": (ONLOOKER,)}
OWN = "/api/plugin/rrfmodel"


def seen(server):
    response = server.get("/api/plugin/tasmota")
    assert response.status_code == 200, response.text
    return response.json()


def post(server, path, request):
    response = server.post(path, json=request)
    assert response.status_code == 204, response.text


@pytest.fixture(scope="module")
def ready(server, board):
    """A machine that may move and extrude, with modes that are not those of its start."""
    server.commands("G28", "T0", "G90", "M83")
    helpers.wait_value(server, "move.axes[].homed", lambda homed: all(homed), 60)
    helpers.wait_value(server, "state.currentTool", 0, 20)
    with board.board.lock:
        for heater in board.board.model["heat"]["heaters"]:
            heater.update(state="active", active=210, current=210.0)
        board.board.bump("heat")
    helpers.wait_value(server, "heat.heaters[0].current", lambda now: now > 200, 20)
    return board


def filament(board):
    return sum(each["position"] for each in board.board.model["move"]["extruders"])


def modes(board):
    usb = board.board.model["inputs"][3]
    return usb["axesRelative"], usb["drivesRelative"]


def test_polls_are_status_requests(server, board):
    before = seen(server)
    helpers.wait_polls(server, 3)
    after = seen(server)
    for phase in ("queued", "left"):
        assert set(after[phase][len(before[phase]) :]) == {"M105"}, phase
    # and what has gone out are polls
    assert any(map(helpers.is_poll, helpers.commands(board)[-10:]))
    assert not helpers.polls_without_status(helpers.commands(board))


@pytest.mark.parametrize(
    "path, request_of",
    [
        ("/api/printer/tool", lambda mm: {"command": "extrude", "amount": mm, "speed": 600}),
        (OWN, lambda mm: {"command": "extrude", "amounts": mm, "speed": 600}),
    ],
    ids=["OctoPrint's", "the plugin's"],
)
@pytest.mark.parametrize("relative", ["M83", "M82"])
def test_row_31_filament_is_counted(server, ready, path, request_of, relative):
    server.commands(relative)
    helpers.wait_value(
        server, "inputs[3].drivesRelative", lambda found: found is (relative == "M83"), 20
    )
    before, at, left = seen(server), filament(ready), modes(ready)
    for amount in (5, -2, 4):
        post(server, path, request_of(amount))
    server.wait_for(
        lambda: seen(server)["filament"] == pytest.approx(before["filament"] + 7), 20, "the count"
    )
    server.wait_for(lambda: filament(ready) == pytest.approx(at + 7), 20, "the filament")
    server.wait_for(lambda: modes(ready) == left, 20, "the modes of before")
    # they go on counting in the mode that the board goes on in
    assert seen(server)["absolute"] == before["absolute"] == (relative == "M82")


@pytest.mark.parametrize(
    "path, request_of",
    [
        ("/api/printer/printhead", lambda mm: {"command": "jog", "x": mm, "speed": 6000}),
        (OWN, lambda mm: {"command": "jog", "axes": {"X": mm}, "speed": 6000}),
    ],
    ids=["OctoPrint's", "the plugin's"],
)
def test_a_jog_is_a_move(server, ready, path, request_of):
    before, left = len(seen(server)["sent"]), modes(ready)
    post(server, path, request_of(1))
    server.wait_for(lambda: "M121" in seen(server)["sent"][before:], 20, "the jog")
    sent = [line for line in seen(server)["sent"][before:] if line[0] == "G"]
    assert sent == ["G91", "G1 X1 F6000", "G90"]
    server.wait_for(lambda: modes(ready) == left, 20, "the modes of before")


def test_positions_can_be_read(server, ready):
    """Also by who looks very early, and on a machine with more than three axes."""
    before = seen(server)["positions"]
    server.commands("M114")
    server.wait_for(lambda: seen(server)["positions"] > before, 10, "a position")
    told = [line for line in seen(server)["received"] if line.startswith("X:")]
    assert told and all(" Z:" in line and " E:" in line for line in told)


def test_nothing_of_the_plugins_own_is_heard(server, board):
    helpers.wait_polls(server, 2)
    assert not [line for line in seen(server)["received"] if '{"key"' in line]
