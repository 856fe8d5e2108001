"""Where a line stands in its file."""

import pytest

from octoprint_rrfmodel.rrf.gcode.file_place import Place, line_number, named, text_at

LINES = ["; a", "G1 X1 ; b", "", 'M118 S"a;b"', "M600"]


@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("number, command", [(2, "G1 X1"), (4, 'M118 S"a'), (5, "M600")])
def test_place(tmp_path, number, command, end):
    path = tmp_path / "a.gcode"
    path.write_bytes(end.join(LINES).encode())
    position = min(len("".join(line + end for line in LINES[:number])), path.stat().st_size)
    place = Place(command, str(path), position)
    assert text_at(place) == LINES[number - 1]
    assert line_number(place) == number
    assert named(place) == f"{number}: {command}"


def test_long_file(tmp_path):
    path = tmp_path / "long.gcode"
    line = "G1 X1 Y1\n"
    path.write_text(line * 200_000 + "M600\n", encoding="ascii")
    assert line_number(Place("M600", str(path), path.stat().st_size)) == 200_001


def test_place_that_is_wrong(tmp_path):
    path = tmp_path / "a.gcode"
    path.write_text("G1 X1\nM600\n", encoding="ascii")
    for place in (
        Place("M600", str(path), 6),
        Place("M600", str(path), 0),
        Place("M600", "/nowhere/a.gcode", 6),
        Place("M600"),
    ):
        assert line_number(place) is None
        assert named(place) == "M600"
