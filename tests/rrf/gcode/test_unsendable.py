"""Commands that had better not be sent, row by row."""

import pytest

from octoprint_rrfmodel.rrf.gcode.recognition import ROWS as OPERATIONS
from octoprint_rrfmodel.rrf.gcode.unsendable import GCODES, ROWS, text_of_box, unsendable
from octoprint_rrfmodel.rrf.views.machine import Machine


def row_for(line, version="3.5.3"):
    machine = Machine({"boards": [{"firmwareVersion": version}]})
    row = unsendable(line, line.split()[0], machine)
    return row.name if row else None


CASES = [
    ('M291 P"x" S2', "message_box"),
    ('M291 P"x" R"y" S3', "message_box"),
    ('M291 S4 P"x" K{"S1","b"}', "message_box"),
    ('M291 P"S1" S7', "message_box"),
    # nobody knows what it will be
    ('M291 P"x" S{var.mode}', "message_box"),
    ('M291 P"x" S1', None),
    ('M291 P"x" S0 T5', None),
    ('M291 P"S2 and S3"', None),
    ('M291 P"say ""S2"" S3" S1', None),
    ("M111", "debug_table"),
    ("M111 P3", "debug_table"),
    ("M111 S1 P3", "debug_table"),
    ("M111 S1", None),
    ("M155 S2", "probes"),
    ("M113 S2", "probes"),
    ("M154 S5", "probes"),
    ("M410", "probes"),
    ("M112", None),
    ("G1 X10", None),
]


@pytest.mark.parametrize("line, name", CASES)
def test_command(line, name):
    assert row_for(line) == name


@pytest.mark.parametrize(
    "version, name",
    [
        ("2.05.1", None),
        ("3.4.6", None),
        ("3.5.0", "message_box"),
        ("3.6.0", "message_box"),
        ("3.6.1", None),
        ("", None),
    ],
)
def test_message_box_by_firmware(version, name):
    assert row_for('M291 P"x" S2', version) == name


@pytest.mark.parametrize(
    "line, text",
    [
        ('M291 P"Is it ""S1""?" R"Look" S3', 'Is it "S1"?'),
        ('M291 S2 R"P" P"Go"', "Go"),
        ("M291 P{var.text} S3", "M291 P{var.text} S3"),
    ],
)
def test_text_of_a_box(line, text):
    assert text_of_box(line) == text


def test_only_a_box_is_a_place_to_pause():
    assert [row.name for row in ROWS if row.pauses] == ["message_box"]


def test_table():
    names = [row.name for row in ROWS]
    # all are switched by the same settings
    assert len({*names, *(row.name for row in OPERATIONS)}) == len(names) + len(OPERATIONS)
    assert all(row.reason.endswith(".") for row in ROWS)
    assert {line.split()[0] for line, name in CASES if name} == GCODES
