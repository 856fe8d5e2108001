"""The evaluator against its rules, on a tree of its own; runs without any recording."""

import copy
import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.model.m409 import AXES_SHOWN, ROOT_ARRAY_BYTES, answer, parse_flags
from octoprint_rrfmodel.rrf.model.marks import MARKS
from tests.support.examples import some

from ..strategies import ANY_JSON, compact

MODEL = {
    "cold": {"deep": {"hot": 1, "leaf": 2}, "list": [{"k": 1}, None, {"k": 3, "s": {"z": 9}}]},
    "empty": [],
    "hot": {"arr": [[1, 2], [3], []], "cold": 5, "hot": 6, "nul": None, "old": 7, "wordy": 8},
    "hotList": [{"hot": 1, "cold": 2}, None, {"hot": 3}],
    "nul": None,
    "num": 12,
    "text": 'a"°',
    "urgent": None,
    "urgentObj": {"cold": 1, "urgent": 2},
    "wordyHot": 4,
    "yes": True,
}

TREE_MARKS = {
    "cold": frozenset(),
    "cold.deep": frozenset(),
    "cold.deep.hot": frozenset(["live"]),
    "hot": frozenset(["live"]),
    "hot.arr": frozenset(["live"]),
    "hot.hot": frozenset(["live"]),
    "hot.nul": frozenset(["live"]),
    "hot.old": frozenset(["live", "obsolete"]),
    "hot.wordy": frozenset(["live", "verbose"]),
    "hotList": frozenset(["live"]),
    "hotList[].hot": frozenset(["live"]),
    "urgent": frozenset(["important"]),
    "urgentObj": frozenset(["important"]),
    "urgentObj.urgent": frozenset(["important"]),
    "wordyHot": frozenset(["live", "verbose"]),
}

NOTHING = object()

# key, flags, result, next; the numbers are those of the sections of the rules
CASES = [
    # 1: echo; only the first # counts
    ("#empty", "", 0, NOTHING),
    ("##empty", "", None, NOTHING),
    ("# empty", "", None, NOTHING),
    # 1.3: nothing is trimmed or case-folded
    ("Num", "", None, NOTHING),
    (" num", "", None, NOTHING),
    ("num ", "", None, NOTHING),
    ("nu", "", None, NOTHING),
    # 2: flags
    ("num", "f", None, NOTHING),
    ("hot.hot", "f", 6, NOTHING),
    ("hot.hot", "F", 6, NOTHING),
    ("hot", "f", {"arr": [[1, 2], [3], []], "hot": 6}, NOTHING),
    (
        "hot",
        "f,n v;o",
        {"arr": [[1, 2], [3], []], "hot": 6, "nul": None, "old": 7, "wordy": 8},
        NOTHING,
    ),
    ("hot", "F", {"arr": [[1, 2], [3], []], "cold": 5, "hot": 6}, NOTHING),
    ("wordyHot", "f", None, NOTHING),
    ("wordyHot", "fv", 4, NOTHING),
    ("hot.old", "f", None, NOTHING),
    ("hot.old", "of", 7, NOTHING),
    ("hot", "d", {}, NOTHING),
    ("hot", "d 2", {}, NOTHING),
    ("hot", "d-1", {}, NOTHING),
    ("hot", "D1", {"arr": [[1, 2], [3], []], "cold": 5, "hot": 6}, NOTHING),
    ("hot.hot", "d0d2", 6, NOTHING),
    ("hot.hot", "d2d1", {}, NOTHING),
    ("hot.hot", f"d{2**32 + 2}", 6, NOTHING),
    ("hot.hot", f"d{2**32 + 1}", {}, NOTHING),
    ("hot.arr", "a1", [[3], []], 0),
    ("hot.arr", "a1a", [[1, 2], [3], []], 0),
    ("hot.arr", "a-1", [[1, 2], [3], []], 0),
    ("hot.arr", "a 1", [[1, 2], [3], []], 0),
    ("hot.arr", f"a{2**32 + 2}", [[]], 0),
    # 3: what is shown; each name on the way has to pass
    ("cold.deep.hot", "f", None, NOTHING),
    ("cold.deep.hot", "", 1, NOTHING),
    ("nul", "n", None, NOTHING),
    ("urgentObj", "fi", {"urgent": 2}, NOTHING),
    ("urgentObj", "f", None, NOTHING),
    ("urgentObj.cold", "i", 1, NOTHING),
    # 4: depth counts objects from the root
    ("", "d0", {}, NOTHING),
    ("cold", "d1", {}, NOTHING),
    ("cold", "d2", {"deep": {}, "list": [{}, None, {}]}, NOTHING),
    ("cold.nothing", "d1", {}, NOTHING),
    ("cold.nothing", "d2", None, NOTHING),
    ("#cold.list", "d1", {}, NOTHING),
    ("#cold.list", "d2", 3, NOTHING),
    ("cold.list", "d2", [{}, None, {}], 0),
    ("cold.list", "d3", [{"k": 1}, None, {"k": 3, "s": {}}], 0),
    ("cold.list[2].s", "d4", {"z": 9}, NOTHING),
    ("cold.list[2].s", "d3", {}, NOTHING),
    # 5: key grammar
    ("cold.deep.", "", {"hot": 1, "leaf": 2}, NOTHING),
    ("cold.deep..", "", None, NOTHING),
    ("cold.deep[0]", "", None, NOTHING),
    ("cold.deep[]", "", None, NOTHING),
    ("cold.deep^", "", None, NOTHING),
    ("cold.deep]", "", None, NOTHING),
    ("cold..deep", "", None, NOTHING),
    (".cold", "", None, NOTHING),
    (".", "", None, NOTHING),
    ("cold. deep", "", None, NOTHING),
    ("cold.[0]", "", None, NOTHING),
    ("hot.arr[]", "", [[1, 2], [3], []], 0),
    ("hot.arr[0]", "", [1, 2], 0),
    ("hot.arr[0][1]", "", 2, NOTHING),
    ("hot.arr[][0]", "", [1, 3, None], 0),
    ("hot.arr[][]", "", [[1, 2], [3], []], 0),
    ("hot.arr[ 1]", "", [3], 0),
    ("hot.arr[\t1]", "", [3], 0),
    ("hot.arr[+1]", "", [3], 0),
    ("hot.arr[01]", "", [3], 0),
    ("hot.arr[-0]", "", [1, 2], 0),
    ("hot.arr[" + "0" * 60 + "1]", "", [3], 0),
    ("hot.arr[1 ]", "", None, NOTHING),
    ("hot.arr[1.0]", "", None, NOTHING),
    ("hot.arr[0x1]", "", None, NOTHING),
    ("hot.arr[1,2]", "", None, NOTHING),
    ("hot.arr[x]", "", None, NOTHING),
    ("hot.arr[1", "", None, NOTHING),
    ("hot.arr[", "", None, NOTHING),
    ("hot.arr[-1]", "", None, NOTHING),
    ("hot.arr[3]", "", None, NOTHING),
    ("hot.arr[99999999999999999999999999]", "", None, NOTHING),
    ("hot.arr[\u0661]", "", None, NOTHING),
    ("hot.arr.x", "", None, NOTHING),
    ("hot.arr.", "", None, NOTHING),
    ("hot.arr^", "", None, NOTHING),
    ("hotList[].cold", "", [2, None, None], 0),
    ("hotList[].cold", "f", [None, None, None], 0),
    ("hotList[].hot", "f", [1, None, 3], 0),
    ("hotList[]", "f", [{"hot": 1}, None, {"hot": 3}], 0),
    ("hotList[0]", "", {"hot": 1, "cold": 2}, NOTHING),
    ("hotList[0].", "", {"hot": 1, "cold": 2}, NOTHING),
    ("hotList[0]hot", "", None, NOTHING),
    ("hotList[]hot", "", [None, None, None], 0),
    ("hotList[1].hot", "", None, NOTHING),
    ("cold.list[].s.z", "", [None, None, 9], 0),
    ("num.x", "", None, NOTHING),
    ("num[0]", "", None, NOTHING),
    ("num.", "", None, NOTHING),
    ("nul.x", "n", None, NOTHING),
    ("*", "", None, NOTHING),
    # 6: lengths
    ("#hot.arr", "", 3, NOTHING),
    ("#hot.arr", "a2", 3, NOTHING),
    ("#hot.arr[0]", "", 2, NOTHING),
    ("#hot.arr[]", "", [2, 1, 0], 0),
    ("#text", "", 4, NOTHING),
    ("#num", "", None, NOTHING),
    ("#yes", "", None, NOTHING),
    ("#nul", "n", None, NOTHING),
    ("#cold", "", None, NOTHING),
    ("#cold.", "", {"deep": None, "list": 3}, NOTHING),
    ("#hotList", "f", 3, NOTHING),
    ("#empty", "f", None, NOTHING),
    # 7: a root array has next, no other has
    ("empty", "", [], 0),
    ("hotList", "a3", [], 0),
    ("hotList", "a9", [], 0),
    ("hotList", "a2", [{"hot": 3}], 0),
    ("cold", "a1", {"deep": {"hot": 1, "leaf": 2}, "list": MODEL["cold"]["list"]}, NOTHING),
]


def evaluated(key, flags, **options):
    return answer(MODEL, key, flags, TREE_MARKS, **options)


@pytest.mark.parametrize("firmware", [True, False], ids=["firmware", "page"])
@pytest.mark.parametrize(
    ("key", "flags", "result", "following"),
    CASES,
    ids=[f"{case[0][:24]!r}-{case[1][:12]}" for case in CASES],
)
def test_answer_follows_the_rules(key, flags, result, following, firmware):
    expected = {"key": key, "flags": flags, "result": result}
    if following is not NOTHING:
        expected["next"] = following
    got = evaluated(key, flags, firmware=firmware)
    assert got == expected
    assert list(got) == list(expected), "the order of the envelope's members is fixed"


EMPTY_KEY = [
    ("", True, 1),
    ("", False, 1),
    ("f", True, 1),
    ("f", False, 99),
    ("fd2", True, 2),
    ("fd2", False, 2),
    ("v", False, 1),
]


@pytest.mark.parametrize(("flags", "firmware", "depth"), EMPTY_KEY)
def test_depth_of_an_empty_key(flags, firmware, depth):
    """The firmware's default is 1 with f too; the page, and so the endpoint, says 99."""
    got = evaluated("", flags, firmware=firmware)["result"]
    assert got == evaluated("", f"{flags}d{depth}", firmware=firmware)["result"]
    assert (got["hot"] == {}) is (depth == 1)


def test_lengths_of_the_root_are_those_of_its_members():
    assert evaluated("#", "")["result"] == {
        "cold": None,
        "empty": 0,
        "hot": None,
        "hotList": 3,
        "num": None,
        "text": 4,
        "urgentObj": None,
        "yes": None,
    }


@pytest.mark.parametrize(
    ("flags", "shown"), [("", False), ("i", True), ("n", True), ("fi", True), ("fn", False)]
)
def test_null_member_that_is_important_shows_with_i(flags, shown):
    assert ("urgent" in evaluated("", "d1" + flags)["result"]) is shown


TEXTS = [
    ("", 0),
    ("abc", 3),
    ("°", 2),
    ("\u20ac", 3),
    ("\U0001f600", 4),
    ('"\\\n', 3),
    ("\ud800", 3),
]


@pytest.mark.parametrize(("text", "length"), TEXTS, ids=[ascii(text) for text, _ in TEXTS])
def test_length_of_a_text_is_counted_in_bytes_before_escaping(text, length):
    assert answer({"global": {"text": text}}, "#global.text")["result"] == length


def axes(count):
    return {"move": {"axes": [{"letter": letter} for letter in "XYZUVWABCDabcd"[:count]]}}


AXES_CASES = [
    (10, "move.axes", "", 9),
    (10, "move.axes[]", "", 9),
    (10, "move.axes[].letter", "", 9),
    (10, "move.axes", "v", 9),
    (9, "move.axes", "", 9),
    (8, "move.axes", "", 8),
    (10, "move.axes", "f", 10),
    (10, "move.axes", "a", 10),
    (10, "move.axes", "a0", 10),
    (12, "move.axes", "a10", 2),
]


@pytest.mark.parametrize(("count", "key", "flags", "shown"), AXES_CASES)
def test_firmware_admits_to_nine_axes_without_f_or_a(count, key, flags, shown):
    assert AXES_SHOWN == 9
    assert len(answer(axes(count), key, flags, firmware=True)["result"]) == shown


def test_axes_are_limited_wherever_they_are_counted():
    model = axes(10)
    assert answer(model, "#move.axes", firmware=True)["result"] == 9
    assert answer(model, "#move.axes", "a0", firmware=True)["result"] == 10
    assert answer(model, "move.axes[9]", firmware=True)["result"] is None
    assert answer(model, "move.axes[8]", firmware=True)["result"] == {"letter": "C"}
    assert len(answer(model, "move", firmware=True)["result"]["axes"]) == 9


def test_axes_are_limited_whatever_marks_are_given():
    marks = {**MARKS, "move.mine": frozenset()}
    assert len(answer(axes(10), "move.axes", marks=marks, firmware=True)["result"]) == 9


def test_nothing_limits_axes_before_version_3_5_or_on_the_endpoint():
    model = axes(12)
    assert len(answer(model, "move.axes", firmware=True, axes_shown=None)["result"]) == 12
    assert len(answer(model, "move.axes")["result"]) == 12
    assert answer(model, "move.axes[11].letter")["result"] == "b"


def cut(elements, flags=""):
    return answer({"x": elements}, "x", flags, {"x": frozenset()}, firmware=True)


def text_up_to(elements, flags=""):
    """Return the bytes of an answer up to its last element, as the firmware has written it."""
    envelope = compact({"key": "x", "flags": flags, "result": elements})
    return len(envelope.encode()) - len("]}")


def test_root_array_goes_on_one_byte_below_half_of_the_buffers():
    filling = ROOT_ARRAY_BYTES - text_up_to([""])
    just_short = ["x" * (filling - 1), 1]
    assert text_up_to(just_short[:1]) == 4607
    assert cut(just_short) == {"key": "x", "flags": "", "result": just_short, "next": 0}


def test_root_array_stops_at_half_of_the_buffers():
    filling = ROOT_ARRAY_BYTES - text_up_to([""])
    reached = ["x" * filling, 1]
    assert text_up_to(reached[:1]) == 4608
    assert cut(reached) == {"key": "x", "flags": "", "result": reached[:1], "next": 1}


def test_root_array_counts_the_commas_between_elements():
    elements = ["x" * 20] * 1000
    got = cut(elements)
    assert got["next"] == len(got["result"]) < 1000
    assert text_up_to(got["result"]) >= ROOT_ARRAY_BYTES > text_up_to(got["result"][:-1])


def test_first_element_comes_however_long_it_is():
    assert cut(["x" * 9000, 1])["next"] == 1
    assert cut(["x" * 9000])["next"] == 0


def test_pages_put_together_are_the_array():
    elements = [{"n": index, "text": "°" * (index % 40)} for index in range(900)]
    pages, start, requests = [], 0, 0
    while True:
        got = cut(elements, f"a{start}")
        pages += got["result"]
        requests += 1
        start = got["next"]
        if not start:
            break
        assert start == len(pages)
    assert pages == elements
    assert requests > 5


def test_array_inside_an_object_is_not_cut():
    model = {"x": {"y": ["x" * 100] * 200}}
    assert answer(model, "x", firmware=True)["result"] == model["x"]


def test_endpoint_cuts_nothing_for_size():
    elements = ["x" * 100] * 200
    assert answer({"x": elements}, "x") == {"key": "x", "flags": "", "result": elements, "next": 0}


def test_own_marks_are_those_of_the_firmware():
    model = {"heat": {"heaters": [{"current": 20.5, "max": 285}, None]}, "limits": {"axes": 9}}
    assert answer(model, "", "f")["result"] == {"heat": {"heaters": [{"current": 20.5}, None]}}
    assert answer(model, "limits")["result"] == {}
    assert answer(model, "limits", "v")["result"] == {"axes": 9}


FLAG_TEXTS = [
    ("d99fin", ("live", "important", "nulls"), 99, None),
    ("d99vno", ("verbose", "nulls", "obsolete"), 99, None),
    ("p", (), None, None),
    ("s", (), None, None),
    ("f1v2", ("live", "verbose"), None, None),
    ("da", (), 0, 0),
    ("a12,d3", (), 3, 12),
    ("", (), None, None),
]


@pytest.mark.parametrize(("text", "on", "depth", "start"), FLAG_TEXTS)
def test_flags_text_means(text, on, depth, start):
    flags = parse_flags(text)
    assert {name for name in flags._fields if getattr(flags, name) is True} == set(on)
    assert (flags.depth, flags.start) == (depth, start)


ALPHABET = st.text(st.sampled_from("ab.[]^#*01 -+\"'°é\n") | st.characters(), max_size=20)


@settings(max_examples=some(200))
@given(ANY_JSON, ALPHABET, ALPHABET, st.booleans())
def test_never_raises_and_echoes_what_was_asked(model, key, flags, firmware):
    got = answer(model, key, flags, firmware=firmware)
    assert (got["key"], got["flags"]) == (key, flags)
    assert set(got) - {"next"} == {"key", "flags", "result"}
    assert ("next" in got) is isinstance(got["result"], list)


@settings(max_examples=some(100))
@given(
    st.dictionaries(st.sampled_from("ab"), ANY_JSON),
    st.sampled_from(["a", "a.b", "a[].b", "#a", "b[0]", "", "#"]),
    st.text("fvnoid0123a", max_size=6),
)
def test_model_is_not_changed(model, key, flags):
    before = copy.deepcopy(model)
    answer(model, key, flags, TREE_MARKS, firmware=True)
    assert json.dumps(model) == json.dumps(before)


def test_model_deeper_than_python_can_go_gives_null():
    model = leaf = {}
    for _ in range(100000):
        leaf["a"] = [{}]
        leaf = leaf["a"][0]
    assert answer(model, "", "d99999999")["result"] is None
    while model:  # taken apart by hand: dropping it at once would recurse as well
        model = model.pop("a").pop()


@pytest.mark.parametrize("digits", [20, 5000])
def test_absurd_numbers_are_out_of_range(digits):
    number = "9" * digits
    assert evaluated(f"hotList[{number}]", "")["result"] is None
    assert evaluated("hotList", f"a{number}d{number}")["key"] == "hotList"
    assert evaluated(f"hotList[{'0' * digits}]", "")["result"] == {"hot": 1, "cold": 2}


def test_whole_of_a_snapshot_is_not_copied():
    model = {"heat": {"heaters": [None, {"current": 20.0}]}}
    assert answer(model, "heat", "d99vno")["result"] is model["heat"]
    assert answer(model, "heat", "d98vno")["result"] == model["heat"]
    assert answer(model, "heat", "d2vno")["result"] == {"heaters": [None, {}]}
