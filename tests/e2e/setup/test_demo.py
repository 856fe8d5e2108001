"""``make demo`` starts an OctoPrint that is connected to the simulated board, in either way."""

import os
import re
import subprocess
import sys

import pytest
import requests

from extras import demo
from tests.support import guard, ports
from tests.support.places import ROOT
from tests.support.server import START_SECONDS
from tests.support.waiting import wait_for

pytestmark = pytest.mark.both_hosts("one of them has connectors")


@pytest.mark.parametrize(
    ("name", "value", "told"),
    [
        ("DEMO_LINK", "wifi", "DEMO_LINK is serial or network, not 'wifi'"),
        ("DEMO_MACHINE", "toaster", "toaster"),
        ("DEMO_FIRMWARE", "9.9", "9.9"),
    ],
)
def test_what_cannot_be_is_said(monkeypatch, capsys, name, value, told):
    monkeypatch.setenv(name, value)
    assert demo.main() == demo.BAD_USAGE
    assert told in capsys.readouterr().err


def test_network_needs_the_newer_host(monkeypatch, capsys, octoprint_version):
    if not octoprint_version.startswith("1."):
        pytest.skip("this is the newer host")
    monkeypatch.setenv("DEMO_LINK", "network")
    assert demo.main() == demo.BAD_USAGE
    assert "OctoPrint 2.0" in capsys.readouterr().err


def test_demo_is_connected(tmp_path, octoprint_version):
    """By cable in 1.11, on the network in 2.0: each start takes its time."""
    link = "serial" if octoprint_version.startswith("1.") else "network"
    port = ports.free_port()
    told = {"DEMO_LINK": link, "DEMO_PORT": str(port), "DEMO_FOLDER": str(tmp_path)}
    with (tmp_path / "told.txt").open("wb") as output:
        process = subprocess.Popen(
            [sys.executable, guard.__file__, sys.executable, "-m", "extras.demo"],
            stdin=subprocess.PIPE,
            stdout=output,
            stderr=subprocess.STDOUT,
            cwd=ROOT,
            env={**os.environ, **told},
            start_new_session=True,
        )
    try:
        text = wait_for(
            lambda: has_ended(process) or all_of(tmp_path / "told.txt"), START_SECONDS, "the demo"
        )
        key = re.search(r"API key (\w+)", text)[1]
        status = f"http://127.0.0.1:{port}/plugin/rrfmodel/status"

        def found():
            answer = requests.get(status, headers={"X-Api-Key": key}, timeout=30)
            return answer.json() if answer.ok and answer.json()["ready"] else None

        assert wait_for(found, 60, "the board")["link"] == link
    finally:
        process.stdin.close()
        process.wait()


def has_ended(process):
    assert process.poll() is None, process.returncode
    return False


def all_of(path):
    text = path.read_text()
    return text if "stop it with" in text else None
