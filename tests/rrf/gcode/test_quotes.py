"""Quotes that a host cuts open."""

import pytest

from octoprint_rrfmodel.rrf.gcode.quotes import completed, has_odd_quote, without_comment


@pytest.mark.parametrize(
    "line, whole",
    [
        ('M291 P"a;b" S3', 'M291 P"a;b" S3'),
        ('M118 S"a" ; "b;', 'M118 S"a"'),
        ('M118 S"say ""x;y""" ; z', 'M118 S"say ""x;y"""'),
        ("G1 X1 ; a", "G1 X1"),
        ("; a", ""),
    ],
)
def test_where_a_comment_begins(line, whole):
    assert without_comment(line) == whole
    assert not has_odd_quote(whole)


@pytest.mark.parametrize(
    "command, gcode, closed",
    [
        ('M118 P1 S"so', "M118", 'M118 P1 S"so"'),
        ('echo "so', "echo", 'echo "so"'),
        ('M117 "so', "M117", 'M117 "so"'),
        ('M117 5" wide', "M117", 'M117 "5"" wide"'),
        # what is lost may be a parameter, or the rest of a name
        ('M291 P"so', "M291", None),
        ('M98 P"so', "M98", None),
        ('M30 "so', "M30", None),
        ('G1 X"1', "G1", None),
    ],
)
def test_closed_where_nothing_but_text_is_lost(command, gcode, closed):
    assert completed(command, gcode) == closed
    assert closed is None or not has_odd_quote(closed)
