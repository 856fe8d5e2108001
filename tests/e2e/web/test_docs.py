"""The examples of README and docs, run as a reader would run them."""

import re
import subprocess
import sys

import pytest

from tests.support.basedir import ADMIN
from tests.support.places import ROOT

from .. import helpers

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]

CURL = re.compile(r"^ *(curl (?:.*\\\n)*.*)$", re.MULTILINE)
"""A command for the shell, with the lines that it goes on to; group 1 is the command."""

PYTHON = re.compile(r"^```python\n(.*?asyncio\.run\(.*?)^```", re.MULTILINE | re.DOTALL)
"""A whole program; group 1 is its text."""

COMMANDS = " -d "
"""What a command to the machine has, and a question doesn't."""

CURLS = [
    pytest.param(found[1], id=f"{page.stem}-{number}")
    for page in PAGES
    for number, found in enumerate(CURL.finditer(page.read_text(encoding="utf-8")))
]
# who asks the machine while it homes is refused
CURLS.sort(key=lambda row: COMMANDS in row.values[0])


@pytest.fixture(scope="module")
def server(module_server_factory, module_board_factory):
    made = module_server_factory()
    helpers.connect(made, module_board_factory())
    return made


@pytest.mark.parametrize("command", CURLS)
def test_curl(server, command):
    command = command.replace("http://127.0.0.1:5000", server.url)
    shell = (
        f"curl() {{ command curl --silent --show-error --fail --noproxy '*' \"$@\"; }}; {command}"
    )
    environment = {"KEY": ADMIN.api_key, "OCTOPRINT": server.url, "PATH": "/usr/bin:/bin"}
    done = subprocess.run(
        ["sh", "-c", shell], env=environment, capture_output=True, text=True, timeout=30
    )
    assert done.returncode == 0, done.stderr
    # a command is answered with 204 and nothing
    assert bool(done.stdout) is (COMMANDS not in command)


def test_there_are_examples():
    assert len(CURLS) >= 8


@pytest.mark.skipif(sys.version_info < (3, 10), reason="moonraker-api wants a newer Python")
@pytest.mark.both_hosts("the endpoints are there")
def test_program(server, tmp_path):
    (text,) = PYTHON.findall((ROOT / "docs" / "websocket.md").read_text(encoding="utf-8"))
    port = server.url.rsplit(":", 1)[1]
    text = text.replace(
        '"localhost", 5000, api_key="..."', f'"127.0.0.1", {port}, api_key={ADMIN.api_key!r}'
    )
    program = tmp_path / "example.py"
    program.write_text(text)
    done = subprocess.run([sys.executable, program], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    assert "toolhead" in done.stdout
    assert "position" in done.stdout
