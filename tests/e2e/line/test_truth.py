"""What OctoPrint itself shows: temperatures, the current tool, errors and faults as they are."""

import copy

import pytest

from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts("each has its own code for the serial line", once_for=("firmware",)),
]


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(profile={"heatedChamber": True, "extruder": {"count": 11}})


@pytest.fixture(scope="module")
def small_server(module_server_factory):
    """OctoPrint as it is before anybody has told it of the machine."""
    return module_server_factory()


def shown(server):
    """Return name → (actual, target) of the temperatures that OctoPrint has."""
    response = server.get("/api/printer?exclude=sd,state")
    assert response.status_code == 200, response.text
    return {
        name: (entry["actual"], entry["target"])
        for name, entry in response.json()["temperature"].items()
        # the profile's chamber, where the machine has none
        if entry["actual"] is not None
    }


def heaters_of(board):
    """Return heater number → (actual, target) as the board has them, rounded as shown."""
    board = board.board
    return {
        number: (round(heater["current"], 1), board.thermal.target(heater))
        for number, heater in enumerate(board.model["heat"]["heaters"])
    }


def assert_shown(server, board, expected, others=()):
    """Wait until OctoPrint has exactly these temperatures; ``expected`` is name → heater."""
    last = {}

    def fits():
        last.clear()
        last.update(shown(server))
        own = heaters_of(board)
        known = {
            name: (None if actual is None else round(actual, 1), target)
            for name, (actual, target) in last.items()
        }
        if set(known) != {*expected, *others}:
            return False
        return all(
            abs((known[name][0] or 0) - own[heater][0]) < 0.6 and known[name][1] == own[heater][1]
            for name, heater in expected.items()
        )

    try:
        server.wait_for(fits, 12, "OctoPrint's temperatures")
    except AssertionError as error:
        raise AssertionError(
            f"{error}\nOctoPrint: {last}\nthe board: {heaters_of(board)}"
        ) from None


TOOLCHANGER = {"tool1": 1, "tool3": 2, "tool7": 3, "tool10": 4, "bed": 0}


@pytest.mark.parametrize(
    "machine, commands, expected, others",
    [
        pytest.param(
            "cartesian", "M140 S45\nM104 T0 S110", {"tool0": 1, "bed": 0}, {"mcu"}, id="cartesian"
        ),
        pytest.param(
            "cartesian",
            "M140 S45\nT0\nM104 S110",
            {"tool0": 1, "bed": 0},
            {"mcu"},
            id="cartesian-selected",
        ),
        pytest.param("toolchanger", "", TOOLCHANGER, (), id="toolchanger-none"),
        pytest.param("toolchanger", "T3", TOOLCHANGER, (), id="toolchanger-3"),
        pytest.param("toolchanger", "T10\nM104 S120", TOOLCHANGER, (), id="toolchanger-10"),
        pytest.param("toolchanger", "T3\nT-1", TOOLCHANGER, (), id="toolchanger-none-again"),
        pytest.param(
            "idex",
            "M140 P0 S50\nM140 P1 S45\nM104 T1 S90",
            {"tool0": 2, "tool1": 3, "tool2": 2, "bed": 0, "B1": 1, "Tool 2 heater 1": 3},
            (),
            id="idex",
        ),
        pytest.param(
            "corexy", "M141 S40", {"tool0": 1, "bed": 0, "chamber": 2}, {"mcu"}, id="chamber"
        ),
        pytest.param("cnc", "", {}, (), id="cnc"),
    ],
)
def test_temperatures(server, board_factory, machine, commands, expected, others):
    board = board_factory(machine=machine, speed=10)
    helpers.connect(server, board)
    for number in (1, 3, 7, 10):
        if machine == "toolchanger":
            board.board.execute(f"M104 T{number} S{100 + number}")
    board.board.execute(commands)
    assert_shown(server, board, expected, others)
    helpers.wait_polls(server, 3)
    assert_shown(server, board, expected, others)


@pytest.mark.parametrize("commands", ["", "T3"])
def test_temperatures_with_the_usual_profile(small_server, board_factory, commands):
    """A profile of one tool knows nothing of T3; no tool of the machine is taken for T0."""
    board = board_factory(machine="toolchanger", speed=10)
    helpers.connect(small_server, board)
    board.board.execute(commands)
    assert_shown(small_server, board, TOOLCHANGER)


def test_sensors_keep_their_names(server, board_factory):
    board = board_factory(machine="cartesian")
    with board.board.lock:
        analog = board.board.data["sensors"]["analog"]
        for name, reading in (("T1", 71.5), ("B", 72.5), ("C", 73.5), ("Enclosure", 74.5)):
            analog.append({**copy.deepcopy(analog[3]), "name": name, "lastReading": reading})
        analog.append({**copy.deepcopy(analog[3]), "name": "Enclosure", "lastReading": 75.5})
        analog.append({**copy.deepcopy(analog[3]), "name": "", "lastReading": 76.5})
        # no sensor there, and one that is broken
        analog.append({**copy.deepcopy(analog[3]), "name": "absent", "lastReading": -273.1})
        analog.append({**copy.deepcopy(analog[3]), "name": "broken", "lastReading": 2000.0})
    helpers.connect(server, board)
    names = {"mcu", "Sensor T1", "Sensor B", "Sensor C", "Enclosure", "Enclosure 2", "Sensor 9"}
    assert_shown(server, board, {"tool0": 1, "bed": 0}, names)
    found = shown(server)
    readings = {"Sensor T1": 71.5, "Sensor B": 72.5, "Sensor C": 73.5, "Enclosure": 74.5}
    assert {name: found[name][0] for name in readings} == readings
    assert found["Enclosure 2"][0] == 75.5
    assert found["Sensor 9"][0] == 76.5


def changes(push):
    return [event["new"] for event in push.events("ToolChange")]


def test_tool_changed_elsewhere(server, board_factory):
    """By another panel, and by a macro that OctoPrint knows nothing of."""
    board = board_factory(machine="toolchanger", speed=10)
    board.board.card.write("0:/macros/change.g", "T7\n")
    helpers.connect(server, board)
    with PushListener(server, ADMIN) as push:
        board.board.execute("T3")
        server.wait_for(lambda: changes(push) == [3], 10, "the change to T3")
        board.board.execute('M98 P"0:/macros/change.g"')
        server.wait_for(lambda: changes(push) == [3, 7], 10, "the change to T7")
        server.commands('M98 P"0:/macros/change.g"', "G4 P10")
        # which comes when the macro is through
        server.wait_for(lambda: "G4 P10" in helpers.commands(board), 20, "the end of the macro")
        board.board.execute("T1")
        server.wait_for(lambda: changes(push) == [3, 7, 1], 10, "the change to T1")
        assert push.events("ToolChange")[-1]["old"] == 7
        if server.version.startswith("2"):
            server.wait_for(
                lambda: [p["currentTool"] for k, p in push.messages if k == "current"][-1:] == [1],
                10,
                "the page to be told",
            )
        # no tool at all is nothing that OctoPrint can show
        board.board.execute("T-1")
        helpers.wait_value(server, "state.currentTool", -1, 10)
        helpers.wait_polls(server, 3)
        assert changes(push) == [3, 7, 1]


def test_tool_changed_by_octoprint_is_not_taken_back(server, board_factory):
    board = board_factory(machine="toolchanger", speed=10)
    helpers.connect(server, board)
    order = [1, 3, 10, 7, 3, 1, 7]
    with PushListener(server, ADMIN) as push:
        for number in order:
            server.commands(f"T{number}")
            server.wait_for(
                lambda number=number: changes(push)[-1:] == [number], 10, f"the change to {number}"
            )
        helpers.wait_value(server, "state.currentTool", 7, 15)
        helpers.wait_polls(server, 4)
        assert changes(push) == order


def test_tool_changed_by_octoprint_is_not_taken_back_by_news_of_other_things(server, board_factory):
    """A key that is asked for behind the change tells nothing of the tool."""
    board = board_factory(machine="toolchanger", speed=50)
    helpers.connect(server, board)
    helpers.wait_ready(server)
    order = [1, 3, 10, 7]
    with PushListener(server, ADMIN) as push:
        for number in order:
            before = len(board.board.received())
            for key in ("fans", "boards", "sensors", "inputs", "move", "network"):
                board.board.bump(key)
            server.wait_for(
                lambda before=before: [
                    line
                    for line in helpers.commands(board)[before:]
                    if line.startswith('M409 K"boards"')
                ],
                10,
                "one of the keys to be asked for",
            )
            server.commands(f"T{number}")
            helpers.wait_value(server, "state.currentTool", number, 15)
            helpers.wait_polls(server, 2)
        assert changes(push) == order


ERRORS = {
    "unhomed": "G1 X10",
    "cold": "T0\nG1 E5",
    "file": "M23 missing.gcode",
    "start": "M32 missing.gcode",
    "macro": 'M98 P"0:/macros/missing.g"',
    "tool": "M104 T99 S200",
    "too-hot": "M104 T0 S2000",
    "bed": "M140 P3 S50",
    "fan": "M106 P77 S1",
    "pause": "M25",
    "resume": "M24",
    "mesh": "G29",
    "speed": "M220 S0",
    "filament": 'M701 S"Missing"',
    "syntax": "M409 K5",
    "pop": "M121",
    "power": "M80 C5",
}
"""Commands that fail."""


@pytest.fixture(scope="module")
def erring(server, module_board_factory):
    board = module_board_factory(machine="cartesian", speed=5)
    helpers.connect(server, board)
    return board


def complaints(server):
    return sum("Error:" in line or "Warning:" in line for line in server.received())


@pytest.mark.parametrize("name", ERRORS)
def test_harmless_error(server, erring, name):
    board = erring
    if not server.state().startswith("Operational"):
        helpers.connect(server, board)
    errors = complaints(server)
    lines = ERRORS[name].split("\n")
    with PushListener(server, ADMIN) as push:
        server.commands(*lines, "M117 next")
        server.wait_for(lambda: _arrived(board), 20, "M117")
        server.wait_for(lambda: complaints(server) > errors, 10, "the error")
        helpers.wait_polls(server, 1)
        assert push.events("Error") == push.events("Disconnected") == []
    assert server.state().startswith("Operational")
    assert [c for c in helpers.commands(board) if c.startswith("M112")] == []
    board.board.execute("M117")


def _arrived(board):
    return board.board.model["state"]["displayMessage"] == "next"


def test_move_beyond_the_limits(server, board_factory):
    board = board_factory(machine="cnc", speed=5)
    helpers.connect(server, board)
    board.board.execute("G92 X0 Y0 Z0")
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 5)
    with PushListener(server, ADMIN) as push:
        response = server.post(
            "/api/printer/printhead", json={"command": "jog", "x": 5000, "y": 0, "z": 0}
        )
        assert response.status_code == 204
        server.wait_for(
            lambda: any("outside machine limits" in line for line in server.received()), 10, "it"
        )
        helpers.wait_polls(server, 2)
        assert push.events("Error") == push.events("Disconnected") == []
    assert server.state().startswith("Operational")
    assert "M112" not in helpers.commands(board)


@pytest.mark.parametrize("firmware", ["3.3", "3.5.3"])
def test_heater_fault(server, board_factory, firmware):
    board = board_factory(firmware=firmware)
    helpers.connect(server, board)
    board.board.execute("M140 S60")
    board.board.inject("heater_fault:0")

    def warnings():
        found = helpers.status(server)["warnings"]
        return {
            entry["code"]: entry["text"] for entry in found if "fix_" not in entry.get("fix", "")
        }

    server.wait_for(lambda: "heater_fault_0" in warnings(), 10, "the warning")
    assert "0" in warnings()["heater_fault_0"]
    assert helpers.value(server, "heat.heaters[0].state") == "fault"
    assert server.state().startswith("Operational")
    server.commands("M562 P0")
    server.wait_for(lambda: not warnings(), 10, "the end of the warning")
    assert "M112" not in helpers.commands(board)


def test_halted(server, board_factory):
    board = board_factory()
    helpers.connect(server, board)
    board.board.execute("M112")

    def codes():
        found = helpers.status(server)["warnings"]
        return [entry["code"] for entry in found if "fix_" not in entry.get("fix", "")]

    server.wait_for(lambda: codes() == ["halted"], 10, "the warning")
    assert helpers.value(server, "state.status") == "halted"
    # what OctoPrint asks again and again is allowed; all else is refused, and that is no reason
    server.commands("M104 S0", "G28")
    helpers.wait_polls(server, 2)
    assert server.state().startswith("Operational")
    assert codes() == ["halted"]

    helpers.connect(server, board)
    server.wait_for(lambda: codes() == ["halted"], 10, "the warning after reconnecting")
    assert server.state().startswith("Operational")
    assert helpers.status(server)["firmware"]["version"] == "3.5.3"
    assert "M112" not in helpers.commands(board)
    board.board.reset()
    server.wait_for(lambda: codes() == [], 15, "the end of the warning")
