"""The tables of docs/features.md: the counts at their head, and that each test named is there."""

import re

import pytest

from tests.e2e.page.test_jobs_counted import JOBS
from tests.support.docs import DOCS
from tests.support.places import ROOT

TEXT = (DOCS / "features.md").read_text(encoding="utf-8")

STATES = ("works", "partly", "missing", "host's own")

CAPABILITIES = 84

NAMED = re.compile(r"`(?P<file>[a-z0-9_/]+)::(?P<name>test_\w+)`")


def cells(line):
    return [cell.strip() for cell in line.strip("| ").split(" | ")]


ROWS = [cells(line) for line in TEXT.splitlines() if re.match(r"\| \d+ \| ", line)]


def test_rows_are_numbered_and_each_has_a_state():
    assert [int(row[0]) for row in ROWS] == list(range(1, CAPABILITIES + 1))
    assert {len(row) for row in ROWS} == {5}
    assert {row[2] for row in ROWS} <= set(STATES)


def test_counts_at_the_head():
    told = ", ".join(f"{state} {sum(row[2] == state for row in ROWS)}" for state in STATES)
    assert f"Of {CAPABILITIES}: {told}." in TEXT


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row[0])
def test_tests_that_the_table_names_are_there(row):
    named = list(NAMED.finditer(row[4]))
    for found in named:
        source = (ROOT / "tests" / f"{found['file']}.py").read_text(encoding="utf-8")
        assert f"def {found['name']}(" in source, found[0]
    # what is missing has a reason instead
    assert named or row[2] in ("missing", "host's own")
    assert row[3] != "–" or named


def test_jobs_are_those_that_are_counted():
    table = TEXT.partition("| job | here | DWC | |")[2]
    told = [cells(line)[:3] for line in table.splitlines() if re.match(r"\| [a-z]", line)]
    assert sorted(told) == sorted([job.name, str(job.steps), str(job.dwc)] for job in JOBS)
