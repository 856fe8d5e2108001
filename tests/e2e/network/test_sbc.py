"""A board behind a single-board computer, as one by itself."""

import pytest

from octoprint_rrfmodel.simulator.network.sbc_board import SbcBoard
from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers
from . import bench

BOARD = {"machine": "cartesian", "speed": 10}

FACE = SbcBoard

SHORT = "G28\nG1 X20 F6000\n" + "G4 S20\n" * 4 + "G1 X30\n"


def prepare(board):
    board.card.write("0:/gcodes/long.gcode", bench.LONG)
    board.card.write("0:/gcodes/parts/short.gcode", SHORT)


@pytest.fixture(autouse=True)
def _at_rest(without_print):
    """Each test leaves no print behind."""


def wait_board(server, face, key, *wanted, seconds=20):
    server.wait_for(
        lambda: bench.board_value(face, key) in wanted, seconds, f"{key} to be {wanted}"
    )


def test_model_and_operations(server, face):
    state = helpers.status(server)
    assert (state["link"], state["protocol"], state["blocked"]) == ("network", "dsf", None)
    assert state["firmware"]["name"].startswith("RepRapFirmware")
    assert helpers.value(server, "network.name") == face.board.model["network"]["name"]
    assert [warning["code"] for warning in state["warnings"]] == []
    bench.printer(server, "printhead", command="home", axes=["x", "y", "z"])
    helpers.wait_value(server, "move.axes[].homed", [True] * 3, 20)
    before = bench.board_value(face, "move.axes.0.userPosition")
    bench.printer(server, "printhead", command="jog", x=10)
    wait_board(server, face, "move.axes.0.userPosition", before + 10)
    bench.printer(server, "bed", command="target", target=40)
    wait_board(server, face, "heat.heaters.0.active", 40)
    assert bench.command(server, "fan", fan=0, speed=0.5).status_code == 204
    helpers.wait_value(server, "fans[0].requestedValue", 0.5, 10)


def test_job_begun_at_the_machine_is_octoprints(server, face):
    bench.at_panel(face, 'M32 "0:/gcodes/long.gcode"')
    server.wait_state("Printing", 20)
    assert bench.job_state(server) == ("Printing", ("printer", "long.gcode"))
    server.post("/api/job", json={"command": "pause", "action": "pause"})
    wait_board(server, face, "state.status", "paused")
    server.wait_state("Paused", 20)
    server.post("/api/job", json={"command": "pause", "action": "resume"})
    server.wait_state("Printing", 20)
    server.post("/api/job", json={"command": "cancel"})
    wait_board(server, face, "state.status", "idle", "off")
    server.wait_state("Operational", 20)


def test_file_of_octoprints_own_is_brought_and_printed(server, face):
    server.upload("mine.gcode", SHORT)
    server.select_and_print("mine.gcode")
    server.wait_state("Printing", 30)
    assert bench.job_state(server)[1] == ("local", "mine.gcode")
    assert face.board.card.read("0:/gcodes/OctoPrint/mine.gcode").decode() == SHORT
    server.wait_state("Operational", 30)
    assert server.job()["progress"]["completion"] == 100


def test_files_of_the_card(server, face):
    def listed(path):
        return server.get(f"/api/files/printer/{path}").status_code == 200

    server.wait_for(lambda: listed("parts/short.gcode"), 20, "the list")
    url = "/api/files/printer/parts/short.gcode"
    moved = server.post(url, json={"command": "move", "destination": ""})
    assert moved.ok, moved.text
    assert face.board.card.read("0:/gcodes/short.gcode").decode() == SHORT
    server.wait_for(lambda: listed("short.gcode"), 20, "the moved file")
    assert server.delete("/api/files/printer/short.gcode").status_code == 204
    assert face.board.card.read("0:/gcodes/short.gcode") is None


COUNT = "set global.retries = global.retries + 1"


def test_no_command_is_sent_twice_when_its_answer_is_lost(server, face):
    server.commands("set global.retries = 0")
    helpers.wait_value(server, "global.retries", 0, 20)
    with PushListener(server, ADMIN) as push:
        face.board.inject("net_lost_command")
        server.commands(COUNT)
        push.wait_for_plugin(lambda data: data.get("code") == "unsent_doubtful", 30, "the doubt")
    server.commands(COUNT)
    helpers.wait_value(server, "global.retries", 2, 20)
    assert bench.board_value(face, "global.retries") == 2


def test_reset_ends_the_print_and_not_the_connection(server, face):
    assert bench.reset_in_a_print(server, face) == (0, 1)
    assert helpers.status(server)["is_rrf"]


def test_gap_is_survived(server, face):
    face.board.inject("net_sbc_down")
    server.wait_for(
        lambda: helpers.status(server)["blocked"] == "unreachable", 30, "the gap to be seen"
    )
    assert bench.command(server, "fan", fan=0, speed=1).status_code == 409
    face.board.clear("net_sbc_down")
    server.wait_for(lambda: helpers.status(server)["blocked"] is None, 60, "the end of the gap")
    helpers.wait_polls(server, 2)
    server.commands('M117 "again"')
    helpers.wait_value(server, "state.displayMessage", "again", 20)


def test_stop_during_a_heat_up_and_the_way_back(server, face):
    assert bench.stop_in_a_heat_up(server, face) == "off"
    bench.restart(server)
    helpers.wait_ready(server, 60)
    helpers.wait_value(server, "state.status", "idle", 30)
