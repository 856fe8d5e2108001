"""What is asked for in one breath goes out: the firmware decides what becomes of it."""

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers, prints

pytestmark = [
    pytest.mark.both_hosts("each queues operations with its own code", once_for=("machine",)),
    pytest.mark.slow,
    pytest.mark.timeout(240),
]

JOG = "M120 G21 G91 G1 X1 F200 M121"
EXTRUDE = "M120 M83 G1 E1 F300 M121"
OWN = "/api/plugin/rrfmodel"

HOME = ("/api/printer/printhead", {"command": "home", "axes": ["x", "y", "z"]})
SELECT = ("/api/printer/tool", {"command": "select", "tool": "tool0"})


def script(*lines):
    return "/api/printer/command", {"commands": list(lines)}


CASES = {
    "home then jog": (
        HOME,
        ("/api/printer/printhead", {"command": "jog", "x": 1, "speed": 200}),
        JOG,
    ),
    "home then command jog": (
        HOME,
        (OWN, {"command": "jog", "axes": {"X": 1}, "speed": 200}),
        JOG,
    ),
    "command home then jog": (
        (OWN, {"command": "home", "axes": []}),
        ("/api/printer/printhead", {"command": "jog", "x": 1, "speed": 200}),
        JOG,
    ),
    "select then extrude": (
        SELECT,
        ("/api/printer/tool", {"command": "extrude", "amount": 1}),
        EXTRUDE,
    ),
    "heat then extrude": (
        script("T0", "M109 S180"),
        ("/api/printer/tool", {"command": "extrude", "amount": 1}),
        EXTRUDE,
    ),
    "macro then command extrude": (
        script("M1234"),
        (OWN, {"command": "extrude", "amounts": 1, "speed": 300}),
        EXTRUDE,
    ),
    "select then flow": (
        SELECT,
        ("/api/printer/tool", {"command": "flowrate", "factor": 95}),
        "M221 S95",
    ),
    "select then filament": (
        SELECT,
        (OWN, {"command": "filament", "action": "unload"}),
        "M702",
    ),
    "home then mesh": (HOME, (OWN, {"command": "mesh", "action": "clear"}), "G29 S2"),
}


@pytest.mark.parametrize("case", CASES)
def test_row_3_second_goes_out_behind_the_first(machine, case):
    first, second, line = CASES[case]
    before = len(machine.board.received())
    with PushListener(machine.server, ADMIN) as push:
        for path, request in (first, second):
            response = machine.server.post(path, json=request)
            assert response.status_code == 204, response.text
        machine.server.wait_for(
            lambda: line in machine.sent_since(before), 20, "the second operation's line"
        )
        assert machine.sent_since(before)[-1] == line
        notices = {told["code"] for told in push.of_plugin() if told.get("type") == "notice"}
        # what the firmware refuses of it is told, the plugin refuses nothing
        assert notices <= {"refused"}
    machine._is_at_rest = False
    machine.settle()


def test_once_the_state_is_known_it_counts_again(machine):
    before = len(machine.board.received())
    response = machine.server.post("/api/printer/printhead", json={"command": "jog", "x": 1})
    assert response.status_code == 204
    machine.arrive()
    assert machine.sent_since(before) == []


@pytest.fixture
def one_extruder(server_factory, board_factory):
    """A machine with several tools, one of them selected, and a profile with one extruder."""
    server = server_factory(profile={"extruder": {"count": 1}, "heatedBed": True})
    board = board_factory(machine="idex", speed=20)
    helpers.connect(server, board)
    return server, board


def test_row_13_no_tool_becomes_another(one_extruder):
    server, board = one_extruder
    numbers = [tool["number"] for tool in board.board.model["tools"] if tool]
    first, other = numbers[0], numbers[1]

    refused = server.post(
        "/api/printer/tool", json={"command": "target", "targets": {f"tool{other}": 200}}
    )
    assert refused.status_code == 400
    assert "printer profile" in refused.json()["error"]

    server.upload("two.gcode", f"G21\nT{other}\nM104 T{other} S50\nG90\nT{first}\nT{other}\n")
    with PushListener(server, ADMIN) as push:
        server.select_and_print("two.gcode")
        prints.wait_done(server, push, 60)
        sent = helpers.commands(board)
        assert [line for line in sent if line[:1] == "T"] == [
            f"T{number}" for number in (other, first, other)
        ]
    helpers.wait_value(server, "state.currentTool", other, 15)
    before = len(sent)
    targets = {"tool0": 60}
    response = server.post("/api/printer/tool", json={"command": "target", "targets": targets})
    assert response.status_code == 204
    server.wait_for(
        lambda: [line for line in helpers.commands(board)[before:] if line.startswith("M568")],
        10,
        "the target of tool 0, while another is selected",
    )
    heated = [line for line in helpers.commands(board)[before:] if line.startswith("M568")]
    assert heated == ["M568 P0 S60 A2"]
