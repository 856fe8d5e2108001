"""``python -m octoprint_rrfmodel.simulator``."""

from __future__ import annotations

import json
import os
import pathlib
import signal
import subprocess
import sys

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
