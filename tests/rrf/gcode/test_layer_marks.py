"""Layers of a file that a host sends: what each slicer writes, wherever the file is cut."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.gcode.layer_marks import layer_marks

PRUSA = "G28\n;LAYER_CHANGE\n;Z:0.2\n;HEIGHT:0.2\nG1 X1\n;LAYER_CHANGE\n;Z:0.4\nG1 X2\n"
CURA = ";LAYER_COUNT:2\n;LAYER:0\nG1 X1\n;LAYER:1\r\nG1 X2\n"
SIMPLIFY = "; layer 1, Z = 0.250\nG1 X1\n; layer 2, Z = 0.500\nG1 X2\n; layer end\n"
KISS = "; BEGIN_LAYER_OBJECT z=0.25\nG1 X1\n; BEGIN_LAYER_OBJECT z=0.5\nG1\n"


@pytest.mark.parametrize(
    "text, heights",
    [
        (PRUSA, (0.2, 0.4)),
        (PRUSA.replace("\n", "\r\n"), (0.2, 0.4)),
        (CURA, (None, None)),
        (SIMPLIFY, (0.25, 0.5)),
        (KISS, (0.25, 0.5)),
    ],
)
def test_layers_of_each_slicer(text, heights):
    marks = layer_marks([text.encode()])
    assert marks.count == 2
    assert tuple(map(marks.height_of, (1, 2))) == heights
    first = text.index("G1 X1") if "G1 X1" in text else 0
    last = text.rindex("G1")
    assert [marks.layer_at(place) for place in (first, last, len(text))] == [1, 2, 2]
    assert layer_marks([text.encode()]).height_of(3) is None


def test_a_file_without_marks_tells_of_none():
    marks = layer_marks([b"G1 Z0.2\n; a LAYER_CHANGE\n;LAYERS:2\n;TYPE:Infill\n"])
    assert (marks.count, marks.layer_at(20), marks.height_of(1)) == (0, 0, None)


def test_nonsense_is_no_height():
    assert layer_marks([b";LAYER_CHANGE\n;Z:1.2.3\n"]).height_of(1) is None


@given(
    st.lists(st.sampled_from((PRUSA, CURA, SIMPLIFY, "G1 X" + "1" * 900 + "\n")), max_size=8),
    st.integers(1, 700),
)
def test_where_the_file_is_cut_makes_no_difference(parts, size):
    data = "".join(parts).encode()
    whole = layer_marks([data])
    cut = layer_marks(data[place : place + size] for place in range(0, len(data), size))
    places = range(0, len(data) + 1, 7)
    assert cut.count == whole.count
    assert [cut.layer_at(each) for each in places] == [whole.layer_at(each) for each in places]
    layers = range(1, whole.count + 1)
    assert [cut.height_of(each) for each in layers] == [whole.height_of(each) for each in layers]
