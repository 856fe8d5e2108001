"""What commands are refused by the printer's state, and jobs that the board runs by itself."""

import pytest

from tests.support.basedir import is_version_2

from .. import helpers
from ..operations import PROFILE, Machine

pytestmark = pytest.mark.slow

COMMAND = "/api/plugin/rrfmodel"

VALID = {
    "tool_temperatures": {"tool": 0, "active": 210},
    "tool_state": {"tool": 0, "state": "active"},
    "bed": {"active": 40},
    "reset_heater_fault": {"heater": 1},
    "fan": {"fan": 0, "speed": 0.5},
    "babystep": {"amount": 0.01},
    "speed_factor": {"percent": 100},
    "extrusion_factor": {"extruder": 0, "percent": 100},
    "home": {"axes": ["X"]},
    "macro": {"path": "0:/macros/Say hello"},
    "mesh": {"action": "clear"},
    "power": {"on": False},
    "jog": {"axes": {"Z": 1}},
    "extrude": {"amounts": 1, "speed": 600},
    "filament": {"action": "unload"},
    "select_tool": {"tool": 0},
    "tool_offsets": {"tool": 0, "offsets": {"X": 0}},
    "job": {"action": "start", "path": "square.gcode"},
    "recover": {},
}

NOT_WHILE_PRINTING = {
    *("home", "macro", "mesh", "power", "job", "jog", "extrude", "filament", "select_tool"),
    *("tool_offsets", "recover"),
}
WHILE_PAUSED = {"jog", "extrude", "filament", "select_tool", "tool_offsets"}

MOVES = "\n".join(f"G1 X{20 + n % 100} Y{20 + n // 100} F600" for n in range(4000)) + "\n"


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(profile=PROFILE)


@pytest.fixture
def ready(server, board_factory):
    """Function that returns a machine that is homed and hot, its tool selected."""

    def connect(speed=20.0, **options):
        board = board_factory(speed=60.0, **options)
        board.board.execute("G28\nM104 T0 S210\nT0")
        server.wait_for(
            lambda: (
                board.board.channels["HTTP"].is_idle
                and board.board.model["heat"]["heaters"][1]["current"] > 205
            ),
            30,
            "the machine to be hot",
        )
        board.board.speed = speed
        helpers.connect(server, board)
        return Machine(server, board)

    yield connect
    if server.state().startswith(("Printing", "Paus", "Resum")):
        server.post("/api/job", json={"command": "cancel"})
        server.wait_state("Operational", 60)
    helpers.disconnect(server)


def ask(server, name, **parameters):
    return server.post(COMMAND, json={"command": name, **(parameters or VALID[name])})


def assert_forbidden(response):
    assert response.status_code == 409, response.text
    error = response.json()["error"]
    assert error[0].isupper() and error.endswith("."), error
    return error


def refused(server, but=()):
    """Return the names of valid commands that are refused; those that go aren't sent."""
    found = set()
    for name in VALID:
        if name not in but and ask(server, name).status_code == 409:
            found.add(name)
    return found


def wait_status(server, status, seconds=40):
    helpers.wait_value(server, "state.status", status, seconds)


# a print that OctoPrint streams


@pytest.fixture
def streaming(ready, server):
    machine = ready(speed=5.0)
    server.upload("long.gcode", MOVES)
    server.select_and_print("long.gcode")
    server.wait_state("Printing")
    helpers.wait_polls(server, 1)
    return machine


@pytest.mark.both_hosts("each streams and pauses with its own code")
def test_while_octoprint_prints(streaming, server):
    for name in NOT_WHILE_PRINTING:
        assert_forbidden(ask(server, name))
    for action in ("pause", "resume", "cancel"):
        assert "/api/job" in assert_forbidden(ask(server, "job", action=action))
    before = len(streaming.board.received())
    assert refused(server, but=NOT_WHILE_PRINTING) == set()
    # they go between the lines of the print
    server.wait_for(lambda: "M106 P0 S0.5" in streaming.sent_since(before), 15, "the fan's line")
    assert server.state() == "Printing"
    assert helpers.polls_without_status(helpers.commands_of(streaming.board)) == []


@pytest.mark.both_hosts("each streams and pauses with its own code")
def test_while_octoprints_print_is_paused(streaming, server):
    server.post("/api/job", json={"command": "pause", "action": "pause"})
    server.wait_state("Paused", 20)
    for name in NOT_WHILE_PRINTING - WHILE_PAUSED - {"recover"}:
        assert_forbidden(ask(server, name))
    for name in WHILE_PAUSED:
        assert ask(server, name).status_code == 204, name
    server.post("/api/job", json={"command": "pause", "action": "resume"})
    server.wait_state("Printing", 20)


# a print that the board runs by itself


@pytest.fixture
def location(octoprint_version):
    return "printer" if is_version_2(octoprint_version) else "sdcard"


def start(machine):
    machine.command(
        "job",
        ['M32 "0:/gcodes/square.gcode"'],
        action="start",
        path="square.gcode",
    )
    wait_status(machine.server, "processing", 10)


def test_while_the_board_prints(ready, server):
    machine = ready(speed=5.0)
    start(machine)
    for name in NOT_WHILE_PRINTING:
        assert_forbidden(ask(server, name))
    assert refused(server, but=NOT_WHILE_PRINTING) == set()


def test_while_the_boards_print_is_paused(ready, server):
    machine = ready(speed=10.0)
    start(machine)
    assert ask(server, "job", action="pause").status_code == 204
    wait_status(server, "paused")
    for name in NOT_WHILE_PRINTING - WHILE_PAUSED - {"recover"}:
        assert_forbidden(ask(server, name))
    for name in WHILE_PAUSED:
        assert ask(server, name).status_code == 204, name


@pytest.mark.both_hosts("each has its own code for the card", once_for=("firmware",))
@pytest.mark.parametrize("firmware", ["3.6", "3.3"])
def test_job_from_its_beginning_to_its_end(ready, server, firmware):
    machine = ready(speed=20.0, firmware=firmware)
    start(machine)
    job = machine.board.job
    # OctoPrint shows it as its own
    server.wait_state("Printing from SD", 20)
    helpers.wait_value(server, "job.build.objects", bool, 60)
    machine.board.speed = 3.0
    assert ask(server, "object", index=0, action="cancel").status_code == 204
    helpers.wait_value(server, "job.build.objects[0].cancelled", True, 5)
    assert ask(server, "object", index=0, action="resume").status_code == 204
    helpers.wait_value(server, "job.build.objects[0].cancelled", False, 5)
    assert ask(server, "object", index=1, action="cancel").status_code == 400
    assert_forbidden(ask(server, "job", action="resume"))
    assert ask(server, "job", action="pause").status_code == 204
    wait_status(server, "paused")
    server.wait_state("Paused", 20)
    helpers.wait_polls(server, 8)
    assert_forbidden(ask(server, "job", action="pause"))
    assert helpers.commands_of(machine.board).count("M25") == 1
    assert ask(server, "job", action="resume").status_code == 204
    wait_status(server, "processing")
    server.wait_state("Printing from SD", 20)
    assert ask(server, "job", action="cancel").status_code == 204
    wait_status(server, "idle")
    server.wait_state("Operational", 10)
    assert not job.is_printing
    helpers.wait_polls(server, 8)
    # cancel.g ran, and nothing of it was seen as an error that ends the connection
    assert machine.board.model["heat"]["heaters"][1]["active"] == 0
    assert_forbidden(ask(server, "job", action="cancel"))


def test_cancelling_a_paused_job(ready, server):
    machine = ready()
    start(machine)
    assert ask(server, "job", action="pause").status_code == 204
    wait_status(server, "paused")
    assert ask(server, "job", action="cancel").status_code == 204
    wait_status(server, "idle")
    server.wait_state("Operational", 10)


def test_a_job_that_octoprint_does_not_show(ready, server):
    machine = ready()
    # none of the endings that OctoPrint lists
    with machine.board.lock:
        machine.board.card.write("0:/gcodes/square.txt", "G4 S1\n" * 6000)
    machine.command("job", ['M32 "0:/gcodes/square.txt"'], action="start", path="square.txt")
    wait_status(server, "processing", 10)
    machine.command("job", ["M25"], action="pause")
    wait_status(server, "paused", 10)
    assert server.state() == "Operational"
    machine.command("job", ["M24"], action="resume")
    wait_status(server, "processing", 10)
    machine.settle()
    machine.command("job", ["M25", "M400 M0"], action="cancel")
    wait_status(server, "idle", 20)
    assert not machine.board.job.is_printing


def test_simulation(ready, server):
    machine = ready(speed=5.0)
    # a simulation of five seconds is looked at more than once
    machine.board.speed = 0.2
    machine.command(
        "job", ['M37 P"0:/gcodes/square.gcode"'], action="simulate", path="square.gcode"
    )
    wait_status(server, "simulating", 10)
    for name in NOT_WHILE_PRINTING:
        assert_forbidden(ask(server, name))
    machine.board.speed = 5.0
    wait_status(server, "idle", 60)


# without a machine that takes commands


def test_disconnected(server):
    helpers.disconnect(server)
    for name in VALID:
        # which opens the last port again
        if name != "recover":
            assert_forbidden(ask(server, name))
    assert_forbidden(server.post(COMMAND, json={"command": "emergency_stop"}))
    assert server.post(COMMAND, json={"command": "refresh"}).status_code == 204


@pytest.mark.both_hosts("each connects with its own code")
def test_halted(ready, server):
    machine = ready()
    machine.board.inject("halted")
    wait_status(server, "halted", 10)
    for name in VALID:
        if name != "recover":
            assert "recover" in assert_forbidden(ask(server, name))
    assert server.post(COMMAND, json={"command": "refresh"}).status_code == 204
    assert ask(server, "recover").status_code == 204
    server.wait_for(lambda: not machine.board.is_halted, 20, "the restart")
    server.wait_for(lambda: "is connected again" in server.log(), 60, "the end of the restart")
    helpers.wait_ready(server, 40)


@pytest.mark.both_hosts("each has its own code for the serial line")
def test_another_firmware(server_factory):
    other = server_factory(plugins_config={"virtual_printer": {"enabled": True}})
    other.connect("VIRTUAL")
    other.wait_state("Operational")
    for name in VALID:
        assert "RepRapFirmware" in assert_forbidden(ask(other, name))
    assert not [line for line in other.sent() if "M106" in line or "M568" in line]


def test_axes_that_are_not_homed_and_tools_that_are_not_ready(server, board_factory):
    board = board_factory(speed=20)
    helpers.connect(server, board)
    machine = Machine(server, board)
    assert "X, Z" in assert_forbidden(ask(server, "jog", axes={"X": 1, "Z": 1}))
    assert_forbidden(ask(server, "extrude"))
    assert_forbidden(ask(server, "filament"))
    machine.command("select_tool", ["T0"], tool=0)
    helpers.wait_value(server, "state.currentTool", 0, 10)
    machine.settle()
    assert "cold" in assert_forbidden(ask(server, "extrude"))
    machine.command("home", ["G28"])
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 10)
    machine.command("jog", ["M120 G21 G91 G1 Z1 M121"], axes={"Z": 1})
    helpers.disconnect(server)
