"""A line cut into commands, and their parameters."""

from __future__ import annotations

import pytest

from octoprint_rrfmodel.simulator.text.command import SyntaxProblem
from octoprint_rrfmodel.simulator.text.cutting import bad_command, commands_of, without_comment


def commands(line, **options):
    return commands_of(line, {"state.upTime": 5}.get, **options)


SPLITS = {
    "one": ("G28", ["G28"]),
    "several": ("M120 G91 G1 X10 F6000 M121", ["M120", "G91", "G1", "M121"]),
    "without blanks": ("G91G1X10F6000G90", ["G91", "G1", "G90"]),
    "fraction": ('M36.1 P"a" S0', ["M36.1"]),
    "lower case": ("g28 m84", ["G28", "M84"]),
    "letters in quotes": ('M118 S"G28 M84"', ["M118"]),
    "letters in braces": ('M118 S{"G28" ^ "M1"}', ["M118"]),
    "whole-line text": ("M117 Go G28 M84", ["M117"]),
    "file name": ("M23 G28 part.gcode", ["M23"]),
    "quoted file name, then more": ('M32 "a.gcode" M105', ["M32", "M105"]),
    "tool": ("T10 P0", ["T10"]),
    "no tool": ("T-1", ["T-1"]),
    "tool query": ("T", ["T"]),
    "apostrophe keeps a letter": ("G1 'g5 X1", ["G1"]),
    "meta": ('echo "G28 M84"', ["echo"]),
    "blanks": ("  ", []),
}


@pytest.mark.parametrize(("line", "names"), SPLITS.values(), ids=SPLITS)
def test_commands_of_a_line(line, names):
    assert [command.name for command in commands(line)] == names


@pytest.mark.parametrize("line", ["foo", "12", "X10", "{", "*", "M 105", "if true", "abort"])
def test_bad_command(line):
    (command,) = commands(line)
    assert command.letter == "bad"
    assert bad_command(command.text) == f"Bad command: {line}"


def test_conditions_are_commands_in_a_file():
    (command,) = commands("if true", in_file=True)
    assert command.letter == "meta"


def test_coordinates_alone_go_on_with_the_last_move_on_a_cnc_machine():
    (command,) = commands("X10 Y20", last_move=1)
    assert command.name == "G1"
    assert command.coordinates() == {"X": 10.0, "Y": 20.0}


VALUES = {
    "integer": ("M104 S200", "S", 200),
    "negative": ("M568 S-273.1", "S", -273.1),
    "list": ("G1 E1:2.5", "E", [1, 2.5]),
    "text": ('M117 S"a b"', "S", "a b"),
    "doubled quote": ('M118 S"say ""hi"""', "S", 'say "hi"'),
    "apostrophe": ('M118 S"\'ABC"', "S", "aBC"),
    "two apostrophes": ("M118 S\"it''s\"", "S", "it's"),
    "expression": ("M104 S{state.upTime * 2}", "S", 10),
    "array expression": ('M291 K{"a","b"}', "K", ["a", "b"]),
    "missing": ("M104 S200", "P", None),
    "lower case letter": ("m104 s200", "S", 200),
    "quoted lower-case axis": ("G1 'a12", "a", 12),
    "no value": ("G28 X Y", "X", None),
}


@pytest.mark.parametrize(("line", "letter", "expected"), VALUES.values(), ids=VALUES)
def test_parameter(line, letter, expected):
    assert commands(line)[0].value(letter) == expected


def test_letter_without_value_is_there():
    (command,) = commands("G28 X Y")
    assert "X" in command
    assert "Z" not in command


@pytest.mark.parametrize(
    ("line", "column"), [("M409 K5", 7), ('M409  F"d99" K5', 15), ("G21 M409 K5", 11)]
)
def test_a_text_must_be_quoted(line, column):
    with pytest.raises(SyntaxProblem) as problem:
        commands(line)[-1].string("K")
    assert problem.value.text == "M409: expected a string expression"
    assert problem.value.column == column


@pytest.mark.parametrize("length", [100, 101])
def test_text_can_be_too_long(length):
    (command,) = commands(f'M409 K"{"k" * length}"')
    if length <= 100:
        assert command.string("K", 100) == "k" * length
    else:
        with pytest.raises(SyntaxProblem, match="string too long"):
            command.string("K", 100)


COMMENTS = {
    "end of line": ("G28 ; home", "G28 "),
    "whole line": ("; home", ""),
    "in quotes": ('M117 "a;b"', 'M117 "a;b"'),
    "after quotes": ('M117 "a";b', 'M117 "a"'),
}


@pytest.mark.parametrize(("line", "expected"), COMMENTS.values(), ids=COMMENTS)
def test_comment(line, expected):
    assert without_comment(line) == expected


def test_parentheses_are_comments_on_a_cnc_machine_only():
    assert without_comment("G1 (fast) X1", parentheses=True) == "G1  X1"
    assert without_comment("G1 (fast) X1") == "G1 (fast) X1"
