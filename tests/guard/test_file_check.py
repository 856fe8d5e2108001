"""The selected file, looked through once."""

import json
import os
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")
import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side
from octoprint.events import Events

from octoprint_rrfmodel.guard import file_check
from octoprint_rrfmodel.guard.file_check import KEPT, FileCheck
from tests.support.waiting import wait_for


class Rig:
    """A check, with files and what it keeps in a folder."""

    def __init__(self, folder):
        self.folder = folder
        self.link = SimpleNamespace(is_rrf=True)
        self.told = []
        host = SimpleNamespace(
            path_on_disk=lambda path: str(folder / path), folder=lambda: str(folder)
        )
        self.check = FileCheck(host, self.link, lambda code, detail: self.told.append(code))
        self.check.start()

    def write(self, name, text, at=1_000):
        path = self.folder / name
        path.write_text(text, encoding="utf-8")
        os.utime(path, (at, at))

    def select(self, name, event=Events.FILE_SELECTED, origin="local"):
        self.check.on_event(event, {"path": name, "origin": origin})

    def wait(self, *codes):
        wait_for(
            lambda: [told["code"] for told in self.check.warnings()] == list(codes), 5, "the check"
        )


@pytest.fixture
def rig(tmp_path):
    made = Rig(tmp_path)
    yield made
    made.check.stop()


@pytest.fixture
def checks(monkeypatch):
    """List that grows with each file that is looked through."""
    found = []
    check = file_check.check
    monkeypatch.setattr(file_check, "check", lambda chunks: found.append(1) or check(chunks))
    return found


def test_once_and_kept(rig, checks, tmp_path):
    rig.write("a.gcode", "if true\n")
    rig.write("b.gcode", "G1 X1\n")
    for _ in range(2):
        rig.select("a.gcode")
        rig.wait("file_blocks")
        rig.select("b.gcode")
        rig.wait()
    assert len(checks) == 2
    rig.check.stop()
    again = Rig(tmp_path)
    again.select("a.gcode")
    again.wait("file_blocks")
    again.check.stop()
    assert len(checks) == 2


def test_changed_file_is_looked_through_again(rig, checks):
    rig.write("a.gcode", "if true\n")
    rig.select("a.gcode")
    rig.wait("file_blocks")
    rig.write("a.gcode", 'M117 "a;b"', at=2_000)
    # printed again without being selected anew
    rig.select("a.gcode", Events.PRINT_STARTED)
    rig.wait("file_semicolons")
    assert len(checks) == 2
    assert rig.told == ["file_checked"] * 2


def test_told_once_for_each_selection(rig):
    rig.write("a.gcode", "if true\n")
    rig.select("a.gcode")
    rig.wait("file_blocks")
    rig.select("a.gcode", Events.PRINT_STARTED)
    rig.check.identified()
    assert rig.told == ["file_checked"]
    rig.check.on_event(Events.FILE_DESELECTED, {})
    rig.wait()


def test_nothing_of_it_without_a_machine_that_it_concerns(rig):
    rig.link.is_rrf = False
    rig.write("a.gcode", "if true\n")
    rig.write("before.gcode", "if true\n")
    rig.select("before.gcode")
    rig.select("a.gcode")
    assert (rig.check.warnings(), rig.told) == ([], [])
    rig.link.is_rrf = True
    rig.check.identified()
    wait_for(lambda: rig.told == ["file_checked"], 5, "the notice")
    rig.wait("file_blocks")
    # the other one was never looked through
    assert list(json.loads((rig.folder / KEPT).read_text(encoding="utf-8"))) == ["a.gcode"]


def test_files_of_the_card_and_lost_ones(rig):
    rig.write("a.gcode", "if true\n")
    rig.select("a.gcode")
    rig.wait("file_blocks")
    rig.select("a.gcode", origin="sdcard")
    rig.wait()
    rig.select("a.gcode")
    rig.wait("file_blocks")
    rig.select("nowhere.gcode")
    rig.wait()
    wait_for(lambda: rig.told == ["file_checked"] * 2, 5, "the notice of each")
    assert rig.check.warnings() == []


def test_what_is_kept_is_broken(rig):
    (rig.folder / KEPT).write_text("[", encoding="utf-8")
    rig.write("a.gcode", "if true\n")
    rig.select("a.gcode")
    rig.wait("file_blocks")
    assert "a.gcode" in json.loads((rig.folder / KEPT).read_text(encoding="utf-8"))
