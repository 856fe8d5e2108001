"""The table of docs/firmware.md: each test that it names is there, and is of that firmware."""

import os
import re
import subprocess
import sys
from importlib.metadata import version

import pytest

from octoprint_rrfmodel.simulator.firmware import VERSIONS
from tests.support.docs import DOCS
from tests.support.places import ROOT

# to collect them takes a while, so that one worker does it
pytestmark = pytest.mark.xdist_group("firmware_docs")

COLUMNS = {
    "2.05": r"(?<![\d.])2\.05(?!\d)|408|before_3_",
    **{name: rf"(?<![\d.]){re.escape(name)}(?!\d)" for name in ("3.3", "3.4", "3.5", "3.6", "3.7")},
}
"""Firmware of each column, and what in the id of a test tells of it."""

DEFAULT = "3.5"
"""The firmware of a board for which a test names none."""

NAMED = re.compile(r"`(?P<file>[a-z0-9_/]+)::(?P<name>test_\w+)(?:\[(?P<row>\w+)\])?`")
"""A test as the table names it; ``row`` is a part of the parameters that are meant."""


def rows():
    """Return the cells of each row of the table that names tests, by its first cell."""
    text = (DOCS / "firmware.md").read_text(encoding="utf-8")
    cells = [
        [cell.strip() for cell in line.strip("| ").split(" | ")]
        for line in text.splitlines()
        if line.startswith("| ") and NAMED.search(line)
    ]
    return {row[0]: row[1:] for row in cells}


ROWS = rows()


@pytest.fixture(scope="module")
def collected():
    """Ids of the tests in the files that the table names, as pytest has them."""
    if version("OctoPrint").startswith("1."):
        pytest.skip("tests that are the same in both hosts are collected in 2.0 alone")
    files = sorted({f"tests/{found['file']}.py" for row in ROWS.values() for found in named(row)})
    options = ["--collect-only", "-q", "-n", "0", "-p", "no:cacheprovider"]
    # whatever worker runs this: another one is none
    environment = {
        name: value for name, value in os.environ.items() if not name.startswith("PYTEST_")
    }
    done = subprocess.run(
        [sys.executable, "-m", "pytest", *options, *files],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    return [line for line in done.stdout.splitlines() if "::" in line]


def named(row):
    return list(NAMED.finditer(row[-1]))


def ids_of(found, collected):
    """Return the ids of a test of the table, those of the row that is meant."""
    begins = f"tests/{found['file']}.py::{found['name']}"
    ids = [each for each in collected if each == begins or each.startswith(f"{begins}[")]
    return [each for each in ids if (found["row"] or "") in each.partition("[")[2]]


def firmware_of(found, collected):
    """Return the columns that a test of the table is about."""
    ids = ids_of(found, collected)
    columns = {
        column for column, tells in COLUMNS.items() if any(re.search(tells, each) for each in ids)
    }
    return columns or {DEFAULT}


def test_columns_are_the_firmware_of_the_simulated_board():
    heading = next(
        line
        for line in (DOCS / "firmware.md").read_text(encoding="utf-8").splitlines()
        if line.startswith("| | 2.05 ")
    )
    assert [cell.strip() for cell in heading.strip("| ").split(" | ")][:-1] == list(COLUMNS)
    assert {".".join(name.split(".")[:2]) for name in VERSIONS} == set(COLUMNS)
    assert all(len(row) == len(COLUMNS) + 1 for row in ROWS.values())


@pytest.mark.parametrize("row", ROWS)
def test_tests_that_the_table_names_are_there(row, collected):
    for found in named(ROWS[row]):
        assert ids_of(found, collected), found[0]


@pytest.mark.parametrize("row", ROWS)
def test_each_mark_has_a_test_with_that_firmware(row, collected):
    tested = set()
    for found in named(ROWS[row]):
        tested |= firmware_of(found, collected)
    marked = {column for column, cell in zip(COLUMNS, ROWS[row]) if cell.startswith("✓")}
    assert marked <= tested
    for column, cell in zip(COLUMNS, ROWS[row]):
        assert cell[0] in "✓=–", (column, cell)


def test_notes_are_there():
    text = (DOCS / "firmware.md").read_text(encoding="utf-8")
    notes = set(re.findall(r"^(\d)\. ", text, re.MULTILINE))
    used = {cell[2:] for row in ROWS.values() for cell in row[:-1] if cell[2:]}
    assert used == notes
