"""From connecting to a complete model: every machine, every firmware, recorded models."""

import json

import pytest

from tests.support.waiting import within

from .. import helpers

pytestmark = pytest.mark.both_hosts(
    "each has its own code for the serial line", once_for=("machine", "firmware", "name")
)

MACHINES = ("cartesian", "corexy", "toolchanger", "delta", "idex", "cnc", "manyaxes")

# firmware → the version that it reports
FIRMWARE = {
    "3.3": "3.3",
    "3.4": "3.4.6",
    "3.5.1": "3.5.1",
    "3.5.3": "3.5.3",
    "3.6": "3.6.0",
    "3.6.4": "3.6.4",
    "3.7": "3.7.0",
}

RECORDED = (
    "om342_mini5plus_full_idle.json",
    "om35b1_mini5plus_full_idle.json",
    "om360b1_duet2wifi_full_idle.json",
)


def assert_sane(state, protocol):
    assert state["connected"] is True
    assert state["is_rrf"] is True
    assert state["protocol"] == protocol
    assert state["blocked"] is None
    assert state["resets"] == 0
    assert state["revision"] > 0
    # OctoPrint's settings and the profile of the bench are those of a new OctoPrint
    assert [
        found for found in state["warnings"] if not found.get("fix", "").startswith("fix_")
    ] == []
    counters = state["counters"]
    assert counters["polls"] >= counters["replies"] > 10 or protocol == "M408"
    assert counters["bytes"] > 3000
    # not those that timed out: the end of the connection before may have cut off a poll
    wrong = ("malformed", "out_of_buffers", "rewritten")
    assert {name: counters[name] for name in wrong} == dict.fromkeys(wrong, 0)


@pytest.mark.parametrize(
    "machine, firmware",
    [(machine, "3.5.3") for machine in MACHINES]
    + [("toolchanger", firmware) for firmware in FIRMWARE if firmware != "3.5.3"]
    + [("manyaxes", "3.3"), ("delta", "3.6")],
)
def test_machine(server, board_factory, machine, firmware):
    before = helpers.status(server)
    board = board_factory(machine=machine, firmware=firmware)
    seconds = helpers.connect(server, board)
    assert seconds <= within(helpers.READY_SECONDS)
    state = helpers.status(server)
    # they count on over connections
    state["resets"] -= before["resets"]
    for name, count in before["counters"].items():
        state["counters"][name] -= count
    assert_sane(state, "M409")
    mainboard = board.board.mainboard
    assert state["firmware"]["name"] == mainboard.firmware_name
    assert state["firmware"]["version"] == FIRMWARE[firmware]
    assert state["firmware"]["electronics"] == mainboard.electronics
    assert state["firmware"]["date"].startswith(board.board.firmware.date)
    helpers.wait_equal(server, board)
    # what is live is there and is a number
    axes = helpers.value(server, "move.axes[].machinePosition")
    assert axes == [axis["machinePosition"] for axis in board.board.model["move"]["axes"]]
    assert helpers.polls_without_status(helpers.commands(board)) == []


@pytest.mark.parametrize("machine", ["cartesian", "toolchanger", "delta"])
def test_firmware_without_m409(server, board_factory, machine):
    """M408 alone, and yet the same paths."""
    board = board_factory(machine=machine, firmware="2.05")
    helpers.connect(server, board, 30)
    board.board.execute("M140 S61\nM106 P0 S0.5\nM220 S130\nM290 S0.05\nG28")
    board.board.speed = 20
    own_tools = [tool["number"] for tool in board.board.model["tools"] if tool]
    axes = [axis["letter"] for axis in board.board.model["move"]["axes"]]
    expected = {
        "state.status": "idle",
        "state.currentTool": -1,
        "tools[].number": own_tools,
        "move.axes[].homed": [True] * len(axes),
        "move.axes[].letter": axes,
        "move.speedFactor": 1.3,
        "boards[0].firmwareVersion": "2.05.1",
        "heat.bedHeaters[0]": 0,
        "heat.heaters[0].active": 61,
        "heat.heaters[0].state": "active",
        "fans[0].requestedValue": 0.5,
    }
    for key, wanted in expected.items():
        assert helpers.wait_value(server, key, wanted, 30) == wanted
    helpers.wait_value(server, "heat.heaters[0].current", lambda found: 58 < found < 63, 30)
    state = helpers.status(server)
    assert state["protocol"] == "M408"
    assert state["firmware"]["version"] == "2.05.1"
    assert "Duet 2 WiFi" in state["firmware"]["name"]
    sent = helpers.commands(board)
    assert helpers.polls_without_status(sent) == []
    # what the firmware doesn't know isn't asked for again and again
    assert sum(command.startswith("M409") for command in sent) <= 3


@pytest.mark.parametrize("name", RECORDED)
def test_recorded_model(server, board_factory, shared_dir, name):
    from octoprint_rrfmodel.simulator import captured

    path = shared_dir / "captures" / name
    model = captured.load(path)
    board = board_factory(model=model, firmware=captured.firmware_of(model))
    helpers.connect(server, board)
    helpers.wait_equal(server, board)
    recorded = json.loads(path.read_text(encoding="utf-8"))
    recorded = recorded.get("result", recorded)
    for key in ("boards[0].firmwareVersion", "boards[0].name", "move.kinematics.name"):
        assert helpers.value(server, key)
    assert helpers.value(server, "network.name") == recorded["network"]["name"]
    assert helpers.value(server, "#tools") == len(recorded["tools"])
    assert helpers.status(server)["firmware"]["version"] == recorded["boards"][0]["firmwareVersion"]
