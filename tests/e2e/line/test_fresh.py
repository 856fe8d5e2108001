"""How soon a change of the machine is seen, and that a new beginning of the board is noticed."""

import time

import pytest

from tests.support.waiting import within

from .. import helpers

pytestmark = pytest.mark.both_hosts(
    "each has its own code for the serial line", once_for=("board", "change", "key", "wanted")
)


@pytest.fixture(scope="module", params=["3.5.3", "3.3"])
def board(request, server, module_board_factory):
    board = module_board_factory(machine="cartesian", firmware=request.param, speed=5)
    helpers.connect(server, board)
    return board


@pytest.mark.parametrize(
    "change, key, wanted",
    [
        pytest.param("M104 S205 T0", "tools[0].active[0]", 205, id="tool-target"),
        pytest.param("M140 S71", "heat.heaters[0].active", 71, id="bed-target"),
        pytest.param("M106 P0 S0.4", "fans[0].requestedValue", 0.4, id="fan"),
        pytest.param("M42 P0 S0.5", "state.gpOut[0].pwm", 0.5, id="port"),
    ],
)
def test_live_value(server, board, change, key, wanted):
    helpers.wait_polls(server, 1)
    board.board.execute(change)
    assert helpers.wait_value(server, key, wanted, helpers.LIVE_SECONDS) == wanted


def test_temperature(server, board):
    helpers.wait_polls(server, 1)
    with board.board.lock:
        board.board.data["heat"]["heaters"][1]["current"] = 180.0
    assert (
        helpers.wait_value(
            server, "heat.heaters[1].current", lambda found: found > 90, helpers.LIVE_SECONDS
        )
        > 90
    )


def test_position(server, board):
    board.board.execute("G92 X0 Y0 Z0")
    helpers.wait_value(server, "move.axes[].machinePosition", [0, 0, 0], 10)
    board.board.execute("G90\nG1 X25 Y7.5 F12000")
    server.wait_for(lambda: not board.board.motion.is_moving, 10, "the end of the move")
    assert helpers.wait_value(
        server, "move.axes[].machinePosition", [25, 7.5, 0], helpers.LIVE_SECONDS
    ) == [25, 7.5, 0]


BEFORE = {"M84": "G28", "M21": "M22", "M451": "M453"}
"""What brings about the state that a change ends."""


@pytest.mark.parametrize(
    "change, key, wanted",
    [
        pytest.param("M220 S85", "move.speedFactor", 0.85, id="speed-factor"),
        pytest.param("M221 D0 S95", "move.extruders[0].factor", 0.95, id="extrusion-factor"),
        pytest.param("M290 R0 Z0.08", "move.axes[2].babystep", 0.08, id="babystep"),
        pytest.param('M563 P0 S"Red ""one"""', "tools[0].name", 'Red "one"', id="tool-name"),
        pytest.param("M117 Hello, Prüfer", "state.displayMessage", "Hello, Prüfer", id="display"),
        pytest.param('M550 P"Other"', "network.name", "Other", id="machine-name"),
        pytest.param("set global.material = {null}", "global.material", None, id="null"),
        pytest.param('global fresh = "yes"', "global.fresh", "yes", id="variable"),
        pytest.param("M84", "move.axes[].homed", [False] * 3, id="motors-off"),
        pytest.param("M22", "volumes[0].mounted", False, id="card-out"),
        pytest.param("M21", "volumes[0].mounted", True, id="card-in"),
        pytest.param("M453", "state.machineMode", "CNC", id="mode"),
        pytest.param("M451", "state.machineMode", "FFF", id="mode-back"),
    ],
)
def test_other_value(server, board, change, key, wanted):
    before = BEFORE.get(change)
    if before is not None:
        board.board.execute(before)
        server.wait_for(lambda: board.board.channels["HTTP"].is_idle, 20, "the board to be ready")
    server.wait_for(lambda: helpers.value(server, key) != wanted, 10, "another value")
    board.board.execute(change)
    assert helpers.wait_value(server, key, wanted, helpers.SETTLED_SECONDS) == wanted


def test_homed(server, board):
    board.board.execute("M84")
    helpers.wait_value(server, "move.axes[].homed", [False] * 3, helpers.SETTLED_SECONDS)
    board.board.execute("G28")
    server.wait_for(
        lambda: all(axis["homed"] for axis in board.board.model["move"]["axes"]), 10, "homing"
    )
    assert (
        helpers.wait_value(server, "move.axes[].homed", [True] * 3, helpers.SETTLED_SECONDS)
        == [True] * 3
    )


def test_message_box(server, board):
    assert helpers.value(server, "state.messageBox") is None
    board.board.execute('M291 P"Is it clear?" R"Bed" S3', channel="telnet")
    helpers.wait_value(server, "state.messageBox.message", "Is it clear?", helpers.SETTLED_SECONDS)
    box = helpers.value(server, "state.messageBox")
    assert (box["title"], box["mode"]) == ("Bed", 3)
    board.board.execute("M292 P0")
    helpers.wait_value(server, "state.messageBox", None, helpers.SETTLED_SECONDS)


def test_nothing_differs_after_all_that(server, board):
    helpers.wait_equal(server, board)
    assert helpers.model_differences(server, board) == []


def _reset_by_fault(board):
    board.board.inject("reset")


def _reset_by_button(board):
    board.board.reset()


@pytest.mark.parametrize("reset", [_reset_by_fault, _reset_by_button], ids=["fault", "button"])
def test_reset(server, board_factory, reset):
    board = board_factory(machine="cartesian", speed=5)
    helpers.connect(server, board)
    # a board that has only just begun can't be seen to begin again
    helpers.wait_value(server, "state.upTime", lambda seconds: seconds > 30, 30)
    before = helpers.status(server)
    board.board.execute('M563 P0 S"Before"\nM140 S80\nG28')
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 10)
    helpers.wait_value(server, "tools[0].name", "Before", 5)
    reset(board)
    server.wait_for(
        lambda: helpers.status(server)["resets"] > before["resets"], 10, "the reset to be noticed"
    )
    helpers.wait_ready(server)
    state = helpers.status(server)
    assert state["connected"] is True
    assert state["is_rrf"] is True
    assert state["resets"] == before["resets"] + 1
    assert state["revision"] > before["revision"]
    helpers.wait_equal(server, board)
    assert helpers.value(server, "move.axes[].homed") == [False] * 3
    assert helpers.value(server, "tools[0].name") != "Before"
    assert server.state().startswith("Operational")


def test_reconnect(server, board_factory):
    first = board_factory(machine="cartesian")
    helpers.connect(server, first)
    revision = helpers.status(server)["revision"]
    helpers.disconnect(server)
    for key in ("", "state", "nonsense"):
        response = server.get("/plugin/rrfmodel/model", params={"key": key})
        assert response.status_code == 503
        assert list(response.json()) == ["error"]
        assert response.json()["error"].endswith(".")
    state = helpers.status(server)
    assert state["firmware"] is state["protocol"] is state["age"] is None
    assert (state["ready"], state["is_rrf"], state["connected"]) == (False, False, False)
    assert [
        found for found in state["warnings"] if not found.get("fix", "").startswith("fix_")
    ] == []

    assert helpers.connect(server, first) <= within(helpers.READY_SECONDS)
    helpers.wait_equal(server, first)
    assert helpers.status(server)["revision"] > revision

    other = board_factory(machine="delta", firmware="3.4")
    assert helpers.connect(server, other) <= within(helpers.READY_SECONDS)
    helpers.wait_equal(server, other)
    assert helpers.value(server, "move.kinematics.name") == "delta"
    assert helpers.value(server, "ledStrips") is None


def test_other_protocol_on_reconnect(server, board_factory):
    """What one board could not do is no reason to ask the next one differently."""
    helpers.connect(server, board_factory(firmware="2.05"), 30)
    assert helpers.status(server)["protocol"] == "M408"
    board = board_factory(firmware="3.5.3")
    helpers.connect(server, board)
    assert helpers.status(server)["protocol"] == "M409"
    helpers.wait_equal(server, board)
    assert helpers.value(server, "m408") is None


def test_live_value_by_m408(server, board_factory):
    board = board_factory(firmware="2.05", speed=5)
    helpers.connect(server, board, 30)
    for target in (44, 66):
        helpers.wait_polls(server, 1)
        board.board.execute(f"M140 S{target}")
        key = "heat.heaters[0].active"
        assert helpers.wait_value(server, key, target, helpers.LIVE_SECONDS) == target


OWN_SECONDS = 2
"""OctoPrint's shortest interval between two status requests of its own."""

WATCHED_SECONDS = 8


def test_history_of_octoprint_grows_no_faster_than_without_the_plugin(server, board):
    """OctoPrint keeps each temperature that it hears of, and the plugin asks every second."""

    def kept():
        shown = server.get("/api/printer", params={"history": "true", "limit": 100}).json()
        return shown["temperature"]["history"]

    helpers.wait_polls(server, 1)
    began_at = int(time.time())
    polls = helpers.status(server)["counters"]["polls"]
    server.wait_for(
        lambda: time.time() >= began_at + WATCHED_SECONDS, 2 * WATCHED_SECONDS, "time to go by"
    )
    until = began_at + WATCHED_SECONDS
    entries = [entry for entry in kept() if began_at < entry["time"] <= until]
    assert entries
    assert len(entries) <= WATCHED_SECONDS / OWN_SECONDS + 2
    assert helpers.status(server)["counters"]["polls"] - polls >= WATCHED_SECONDS / 4
