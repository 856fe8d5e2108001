"""Words, numbers and quoting of G-code lines."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.wire import gcode_words as gcode


@pytest.mark.parametrize(
    "line, words",
    [
        ("G0 X10 Y-5.5 F200", {"G": 0, "X": 10, "Y": -5.5, "F": 200}),
        ("G28 X0 Y0", {"G": 28, "X": 0, "Y": 0}),
        ("T10", {"T": 10}),
        ("M104 T1 S.5", {"M": 104, "T": 1, "S": 0.5}),
        ("G28 X Y", {"G": 28, "X": None, "Y": None}),
        # as Python writes what is very small or large
        ("G0 X1e-05 Y-2.5e+16 F200", {"G": 0, "X": 1e-05, "Y": -2.5e16, "F": 200}),
        ("G1 X1E5", {"G": 1, "X": 1, "E": 5}),
    ],
)
def test_words(line, words):
    assert gcode.words(line) == words


@pytest.mark.parametrize(
    "value, text",
    [(10.0, "10"), (0.02, "0.02"), (-0.0, "0"), (1e-9, "0"), (100000.0, "100000"), (1.5, "1.5")],
)
def test_number_is_short_and_plain(value, text):
    assert gcode.number(value) == text


@given(st.floats(-1e6, 1e6))
def test_number_is_read_back(value):
    assert float(gcode.number(value)) == pytest.approx(value, abs=1e-5)


@pytest.mark.parametrize(
    "text, quoted",
    [("a", '"a"'), ('say "x"', '"say ""x"""'), ("it's", "\"it''s\"")],
)
def test_quoted_doubles_what_the_firmware_reads_otherwise(text, quoted):
    assert gcode.quoted(text) == quoted


@given(st.text())
def test_quoted_text_is_found_again(text):
    assert gcode.texts(f"M291 P{gcode.quoted(text)} S3") == {"P": text}


@pytest.mark.parametrize(
    "line, texts",
    [
        ("M291 S3", {}),
        ('M291 P"a" R "b"', {"P": "a", "R": "b"}),
        ('M291 R"say P""x""" P"y"', {"R": 'say P"x"', "P": "y"}),
        ('M291 S4 P"x" K{"A","B"}', {"P": "x"}),
        ("M291 P\"'A'B and it''s\"", {"P": "ab and it's"}),
        ('M291 P{"a" ^ var.b}', {}),
        ('M291 P"not ended', {}),
    ],
)
def test_texts_by_their_letters(line, texts):
    assert gcode.texts(line) == texts


@pytest.mark.parametrize("letter, word", [("X", "X5"), ("A", "A5"), ("a", "'a5")])
def test_lower_case_axis_has_an_apostrophe(letter, word):
    assert gcode.axis_word(letter, "5") == word
