"""What OctoPrint says of the plugin's ways with it, and what is left where it isn't loaded."""

import re
from pathlib import Path

import pytest
import yaml

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard
from tests.support.basedir import ADMIN, is_version_2
from tests.support.push import PushListener

from .. import helpers
from ..network import bench

pytestmark = [
    pytest.mark.both_hosts("each has its own deprecations, and its own way to leave plugins out"),
    pytest.mark.slow,
]

DEPRECATED = re.compile(r"/(octoprint_rrfmodel/\S+|old_fashioned)\.py:\d+: \w*DeprecationWarning")
"""In OctoPrint's log: what uses something that is going to be dropped."""

OLD_FASHIONED = Path(__file__).parents[2] / "support" / "plugins" / "old_fashioned.py"

FILE = "G28\nG1 X10 F6000\nM106 S128\nG1 X20\nM107\n"


@pytest.fixture(scope="module")
def server(module_server_factory):
    """A server that logs the use of what is deprecated, which Python keeps silent about."""
    return module_server_factory(
        environment={"PYTHONWARNINGS": "default::DeprecationWarning"},
        plugin_files=(OLD_FASHIONED,),
    )


def page(server):
    """Return OctoPrint's page as the admin sees it."""
    with server.session(ADMIN) as client:
        response = client.get("/")
    assert response.status_code == 200
    return response.text


def use(server, storage):
    """Have the plugin do what it does for whoever prints a file from there."""
    for path in ("status", "model", "history", "jobs", "metrics", "openapi.json"):
        response = server.get(f"/plugin/rrfmodel/{path}")
        assert response.status_code == 200, path
    if storage == "local":
        server.upload("short.gcode", FILE)
    place = f"/api/files/{storage}/short.gcode"
    server.wait_for(lambda: server.get(place).status_code == 200, 30, "the file")
    with PushListener(server, ADMIN) as push:
        response = server.post(place, json={"command": "select", "print": True})
        assert response.ok, response.text
        push.wait_for_event("PrintDone", 60)
    server.wait_state("Operational")


def test_nothing_deprecated_is_used(server, board_factory):
    helpers.connect(server, board_factory(machine="toolchanger"))
    for command in ("fix_settings", "fix_profile"):
        response = server.post("/api/plugin/rrfmodel", json={"command": command})
        assert response.status_code == 204, response.text
    use(server, "local")
    assert "rrfmodel" in page(server)
    if is_version_2(server.version):
        with HttpBoard(Board(machine="cartesian", speed=10)) as face:
            face.board.card.write("0:/gcodes/short.gcode", FILE)
            bench.connect(server, face)
            use(server, "printer")
            helpers.disconnect(server)
    helpers.disconnect(server)
    assert DEPRECATED.findall(server.log()) == [OLD_FASHIONED.stem]


def test_safe_mode_has_nothing_of_the_plugin(server, board_factory):
    """What it changed of OctoPrint's own stays as people saw it, for they may want it so."""
    before = server.get("/api/printerprofiles/_default").json()
    server.stop()
    path = server.basedir / "config.yaml"
    config = yaml.safe_load(path.read_text("utf-8"))
    config["server"]["startOnceInSafeMode"] = True
    if is_version_2(server.version):
        # whoever had the board on the network
        address = {"connector": "rrfmodel", "parameters": {"host": "127.0.0.1"}}
        config["printerConnection"] = {"autoconnect": True, "preferred": address}
    path.write_text(yaml.safe_dump(config), "utf-8")
    server.forget_logs()
    server.start()

    assert server.get("/api/server").json()["safemode"]
    assert server.get("/plugin/rrfmodel/status").status_code == 404
    assert "rrfmodel" not in server.get("/api/settings").json()["plugins"]
    assert "rrfmodel" not in server.get("/api/access/permissions").text.lower()
    assert "plugin/rrfmodel" not in page(server)
    assert server.get("/api/printerprofiles/_default").json() == before
    board = board_factory(machine="toolchanger")
    server.connect(board.link)
    server.wait_state("Operational")
    server.disconnect()
    wrong = [line for line in server.log().splitlines() if " - ERROR - " in line]
    assert wrong == []
    assert not yaml.safe_load(path.read_text("utf-8"))["server"].get("startOnceInSafeMode")
