"""A board on a cable that hangs on the network, too: an emergency stop goes both ways,
and its files are read there."""

import pytest

from octoprint_rrfmodel.simulator.network.http_board import HttpBoard
from tests.support.basedir import ADMIN
from tests.support.push import PushListener

from .. import helpers
from . import bench

pytestmark = pytest.mark.both_hosts("the stop is OctoPrint's, and so is the end of the connection")

HERE = "127.0.0.1"

STOP_SECONDS = 5.0

FILES = "/plugin/rrfmodel/machine_files"

PORT = "plugins.rrfmodel.network.beside_port"


def test_stop_over_the_cable_passes_a_heat_up(server, board_factory):
    """One board with both faces; without the setting nobody has heard of it on the network."""
    board = board_factory(machine="cartesian", firmware="3.5.3", speed=1)
    board.board.model["network"]["interfaces"][0]["actualIP"] = HERE
    with HttpBoard(board.board) as face, PushListener(server, ADMIN) as push:
        helpers.connect(server, board)
        assert helpers.status(server)["beside"] is None
        assert len(face.sessions) == 0
        server.set_setting(PORT, face.port)
        server.wait_for(lambda: helpers.status(server)["beside"], 30, "the board to be found")
        server.commands("T0", "M109 S200")
        server.wait_for(
            lambda: helpers.status(server)["blocked"] == "heating", 20, "the line to be held up"
        )
        assert bench.command(server, "emergency_stop").status_code == 204
        server.wait_for(lambda: board.board.is_halted, STOP_SECONDS, "the board to stand")
        push.wait_for_plugin(
            lambda told: told.get("code") == "stopped_beside", 20, "somebody to be told"
        )
        assert bench.board_value(face, "heat.heaters.1.state") == "off"
        server.set_setting(PORT, 0)


def test_the_machines_files_and_its_height_map(server, board_factory):
    board = board_factory(machine="cartesian", firmware="3.5.3", speed=100)
    board.board.model["network"]["interfaces"][0]["actualIP"] = HERE
    with HttpBoard(board.board) as face:
        helpers.connect(server, board)
        assert server.get(f"{FILES}?path=0:/sys").status_code == 409
        server.set_setting(PORT, face.port)
        server.wait_for(lambda: helpers.status(server)["beside"], 30, "the board to be found")
        listed = server.get(f"{FILES}?path=0:/sys").json()["entries"]
        assert "config.g" in {each["name"] for each in listed}
        board.board.execute("G28", channel="http")
        board.board.execute("G29", channel="http")
        helpers.wait_value(server, "move.compensation.type", "mesh", 30)
        mesh = server.get("/plugin/rrfmodel/heightmap")
        assert mesh.status_code == 200, mesh.text
        objects = server.get("/plugin/rrfmodel/printer/objects/query?bed_mesh").json()
        assert objects["result"]["status"]["bed_mesh"]["mesh_matrix"]
        server.set_setting(PORT, 0)
