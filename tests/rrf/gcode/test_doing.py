"""What the line is busy with, by the command that went out."""

import pytest

from octoprint_rrfmodel.rrf.gcode.blocking import BLOCKING
from octoprint_rrfmodel.rrf.gcode.doing import OTHER, ROWS, what_of

PUBLIC = {
    *("homing", "heating", "probing", "calibrating", "tool_change", "macro", "filament"),
    *("pausing", "resuming", "cancelling", "waiting", "answer", "saving", "other"),
}
"""The words of the public status."""

TABLE = {
    "homing": ["G28", "G28 X Y", "G28 X0 Y0", "g28 z", "G28X", "G028", " G28", "M120 G28 M121"],
    "heating": ["M109 S205 T1", "M116", "M116 P0", "M190 P1 S60", "M191 R40", "M303 H1 S200"],
    "probing": [
        *("G29", "G29 S0", "G29 S{var.mode}", "G30", "G30 P0 X10 Y10 Z-99999", "G30 S-1"),
        *(
            "G38.2 Z-5",
            "G38.3 Z-5",
            "G38.4 Z5",
            "G38.5 X3",
            "M401",
            "M402",
            "M585 Z10 P0",
            "M675 X F100",
        ),
    ],
    "calibrating": ["G32", "G32 ; level"],
    "tool_change": ["T0", "T-1", "T10 P0", "t1", "T{var.tool}", "T R1"],
    "macro": ['M98 P"0:/macros/a.g"', 'M98 P"G28 M109.g"', "M501", "M502"],
    "filament": ['M701 S"PLA"', "M702", "M703"],
    "pausing": ["M25", "M25 P0", "M125", "M600", "M601"],
    "resuming": ["M24", "M24 P0", "M916"],
    "cancelling": ["M0", "M1", "M2", "M0 H1", "M00"],
    "waiting": ["G4 S10", "G4 P500", "G04 S1", "M226", "M400", "M577 P0 S1", "M598"],
    "answer": [
        *('M291 P"Go on?" S2', 'M291 P"m" R"t" S3', 'M291 P"m" S4 K{"a","b"}'),
        *('M291 P"m" S{var.mode}', 'M291 S3 P"S1"'),
    ],
    "saving": ["M500", "M500 P10:31", "M374", 'G29 S3 P"a.csv"'],
    "other": [
        *("", " ", "G0 X1", "G1 X10 E2 F3000", "M120 G21 G91 G1 X10 F6000 M121"),
        *("G10 P0 S205", "G29 S1", 'G29 S1 P"a.csv"', "G29 S2", "G29 S4"),
        *("M104 S205 T1", "M140 P0 S60", "M568 P0 S205 A2", "M106 P0 S0.5", "M290 Z0.02"),
        *("M220 S110", "M221 D0 S95", "M105", 'M409 K"heat"', "M112", "M999", "M292 P0"),
        *('M291 P"Look"', 'M291 P"S2" S1', 'M291 P"m" R"t" S0 T5', "T"),
        *("M117 G28 comes next", 'M118 S"G28"', "M32 G28.gcode", "M36.1 P0", "M28.1"),
        *('echo "G28"', "set var.g28 = 1", "; G28", "M569 P0 T2:2:5:0", "M42 P{var.dim4} S1"),
        *("G280", "M1090", "M1234", "M98.1", "G38", "G92 'g28"),
    ],
}


@pytest.mark.parametrize(
    "what, line",
    [
        pytest.param(what, line, id=f"{what}-{line}")
        for what, lines in TABLE.items()
        for line in lines
    ],
)
def test_what_the_line_is_busy_with(what, line):
    assert what_of(line) == what


def test_words_are_the_public_ones():
    assert {row.what for row in ROWS} | {OTHER} == PUBLIC
    assert set(TABLE) == PUBLIC


@pytest.mark.parametrize(
    "what, gcode",
    [
        pytest.param(row.what, gcode, id=f"{row.what}-{gcode}")
        for row in ROWS
        for gcode in row.gcodes
    ],
)
def test_every_command_of_the_table_has_a_case(what, gcode):
    assert [line for line in TABLE[what] if line.upper().startswith(gcode)]


def test_a_command_stands_in_two_rows_only_where_its_parameters_decide():
    listed = [gcode for row in ROWS for gcode in row.gcodes]
    assert {gcode for gcode in listed if listed.count(gcode) > 1} == {"G29"}
    for mode in ("", "S0", "S1", "S2", "S3", "S4", "S{1}"):
        found = [row for row in ROWS if "G29" in row.gcodes and row.hits(f"G29 {mode}")]
        assert len(found) <= 1


@pytest.mark.parametrize("gcode", sorted(BLOCKING))
def test_a_command_that_blocks_is_told_by_name(gcode):
    assert what_of("T1" if gcode == "T" else gcode) != OTHER


@pytest.mark.parametrize(
    "line, what",
    [
        ("G91 G28 X", "homing"),
        ("M104 S200 M109 S200", "heating"),
        ("G28 M109 S200", "homing"),
        ("M400 G4 S1", "waiting"),
        ('M98 P"a" M400', "macro"),
    ],
)
def test_of_several_commands_the_first_that_counts_is_told(line, what):
    assert what_of(line) == what
