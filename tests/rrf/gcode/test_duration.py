"""Commands that may keep the line silent for long."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.gcode.blocking import BLOCKING, MOVES, is_plain_move, may_change
from octoprint_rrfmodel.rrf.gcode.duration import QUICK, takes_long


@pytest.mark.parametrize(
    "line, gcode",
    [
        *((code, code) for code in sorted(BLOCKING)),
        ("T-1", "T"),
        ("M120 G28 X M121", "M120"),
        ("M120 T1 P0 M121 G4 S1", "M120"),
        # the machine's own macros
        ("G6511 R0", "G6511"),
        ("M1234", "M1234"),
        ("G280", "G280"),
        ("M98.1", "M98.1"),
        ("M585 Z10 P0", "M585"),
        ("M401", "M401"),
    ],
)
def test_takes_long(line, gcode):
    assert takes_long(line, gcode)


@pytest.mark.parametrize(
    "line, gcode",
    [
        ("G1 X10 E2 F3000", "G1"),
        ("G0 X1", "G0"),
        ("G01 X1", "G01"),
        ("M03 S1000", "M03"),
        ("F3000", "F"),
        ("M105", "M105"),
        ('M409 K"heat"', "M409"),
        ("M117 G28 comes next", "M117"),
        ('M118 S"M109"', "M118"),
        ("M120 G21 G91 G1 X10 F6000 M121", "M120"),
        ("M104 S200 T1", "M104"),
        ("M115", "M115"),
        ("M999", "M999"),
    ],
)
def test_is_quick(line, gcode):
    assert not takes_long(line, gcode)


def test_nothing_is_both():
    assert QUICK.isdisjoint(BLOCKING)


PARTS = st.sampled_from([" ", "X1", "E2", "H1", "G28", "M98", "G1", "P", '"G"', ";", "T1", "1"])


@given(st.sampled_from(sorted(MOVES)), st.lists(PARTS, max_size=6))
def test_a_plain_move_is_quick_and_changes_nothing(gcode, parts):
    line = " ".join([gcode, *parts])
    if is_plain_move(line):
        assert not takes_long(line, gcode)
        assert not may_change(gcode, line)
