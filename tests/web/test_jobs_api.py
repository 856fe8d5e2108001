"""What is kept of prints: each once, whatever of OctoPrint and the plugin ends in between."""

import json

import pytest

pytest.importorskip("octoprint")

from types import SimpleNamespace

from octoprint_rrfmodel.host.kept_json import KeptJson
from octoprint_rrfmodel.rrf.views.past_job import MOST, PastJob
from octoprint_rrfmodel.web.jobs_api import JobHistory
from octoprint_rrfmodel.web.streamed_layers import StreamedLayers

FILE = "0:/gcodes/a.gcode"
LOCAL = {"origin": "local", "path": "a.gcode"}


class Hall:
    """The history of jobs with a file, a clock and a model to turn."""

    def __init__(self, folder):
        self.model = {}
        self.now = 1000.0
        self.writes, self.is_due = 0, False
        self.kept = KeptJson(lambda: str(folder), "jobs.json")
        self.begin()

    def begin(self):
        """Begin anew, as after a restart."""
        self.write()
        self.now += 60
        self.jobs = JobHistory(
            lambda: self.model,
            SimpleNamespace(is_rrf=True),
            self.kept,
            later=self.note,
            now=lambda: self.now,
        )
        self.jobs.load()

    def note(self):
        self.is_due = True

    def write(self):
        """Do what the thread for the disk does."""
        if self.is_due:
            self.is_due = False
            self.writes += 1
            self.jobs.keep()

    def sees(self, status, **job):
        self.now += 1
        file = {"fileName": FILE, "size": 100}
        self.model = {"state": {"status": status}, "job": {"file": file, **job}}
        self.jobs.replied(None, 0.0)
        self.write()

    def outcomes(self):
        self.write()
        told = self.kept.read()["jobs"]
        return [(job["source"], job["outcome"]) for job in told]


@pytest.fixture
def hall(tmp_path):
    return Hall(tmp_path)


def test_a_print_of_octoprints(hall):
    hall.jobs.on_event("PrintStarted", LOCAL)
    hall.jobs.on_event("PrintFailed", {**LOCAL, "reason": "cancelled"})
    hall.jobs.on_event("PrintCancelled", {**LOCAL, "time": 12})
    # what OctoPrint shows of the board's own print is the board's to tell
    hall.jobs.on_event("PrintStarted", {"origin": "sdcard", "path": "b.gcode"})
    hall.jobs.on_event("PrintDone", {"origin": "sdcard", "path": "b.gcode", "time": 3})
    assert hall.outcomes() == [("octoprint", "cancelled")]
    assert hall.kept.read()["open"] == []


def test_octoprints_end_is_that_of_its_print(hall):
    hall.jobs.on_event("PrintStarted", LOCAL)
    hall.begin()
    hall.jobs.on_event("PrintStarted", LOCAL)
    hall.jobs.on_event("PrintDone", {**LOCAL, "time": 3})
    assert hall.outcomes() == [("octoprint", "aborted"), ("octoprint", "finished")]


def test_the_boards_print_outlasts_octoprint(hall):
    hall.sees("idle")
    hall.sees("processing", duration=1)
    hall.begin()
    hall.now += 100
    hall.sees("processing", duration=102)
    hall.jobs.line(f"Finished printing file {FILE}, print time was 0h 2m")
    hall.sees("idle", duration=None)
    assert hall.outcomes() == [("card", "finished")]


def test_the_disk_is_left_alone_while_a_print_goes_on(hall):
    for duration in range(1, 60):
        hall.sees("processing", duration=duration, filePosition=duration)
    assert hall.writes <= 2


@pytest.mark.parametrize("text", ["", "[]", "{", '{"jobs": 5, "open": [{}]}', "\x00\xff"])
def test_a_broken_file_is_begun_anew(hall, tmp_path, text):
    (tmp_path / "jobs.json").write_text(text, encoding="utf-8")
    hall.begin()
    hall.jobs.on_event("PrintStarted", LOCAL)
    hall.jobs.on_event("PrintDone", LOCAL)
    assert hall.outcomes() == [("octoprint", "finished")]


def test_the_file_is_bounded(hall, tmp_path):
    for number in range(MOST + 20):
        hall.now += 1
        hall.jobs.on_event("PrintStarted", {**LOCAL, "path": f"{number}.gcode"})
        hall.jobs.on_event("PrintDone", LOCAL)
        hall.write()
    told = json.loads((tmp_path / "jobs.json").read_text(encoding="utf-8"))
    assert len(told["jobs"]) == MOST
    assert told["jobs"][-1]["path"] == f"{MOST + 19}.gcode"
    assert not list(tmp_path.glob("*.new"))


def test_a_disk_that_is_full_is_no_reason_to_stop(hall, tmp_path, caplog):
    hall.kept = KeptJson(lambda: str(tmp_path / "gone"), "jobs.json")
    hall.begin()
    hall.jobs.on_event("PrintStarted", LOCAL)
    hall.jobs.on_event("PrintDone", LOCAL)
    hall.write()
    assert "Could not keep" in caplog.text


def sent_layers(tmp_path, *ticks):
    """Return the layers of a print that was seen at these places and seconds, and where it is."""
    (tmp_path / "a.gcode").write_text(";LAYER_CHANGE\n;Z:0.2\nG1\n" * 3, encoding="utf-8")
    job = SimpleNamespace(name="a.gcode", position=0, print_time=None)
    link = SimpleNamespace(is_rrf=True)
    found = StreamedLayers(
        lambda path: str(tmp_path / path), lambda: job, link, later=lambda path: found.scan(path)
    )
    found.on_event("PrintStarted", LOCAL)
    for job.position, job.print_time in ticks:
        found.tick()
    return found


def test_layers_of_a_print_that_is_sent(tmp_path):
    found = sent_layers(tmp_path, (0, 0), (1, 1), (26, 11), (30, 12), (50, 31))
    assert found.told() == {"layer": 3, "layers": 3, "height": 0.2}
    assert [(each.layer, each.seconds) for each in found.since(0)] == [(1, 11.0), (2, 20.0)]
    found.on_event("PrintDone", LOCAL)
    assert found.told() is None
    assert len(found.since(0)) == 2


def test_no_file_is_read_that_another_firmware_is_sent():
    scanned = []
    link = SimpleNamespace(is_rrf=False)
    found = StreamedLayers(str, lambda: None, link, later=scanned.append)
    found.on_event("PrintStarted", LOCAL)
    assert (scanned, found.told()) == ([], None)


def test_a_file_without_layers_tells_none(tmp_path):
    found = sent_layers(tmp_path)
    (tmp_path / "b.gcode").write_text("G1\n", encoding="utf-8")
    found.on_event("PrintStarted", {**LOCAL, "path": "b.gcode"})
    found.tick()
    assert (found.told(), found.since(0)) == (None, [])
    found.on_event("PrintStarted", {**LOCAL, "path": "gone.gcode"})
    assert found.told() is None


def test_what_is_kept_has_a_name():
    assert PastJob("card", FILE, 1.0).name == "a.gcode"


def test_news_of_prints(hall):
    told = []
    hall.jobs.attach(lambda action, job, is_over: told.append((action, job.path, is_over)))
    hall.jobs.on_event("PrintStarted", LOCAL)
    hall.write()
    assert told == [("added", "a.gcode", False)]
    hall.now += 10
    hall.jobs.on_event("PrintDone", {**LOCAL, "time": 10})
    hall.write()
    assert told[1:] == [("finished", "a.gcode", True)]
    hall.write()
    assert len(told) == 2


def test_prints_are_forgotten(hall):
    for name in ("a.gcode", "b.gcode"):
        hall.now += 10
        hall.jobs.on_event("PrintStarted", {**LOCAL, "path": name})
        hall.jobs.on_event("PrintDone", {"time": 1})
    hall.jobs.on_event("PrintStarted", {**LOCAL, "path": "c.gcode"})
    names = [(job.path, is_over) for job, is_over in hall.jobs.all()]
    assert names == [("c.gcode", False), ("b.gcode", True), ("a.gcode", True)]
    gone = hall.jobs.forget(lambda job: job.path != "b.gcode")
    assert [job.path for job in gone] == ["a.gcode"]
    assert hall.jobs.forget(lambda job: job.path == "a.gcode") == []
    hall.begin()
    assert [job.path for job, _ in hall.jobs.all()] == ["c.gcode", "b.gcode"]
