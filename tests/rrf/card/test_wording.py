"""The table of replies, row by row, and the job that some of them depend on."""

import pytest

from octoprint_rrfmodel.rrf.card.wording import BEGINNINGS, ROWS, Situation, reword
from octoprint_rrfmodel.rrf.views.job import PRINTING, CardJob, card_job
from tests.support.places import ROOT

JOB = CardJob("paused", "0:/gcodes/a.gcode", 500, 123)
PRINTS = Situation(shows_print=True, job=JOB)
ENDED = Situation(shows_print=True, hides_print=True, job=JOB)
PAUSED = Situation(shows_pause=True, job=JOB)
CANCELS = Situation(shows_print=True, cancels=True, job=JOB)
OPENED = Situation(opened=("two_uidj.gco", 667))

POSITION = "Count 0 0 0 Machine 0.000 0.000 0.000 Bed comp 0.000"

# row → lines with the situation and what they become
CASES = {
    "mounted": [
        ("SDHC card mounted in slot 0, capacity 15.9Gb", Situation(), "SD card ok"),
        ("SD card mounted in slot 0, capacity 1.9Gb", Situation(), "SD card ok"),
        ("SDHC card mounted in slot 1, capacity 15.9Gb", Situation(), None),
    ],
    "in_use": [
        ("Error: M21: SD card has open file(s)", Situation(), "SD card ok"),
        ("Error: M22: SD card 0 has open file(s)", Situation(), "SD card ok"),
        ("Error: M21: Cannot initialise SD card 0: Card not present", Situation(), None),
    ],
    "released": [("SD card 0 may now be removed", Situation(), "SD card released")],
    "opened": [
        ("File opened", OPENED, "File opened: two_uidj.gco Size: 667"),
        ("File opened", Situation(names_file=True), None),
        ("File opened", Situation(), "// a file that is not in the list was opened"),
        ("File opened: a.gco Size: 5", OPENED, None),
    ],
    "not_printing": [
        ("Not SD printing.", PRINTS, "SD printing byte 123/500"),
        ("Not SD printing.", ENDED, None),
        ("Not SD printing.", Situation(job=JOB), None),
        ("Not SD printing.", Situation(shows_print=True), None),
    ],
    "printing": [
        ("SD printing byte 5/500", ENDED, "Not SD printing."),
        ("SD printing byte 5/500", PRINTS, None),
    ],
    "done": [
        ("Done printing file", PRINTS, "// how the print has ended comes next"),
        ("Done printing file", CANCELS, "// the print has ended, as it was to"),
        ("Done printing file", PAUSED, None),
        ("Done printing file", Situation(), None),
    ],
    "finished": [
        ("Finished printing file a.g, print time was 0h 2m", PRINTS, "Done printing file"),
        ("Finished printing file a.g, print time was 0h 2m", PAUSED, "// action:resumed"),
        ("Finished printing file a.g, print time was 0h 2m", CANCELS, None),
        ("Finished printing file a.g, print time was 0h 2m", Situation(), None),
    ],
    "cancelled": [
        ("Cancelled printing file a.g, print time was 0h 0m", PRINTS, "// action:cancel"),
        ("Cancelled printing file a.g, print time was 0h 0m", PAUSED, "// action:cancel"),
        ("Cancelled printing file a.g, print time was 0h 0m", CANCELS, None),
        ("Cancelled printing file a.g, print time was 0h 0m", Situation(), None),
    ],
    "position": [
        (
            f"X:1.000 Y:-2.000 Z:3.000 U:4.000 V:5.000 E:0.500 E0:0.5 {POSITION}",
            Situation(),
            "X:1.000 Y:-2.000 Z:3.000 E:0.500",
        ),
        (
            f"X:1.000 Y:2.000 Z:3.000 'a:4.000 E:0.000 E0:0.0 {POSITION}",
            Situation(),
            "X:1.000 Y:2.000 Z:3.000 E:0.000",
        ),
        (f"X:1.000 Y:2.000 Z:3.000 E:0.000 E0:0.0 {POSITION}", Situation(), None),
        ("X:1.000 Y:2.000 Z:3.000", Situation(), None),
    ],
}


@pytest.mark.parametrize(
    ("name", "line", "situation", "wanted"),
    [(name, *case) for name, cases in CASES.items() for case in cases],
)
@pytest.mark.parametrize("end", ["", "\n"])
def test_row(name, line, situation, wanted, end):
    assert reword(line + end, lambda: situation) == (wanted or line + end)


@pytest.mark.parametrize(
    ("name", "line", "situation"),
    [(name, *case[:2]) for name, cases in CASES.items() for case in cases],
)
def test_row_that_is_switched_off(name, line, situation):
    assert reword(line, lambda: situation, lambda row: row != name) == line


def test_every_row_has_its_cases():
    assert [row.name for row in ROWS] == list(CASES)
    for row in ROWS:
        assert row.reason.endswith((".", ")."))
        assert any(wanted for _, _, wanted in CASES[row.name])


def test_every_row_is_documented():
    text = (ROOT / "docs" / "operations.md").read_text(encoding="utf-8")
    table = text.partition("\n## Replies")[2].partition("\n## ")[0]
    rows = [line.split("|")[1].strip(" `") for line in table.splitlines() if line.startswith("| `")]
    assert rows == [row.name for row in ROWS]


def test_beginnings_are_those_of_the_lines():
    for name, cases in CASES.items():
        begins = next(row.begins for row in ROWS if row.name == name)
        assert begins in BEGINNINGS
        assert all(line.startswith(begins) for line, _, wanted in cases if wanted)


@pytest.mark.parametrize(
    "line", ["", "\n", "T:20.0 /0.0", "Warning: x", "Finished at last", "SD", "X:"]
)
def test_other_line_stays_and_costs_no_look_at_the_model(line):
    assert reword(line, lambda: pytest.fail("asked")) == line


# the job


def machine(status, **job):
    return {"state": {"status": status}, "job": job}


@pytest.mark.parametrize("status", PRINTING)
def test_job_of_a_print(status):
    file = {"fileName": "0:/gcodes/a.gcode", "size": 500}
    job = card_job(machine(status, file=file, filePosition=123))
    assert job == CardJob(status, "0:/gcodes/a.gcode", 500, 123)
    assert job.is_active
    assert job.is_paused == (status == "paused")


@pytest.mark.parametrize("status", ["idle", "busy", "off", "halted", "simulating", None, 5])
def test_no_job_of_a_file_that_is_only_selected(status):
    file = {"fileName": "0:/gcodes/a.gcode", "size": 500}
    job = card_job(machine(status, file=file, filePosition=0))
    assert job == CardJob()
    assert not job.is_active


@pytest.mark.parametrize("job", [None, [], {"file": None}, {"file": {"size": None}}])
def test_odd_job_is_harmless(job):
    found = card_job({"state": {"status": "processing"}, "job": job})
    assert found == CardJob("processing")


@pytest.mark.parametrize("model", [{}, {"state": None}, {"state": []}])
def test_model_without_state_has_no_job(model):
    assert not card_job(model).is_active
