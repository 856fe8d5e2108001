"""The promises of the bench that a passing test doesn't show: nothing is left behind."""

import socket
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support import guard
from tests.support.waiting import wait_for

SLEEPER = [sys.executable, "-c", "import os, time; print(os.getpid(), flush=True); time.sleep(600)"]
GUARDED = [sys.executable, guard.__file__, *SLEEPER]


def is_running(pid):
    try:
        stat = Path(f"/proc/{pid}/stat").read_text()
    except (FileNotFoundError, ProcessLookupError):
        # the second where it ends between opening and reading
        return False
    # an orphan that ended stays as a zombie where nobody reaps it
    return stat.rpartition(")")[2].split()[0] != "Z"


def test_guard_ends_the_command_when_its_input_closes():
    with subprocess.Popen(
        GUARDED, stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True
    ) as process:
        pid = int(process.stdout.readline())
        process.stdin.close()
        process.wait(30)
        assert not is_running(pid)


def test_guard_ends_the_command_when_its_parent_is_killed():
    parent = (
        "import subprocess, sys, time\n"
        f"subprocess.Popen({GUARDED!r}, stdin=subprocess.PIPE, start_new_session=True)\n"
        "time.sleep(600)"
    )
    with subprocess.Popen([sys.executable, "-c", parent], stdout=subprocess.PIPE) as process:
        pid = int(process.stdout.readline())
        process.kill()
        assert wait_for(lambda: not is_running(pid), 30, "the command's end")


def test_guard_hands_on_the_exit_status():
    command = [sys.executable, guard.__file__, sys.executable, "-c", "raise SystemExit(3)"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, start_new_session=True) as process:
        assert process.wait(30) == 3


def test_server_that_cannot_start_fails_at_once(server_factory):
    from tests.support.server import ServerDied

    with socket.socket() as occupied:
        occupied.bind(("127.0.0.1", 0))
        occupied.listen()
        with pytest.raises(ServerDied, match="exit status"):
            server_factory(port=occupied.getsockname()[1])


def test_servers_are_independent(server_factory):
    first, second = server_factory(), server_factory()
    first.set_setting("appearance.name", "first")
    names = [server.get("/api/settings").json()["appearance"]["name"] for server in (first, second)]
    assert names == ["first", ""]
