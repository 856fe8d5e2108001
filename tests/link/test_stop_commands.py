"""M0 and M1 of a file that OctoPrint streams, on a file and a connection that only remembers."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.tags import FILE_TAG
from octoprint_rrfmodel.link.serial.file_lines import FileLines
from octoprint_rrfmodel.link.serial.stop_commands import MOST_BEHIND, StopCommands
from octoprint_rrfmodel.rrf.views.machine import Machine

MODEL = {"boards": [{"firmwareVersion": "3.4.6"}]}


@pytest.fixture
def instead(tmp_path):
    """Function that returns what goes out for a stop of a file with that behind it."""
    path = tmp_path / "a.gcode"

    def ask(cmd, behind, before="G1 X1\n", is_others=False, is_on=True, shift=0):
        place = len(f"{before}{cmd}\n".encode())
        path.write_bytes(f"{before}{cmd}\n{behind}".encode())
        comm = SimpleNamespace(_currentFile=SimpleNamespace(getFilename=lambda: str(path)))
        link = SimpleNamespace(connection=comm, carried=lambda lines, machine: lines)
        commands = StopCommands(
            link,
            FileLines(link),
            lambda: Machine(MODEL),
            is_others=lambda comm: is_others,
            is_on=lambda row: is_on,
        )
        outcome = commands.instead(cmd, cmd.split()[0], {FILE_TAG, f"filepos:{place + shift}"})
        return None if outcome is None else list(outcome.lines)

    return ask


def test_last_one_reaches_the_board(instead):
    assert instead("M0", "") == ["M400 M0"]
    assert instead("M0 H1", "; settings\n\n") == ["M400 M0 H1"]
    assert instead("M1", "", before="; ° and ø\n" * 500) == ["M400 M1"]


def test_one_in_the_middle_is_left_to_octoprint(instead):
    assert instead("M0", "G1 X5\n") is None
    assert instead("M0", "; settings\n" * (MOST_BEHIND // 11 + 10)) is None


def test_switched_off(instead):
    assert instead("M0", "", is_on=False) is None


def test_place_behind_the_end_of_the_file(instead):
    assert instead("M0", "; more\n", shift=1000) == ["M400 M0"]
    assert instead("M0", "G1 X5\n", shift=1000) is None


def test_job_of_the_machine_is_not_ended(instead):
    assert instead("M0", "", is_others=True) == []


def test_file_that_is_gone_is_no_end():
    comm = SimpleNamespace(_currentFile=SimpleNamespace(getFilename=lambda: "/nowhere/a.gcode"))
    link = SimpleNamespace(connection=comm)
    commands = StopCommands(
        link, FileLines(link), dict, is_others=lambda comm: False, is_on=lambda row: True
    )
    assert commands.instead("M0", "M0", {FILE_TAG, "filepos:5"}) is None
    assert commands.instead("M0", "M0", {FILE_TAG}) is None
