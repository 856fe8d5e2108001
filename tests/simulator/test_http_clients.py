"""Programs that other people wrote for boards, unchanged, with the simulated one.

``make environments`` installs them; where one can't be had its test says so.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.network.http_board import HttpBoard
from octoprint_rrfmodel.simulator.network.sbc_board import SbcBoard

ROOT = Path(__file__).resolve().parents[2]
INSTALLED = Path(os.environ.get("NETWORK_CLIENTS") or ROOT / ".venv" / "network-clients")
PYTHON = INSTALLED / "bin" / "python"
MODULES = INSTALLED / "node_modules"
SCRIPTS = ROOT / "tests" / "clients"
PASSWORD = "secret"
TEXT = "G28\nG1 X1\n"
FACES = {"alone": HttpBoard, "behind a computer": SbcBoard}


@pytest.fixture(params=FACES)
def face(request):
    with FACES[request.param](Board("cartesian", "3.5.3")) as served:
        yield served


def ran(*command, **environment):
    done = subprocess.run(
        [str(part) for part in command],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def has(module):
    command = [str(PYTHON), "-c", f"import {module}"]
    return subprocess.run(command, capture_output=True, timeout=60, check=False).returncode == 0


def python(script, *arguments):
    """Return what a script prints that needs a program for Python."""
    module = script.partition("_client")[0].replace("simplyprint", "simplyprint_duet3d")
    if not PYTHON.exists() or not has(module):
        pytest.skip(f"{module} can't be had; `make environments` installs it")
    return json.loads(ran(PYTHON, SCRIPTS / script, *arguments))


def test_the_vendors_client(face):
    node = shutil.which("node")
    if node is None or not (MODULES / "@duet3d").is_dir():
        pytest.skip("@duet3d/connectors can't be had; it needs Node, and `make environments`")
    face.board.network_access.password = PASSWORD
    script = SCRIPTS / "connectors.js"
    found = json.loads(ran(node, script, face.url, PASSWORD, NODE_PATH=str(MODULES)))
    kinds = {HttpBoard: "PollConnector", SbcBoard: "RestConnector"}
    assert found["kind"] == kinds[type(face)]
    assert found["reply"].startswith("FIRMWARE_NAME: RepRapFirmware for Duet 3 Mini 5+")
    assert found["text"] == TEXT
    assert "sent.g" in found["files"]
    assert (found["layers"], found["pictures"]) == (40, [124])
    assert found["moved"] == ["moved.g"]
    assert (found["left"], found["failure"]) == ([], None)


def test_simplyprint(face):
    face.board.network_access.password = PASSWORD
    found = python("simplyprint_client.py", face.url, PASSWORD)
    assert found["status"] == "idle"
    assert found["reply"].startswith("FIRMWARE_NAME: RepRapFirmware")
    assert (found["size"], found["text"]) == (10, TEXT)
    assert face.board.card.read("0:/gcodes/sent.g") is None


# from 3.5 on it takes what DSF emulates for a board, and trips over the list of files
OLD_CLIENT = {"alone": "3.5.3", "behind a computer": "3.4"}


@pytest.mark.parametrize(("kind", "firmware"), OLD_CLIENT.items(), ids=OLD_CLIENT)
def test_duetwebapi(kind, firmware):
    with FACES[kind](Board("cartesian", firmware)) as face:
        found = python("duetwebapi_client.py", face.url)
    assert found["status"] == "idle"
    assert found["reply"].startswith("FIRMWARE_NAME: RepRapFirmware")
    assert "sent.g" in found["files"] and "sent.g" not in found["left"]
    assert found["size"] == 10


def test_rrgit(tmp_path):
    """It copies the whole card, and brings back what has been changed."""
    program = INSTALLED / "bin" / "rrgit"
    if not program.exists():
        pytest.skip("rrgit can't be had; `make environments` installs it")
    copy = tmp_path / "card"
    with HttpBoard(Board("cartesian", "3.5.3")) as face:
        ran(program, "clone", face.url, copy)
        config = copy / "sys" / "config.g"
        assert config.read_text(encoding="utf-8") == "; configuration\n"
        config.write_text("; changed\n", encoding="utf-8")
        subprocess.run(
            [str(program), "push"],
            cwd=copy,
            timeout=120,
            check=True,
            input="y\n" * 20,
            text=True,
            capture_output=True,
        )
        assert face.board.card.read("0:/sys/config.g") == b"; changed\n"


def test_the_clients_are_those_that_are_named():
    """What is tried is what the files of versions say."""
    names = (ROOT / "requirements" / "network-clients.txt").read_text(encoding="utf-8")
    wanted = ("duetwebapi", "klipper-tui", "rrgit", "simplyprint-duet3d")
    assert all(f"{name}==" in names for name in wanted)
    package = json.loads((SCRIPTS / "package.json").read_text(encoding="utf-8"))
    assert set(package["dependencies"]) == {"@duet3d/connectors", "jsdom"}
