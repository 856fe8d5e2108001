"""``python -m octoprint_rrfmodel.simulator``."""

from __future__ import annotations

import json
import os
import pathlib
import signal
import socket
import subprocess
import sys
import urllib.request

import pytest

from octoprint_rrfmodel.simulator.__main__ import listing, main
from octoprint_rrfmodel.simulator.faults import FAULTS
from octoprint_rrfmodel.simulator.firmware import VERSIONS
from octoprint_rrfmodel.simulator.machines import MACHINES

ROOT = pathlib.Path(__file__).resolve().parents[2]
COMMAND = [sys.executable, "-m", "octoprint_rrfmodel.simulator"]


@pytest.fixture
def link(tmp_path):
    return str(tmp_path / "rrf")


def test_list(capsys):
    assert main(["--list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    words = [line.split()[0] for line in lines if line.startswith("  ")]
    assert words == [*MACHINES, *VERSIONS, *FAULTS]
    assert all(len(line.split()) > 1 for line in lines if line.startswith("  "))
    assert listing() == "\n".join(lines)


MISTAKES = {
    "machine": (["--machine", "x"], "unknown machine 'x', known are cartesian"),
    "firmware": (["--firmware", "9"], "unknown firmware '9', known are 2.05"),
    "fault": (["--fault", "x"], "unknown fault 'x', known are lost_ok"),
    "argument of a fault": (["--fault", "slow:x"], "fault 'slow' takes a number, not 'x'"),
    "speed": (["--speed", "0"], "--speed takes a number above 0"),
    "not a number": (["--speed", "nan"], "--speed takes a number above 0"),
    "model file": (["--model", "/nowhere/x.json"], "cannot read /nowhere/x.json"),
}


@pytest.mark.parametrize(("arguments", "text"), MISTAKES.values(), ids=MISTAKES)
def test_mistakes_are_one_sentence_and_exit_2(capsys, link, arguments, text):
    assert main(["--link", link, *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"error: {text}")
    assert err.count("\n") == 1
    assert not os.path.lexists(link)


def test_without_a_link(capsys):
    assert main([]) == 2
    assert "--link" in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [["--sbc"], ["--password", "x"]], ids=" ".join)
def test_what_is_for_the_network_alone(capsys, link, arguments):
    assert main(["--link", link, *arguments]) == 2
    assert capsys.readouterr().err == "error: --sbc and --password are for --http\n"


@pytest.mark.parametrize("address", ["x", "1:x", "65536", "::", "-1", ""])
def test_an_address_that_is_none(capsys, address):
    assert main([f"--http={address}"]) == 2
    assert capsys.readouterr().err.startswith("error: --http takes [HOST:]PORT, not ")


def test_a_port_that_is_taken(capsys):
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        assert main(["--http", str(other.getsockname()[1])]) == 2
    assert capsys.readouterr().err.startswith("error: cannot serve at 127.0.0.1:")


def test_machine_and_model_exclude_each_other(capsys):
    with pytest.raises(SystemExit) as ended:
        main(["--link", "x", "--machine", "delta", "--model", "x"])
    assert ended.value.code == 2


def test_a_link_that_cannot_be(capsys, tmp_path):
    assert main(["--link", str(tmp_path / "no" / "folder")]) == 2
    assert capsys.readouterr().err.startswith("error: cannot open a terminal at ")


@pytest.fixture
def run(link):
    """Starts the command; ended, if it hasn't, with the test."""
    started = []

    def start(*arguments):
        process = subprocess.Popen(
            [*COMMAND, "--link", link, *arguments],
            cwd=ROOT,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        assert process.stdout.readline() == f"ready {link}\n"
        return process

    yield start
    for process in started:
        if process.poll() is None:
            process.kill()
        process.communicate()


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_it_cleanly(run, link, number):
    process = run()
    assert os.path.lexists(link)
    process.send_signal(number)
    out, err = process.communicate(timeout=10)
    assert (process.returncode, out, err) == (0, "", "")
    assert not os.path.lexists(link)


def answer(url):
    with urllib.request.urlopen(url, timeout=10) as reply:
        return json.load(reply)


@pytest.fixture
def served():
    """Starts the command on the network; returns it with the lines that it has said."""
    started = []

    def start(*arguments, lines=1):
        process = subprocess.Popen(
            [*COMMAND, "--http", "0", *arguments],
            cwd=ROOT,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        return [process.stdout.readline().split()[1] for _ in range(lines)]

    yield start
    for process in started:
        process.send_signal(signal.SIGTERM)
        assert process.communicate(timeout=10) == ("", "")
        assert process.returncode == 0


def test_http_and_a_terminal_lead_to_the_same_board(served, link):
    where, url = served("--link", link, "--password", "secret", lines=2)
    assert where == link
    assert answer(f"{url}/rr_connect?password=")["err"] == 1
    assert answer(f"{url}/rr_connect?password=secret")["boardType"] == "duet5lcwifi"
    ask(link, "G10 P0 X3.5")
    assert answer(f"{url}/rr_model?key=tools[0].offsets[0]&flags=v")["result"] == 3.5


def test_behind_a_computer(served):
    (url,) = served("--sbc", "--firmware", "3.4")
    assert url.startswith("http://127.0.0.1:")
    assert answer(f"{url}/machine/status")["state"]["dsfVersion"] == "3.4.6"


def ask(link, line):
    serial = pytest.importorskip("serial")
    with serial.Serial(link, 115200, timeout=5) as port:
        port.write(line.encode() + b"\n")
        return port.readline().decode()


def test_machine_firmware_and_fault(run, link):
    run("--machine", "delta", "--firmware", "3.4", "--fault", "glued_before", "--speed", "10")
    said = ask(link, "M115")
    assert said.startswith("Warning: VIN under-voltage event (11.0V)FIRMWARE_NAME: RepRapFirmware")
    assert "Duet 2 WiFi/Ethernet FIRMWARE_VERSION: 3.4.6" in said


def test_model(run, link, tmp_path):
    model = {
        "state": {"status": "idle"},
        "boards": [{"firmwareVersion": "3.4.5", "firmwareName": "RepRapFirmware for X"}],
    }
    path = tmp_path / "model.json"
    path.write_text(json.dumps({"key": "", "result": model}, indent=1))
    run("--model", str(path))
    assert "RepRapFirmware for X FIRMWARE_VERSION: 3.4.5" in ask(link, "M115")
