"""Keys taken apart: the values are those of M409, and the snapshot's own."""

import copy

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.model.keys import Key, MalformedKey, value_at
from octoprint_rrfmodel.rrf.model.m409 import answer
from octoprint_rrfmodel.rrf.model.merge import patched, replaced
from tests.support.examples import some

from ..independent import same
from ..strategies import NAMES, OBJECTS

MODEL = {
    "heat": {"heaters": [{"current": 20.5}, {"current": 205.0, "state": "active"}]},
    "tools": [None, {"number": 1, "heaters": [1, 2]}, {"number": 2}],
    "state": {"status": "idle", "messageBox": None, "name": 'Prüf"kopf'},
    "grid": [[1, 2], [3], []],
}

VALUES = [
    ("", MODEL),
    ("state.status", "idle"),
    ("state.", MODEL["state"]),
    ("heat.heaters[1].current", 205.0),
    ("heat.heaters[ +01].current", 205.0),
    ("heat.heaters[].current", [20.5, 205.0]),
    ("heat.heaters[].state", [None, "active"]),
    ("heat.heaters[]", MODEL["heat"]["heaters"]),
    ("tools[].number", [None, 1, 2]),
    ("tools[].heaters[]", [None, [1, 2], None]),
    ("tools[1].heaters[0]", 1),
    ("grid[][0]", [1, 3, None]),
    ("grid[][]", MODEL["grid"]),
    ("state.messageBox", None),
    ("#tools", 3),
    ("#state.name", 10),
    ("#grid[]", [2, 1, 0]),
    ("#state.", {"status": 4, "messageBox": None, "name": 10}),
    ("#", {"heat": None, "tools": 3, "state": None, "grid": 3}),
]

NOTHING = [
    "nosuch",
    "state.nosuch",
    "state.messageBox.mode",
    "state[0]",
    "state[].status",
    "heat.heaters[2].current",
    "heat.heaters[-1].current",
    "heat.heaters.current",
    "heat.heaters.",
    "#state",
    "#heat.heaters[0].current",
]

MALFORMED = [
    ".",
    ".state",
    "state..status",
    "state^",
    "heat.heaters[",
    "heat.heaters[x]",
    "heat.heaters[1 ]",
    "heat.heaters[1",
    "heat.heaters[0]current",
    "heat.heaters[]current",
    "heat.[0]",
    "[0]",
    "[]",
    "heat.heaters[" + "9" * 30 + "]",
    "heat.heaters[\u0661]",
]


@pytest.mark.parametrize(("key", "value"), VALUES)
def test_value(key, value):
    assert value_at(MODEL, key, "nothing") == value
    assert answer(MODEL, key, "d99vno")["result"] == value


@pytest.mark.parametrize("key", NOTHING)
def test_default_where_there_is_nothing(key):
    assert value_at(MODEL, key, "nothing") == "nothing"
    assert value_at(MODEL, key) is None
    assert answer(MODEL, key, "d99vno")["result"] is None


@pytest.mark.parametrize("text", MALFORMED)
def test_malformed_key(text):
    with pytest.raises(MalformedKey, match="is no key: "):
        Key(text)
    assert value_at(MODEL, text, "nothing") == "nothing"


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("", MODEL),
        ("state", MODEL["state"]),
        ("tools", MODEL["tools"]),
        ("tools[]", MODEL["tools"]),
        ("tools[1]", MODEL["tools"][1]),
        ("grid[0]", MODEL["grid"][0]),
    ],
)
def test_nothing_is_copied(key, value):
    assert value_at(MODEL, key) is value


PARTS = st.one_of(NAMES.map(lambda name: f".{name}"), st.sampled_from(["[]", "[0]", "[1]", "."]))
KEYS = st.one_of(
    st.builds(
        lambda sign, first, rest: sign + first + "".join(rest),
        st.sampled_from(["", "", "#"]),
        NAMES,
        st.lists(PARTS, max_size=4),
    ),
    st.sampled_from(["", "#"]),
    st.text(st.sampled_from("ab.[]^#*01 -+"), max_size=12),
)


def is_nothing(value):
    return value is None or (isinstance(value, list) and all(map(is_nothing, value)))


@settings(max_examples=some(300))
@given(OBJECTS, KEYS)
def test_values_are_those_of_m409(model, key):
    expected = answer(model, key, "d99vno")["result"]
    before = copy.deepcopy(model)
    try:
        value = Key(key).value(model)
    except MalformedKey:
        assert is_nothing(expected)
    else:
        assert same(value, expected)
    assert model == before


TOUCHES = [
    ("", {"a": True}, True),
    ("a", {"a": True}, True),
    ("a", {"b": True}, False),
    ("a.b", {"a": True}, True),
    ("a.b", {"a": {"b": True}}, True),
    ("a.b", {"a": {"c": True}}, False),
    ("a.b", {"a": {"b": {"c": True}}}, True),
    ("a[0]", {"a": {0: True}}, True),
    ("a[0]", {"a": {1: True}}, False),
    ("a[].b", {"a": {1: {"b": True}}}, True),
    ("a[].b", {"a": {1: {"c": True}}}, False),
    ("a[].b", {"a": {1: {"c": True}, 2: True}}, True),
    ("a[]", {"a": {1: {"c": True}}}, True),
    ("a.", {"a": {"c": True}}, True),
    ("#a", {"a": {3: True}}, True),
    ("#a", {"b": True}, False),
    ("a.b", True, True),
    ("", {}, False),
    ("a", {}, False),
    ("a", None, False),
]


@pytest.mark.parametrize(("key", "changes", "touches"), TOUCHES)
def test_touches(key, changes, touches):
    assert Key(key).touches(changes) is touches


@settings(max_examples=some(300))
@given(OBJECTS, OBJECTS, KEYS, st.sampled_from([patched, replaced]))
def test_what_is_another_is_touched(old, new, text, merge):
    try:
        key = Key(text)
    except MalformedKey:
        return
    after, changes = merge(old, new)
    if not same(key.value(old), key.value(after)):
        assert key.touches(changes)


class Counting(str):
    """A text that counts the letters that are copied out of it."""

    copied = 0

    def __getitem__(self, place):
        found = super().__getitem__(place)
        Counting.copied += len(found)
        return Counting(found)


@pytest.mark.parametrize("piece", [".a", "[0]", "[]", ".a[1][]"])
def test_a_long_key_is_gone_through_once(piece):
    text = Counting("a" + piece * 10_000)
    Counting.copied = 0
    Key(text)
    assert Counting.copied < 4 * len(text)
