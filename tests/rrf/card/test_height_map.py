"""The file of a bed's mesh: the three forms that firmware writes, and whatever is none."""

import statistics

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.card.height_map import (
    MOST_BYTES,
    BrokenHeightMap,
    HeightMap,
    height_map,
)

TITLE = (
    "RepRapFirmware height map file v2 generated at 2026-11-29 09:30, min error -0.123,"
    " max error 0.456, mean 0.012, deviation 0.078"
)
POINTS = "  0.012, -0.034,      0\n  0.100,  0.000,  0.200\n"

NEW = (
    f"{TITLE}\naxis0,axis1,min0,max0,min1,max1,radius,spacing0,spacing1,num0,num1\n"
    f"X,Y,20.00,60.00,10.00,40.00,-1.00,20.00,30.00,3,2\n{POINTS}"
)
OLD = (
    f"{TITLE}\nxmin,xmax,ymin,ymax,radius,xspacing,yspacing,xnum,ynum\n"
    f"20.00,60.00,10.00,40.00,-1.00,20.00,30.00,3,2\n{POINTS}"
)
OLDEST = (
    "RepRapFirmware height map file v1, mean 0.012, deviation 0.078\n"
    "xmin,xmax,ymin,ymax,radius,spacing,xnum,ynum\n"
    f"20.00,60.00,10.00,30.00,140.00,20.00,3,2\n{POINTS}"
)

ROWS = ((0.012, -0.034, None), (0.1, 0.0, 0.2))

WHOLE = HeightMap(("X", "Y"), (20.0, 10.0), (20.0, 30.0), (3, 2), -1.0, ROWS)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param(NEW, WHOLE, id="from 3.3-beta2 on"),
        pytest.param(OLD, WHOLE, id="up to 3.3-beta1"),
        pytest.param(OLDEST, WHOLE._replace(spacing=(20.0, 20.0), radius=140.0), id="oldest"),
        pytest.param(NEW.replace("\n", "\r\n"), WHOLE, id="edited on Windows"),
        pytest.param(NEW + "\n\n", WHOLE, id="blank lines behind it"),
        pytest.param(NEW.replace("X,Y", "Y,Z"), WHOLE._replace(axes=("Y", "Z")), id="other axes"),
        pytest.param(
            NEW.replace(" generated at 2026-11-29 09:30", ""), WHOLE, id="clock was not set"
        ),
    ],
)
def test_forms(text, expected):
    assert height_map(text) == expected


def test_zero_with_decimals_was_probed_and_without_it_was_not():
    assert height_map(NEW).points[1][1] == 0.0
    assert height_map(NEW).points[0][2] is None


def test_statistics_are_those_of_what_was_probed():
    known = [0.012, -0.034, 0.1, 0.0, 0.2]
    assert height_map(NEW).statistics() == {
        "deviation": pytest.approx(statistics.pstdev(known), abs=1e-4),
        "mean": pytest.approx(statistics.mean(known), abs=1e-4),
        "least": -0.034,
        "most": 0.2,
    }


def test_map_without_a_point_has_none():
    empty = height_map(NEW.replace(POINTS, "0,0,0\n0,0,0\n"))
    assert set(empty.statistics().values()) == {None}


GRID = "X,Y,20.00,60.00,10.00,40.00,-1.00,20.00,30.00,3,2"

BROKEN = [
    ("", "title"),
    ("<html><body>Log in to this hotel's network</body></html>", "title"),
    (NEW.partition("\n")[2], "title"),
    (TITLE, "labels"),
    ("\n".join(NEW.splitlines()[:2]), "labels"),
    (NEW.replace("radius,", ""), "labels"),
    (NEW.replace(GRID, GRID + ",5"), "grid"),
    (NEW.replace(GRID, GRID.replace("20.00,30.00,3", "0.00,30.00,3")), "grid"),
    (NEW.replace(GRID, GRID.replace("20.00,30.00,3", "-20.00,30.00,3")), "grid"),
    (NEW.replace(GRID, GRID.replace("60.00", "10.00")), "grid"),
    (NEW.replace(GRID, GRID.replace("60.00", "nan")), "grid"),
    (NEW.replace(GRID, GRID.replace("60.00", "1e5")), "grid"),
    (NEW.replace(GRID, GRID.replace("X,Y", "X,X")), "grid"),
    (NEW.replace(GRID, GRID.replace("X,Y", "<b>,Y")), "grid"),
    (NEW.replace(",3,2\n", ",999999999999,2\n"), "grid"),
    (NEW.replace(",3,2\n", ",200,200\n"), "grid"),
    (NEW.replace(",3,2\n", ",0,2\n"), "grid"),
    (NEW.replace(",3,2\n", ",3.0,2\n"), "grid"),
    (NEW.replace(",3,2\n", ",٣,2\n"), "grid"),
    (NEW[: NEW.rindex("  0.100")], "rows"),
    (NEW + "0.1,0.1,0.1\n", "rows"),
    (NEW[:-10], "row"),
    (NEW.replace("-0.034", "-0.034,1.0"), "row"),
    (NEW.replace("-0.034", "nan"), "value"),
    (NEW.replace("-0.034", "inf"), "value"),
    (NEW.replace("-0.034", "1_0.0"), "value"),
    (NEW.replace("-0.034", "9999999.0"), "value"),
    (NEW.replace("-0.034", ""), "value"),
    (NEW + "0,0,0\n" * MOST_BYTES, "large"),
]


@pytest.mark.parametrize(("text", "code"), BROKEN, ids=lambda value: str(value)[-25:])
def test_whatever_is_no_map_is_told_why(text, code):
    with pytest.raises(BrokenHeightMap) as caught:
        height_map(text)
    assert caught.value.code == code


def test_row_that_is_broken_is_named():
    with pytest.raises(BrokenHeightMap) as caught:
        height_map(NEW.replace("0.100", "x"))
    assert (caught.value.code, caught.value.detail) == ("value", "2")


HEIGHTS = st.one_of(
    st.none(),
    st.integers(-9999, 9999).map(lambda thousandths: thousandths / 1000),
)


@st.composite
def maps(draw):
    columns, rows = draw(st.integers(1, 12)), draw(st.integers(1, 12))
    lengths = st.integers(-30000, 30000).map(lambda hundredths: hundredths / 100)
    steps = st.integers(1, 10000).map(lambda hundredths: hundredths / 100)
    return HeightMap(
        axes=draw(st.sampled_from([("X", "Y"), ("Y", "X"), ("X", "'a")])),
        min=(draw(lengths), draw(lengths)),
        spacing=(draw(steps), draw(steps)),
        size=(columns, rows),
        radius=draw(st.sampled_from([-1.0, 120.0])),
        points=tuple(tuple(draw(HEIGHTS) for _ in range(columns)) for _ in range(rows)),
    )


def written(found):
    """Return the file that firmware would write."""
    ends = [
        begin + step * (count - 1)
        for begin, step, count in zip(found.min, found.spacing, found.size)
    ]
    grid = [
        *found.axes,
        *(f"{each:.2f}" for pair in zip(found.min, ends) for each in pair),
        f"{found.radius:.2f}",
        *(f"{each:.2f}" for each in found.spacing),
        *map(str, found.size),
    ]
    rows = [
        ",".join("      0" if each is None else f"{each:7.3f}" for each in row)
        for row in found.points
    ]
    return "\n".join([*NEW.splitlines()[:2], ",".join(grid), *rows, ""])


@given(maps())
def test_what_firmware_writes_is_read_back(found):
    assert height_map(written(found)) == found


@given(maps(), st.data())
def test_a_file_that_ends_too_early_is_no_map(found, data):
    text = written(found)
    # behind its last digit nothing is missing
    cut = text[: data.draw(st.integers(0, len(text.rstrip()) - 1))]
    try:
        taken = height_map(cut)
    except BrokenHeightMap:
        return
    # only digits of the very last number can be gone without anybody seeing it
    assert taken.points[:-1] == found.points[:-1]
    assert taken.points[-1][:-1] == found.points[-1][:-1]


@given(st.text(max_size=400))
def test_any_text_is_a_map_or_told_why(text):
    for tried in (text, f"{TITLE}\n{text}", NEW.replace(GRID, text), NEW + text):
        try:
            height_map(tried)
        except BrokenHeightMap as broken:
            assert broken.code
