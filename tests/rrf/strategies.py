"""Hypothesis strategies for what the pure half is fed with."""

import json

from hypothesis import strategies as st

NAMES = st.sampled_from(["a", "b", "current", "x1", "name", "status", "Z"])

NUMBERS = st.one_of(
    st.integers(-5, 5),
    st.floats(-3, 3, allow_nan=False).map(lambda value: round(value, 2)),
)

LEAVES = st.one_of(
    st.none(), st.booleans(), NUMBERS, st.sampled_from(["", "idle", 'a"b', "}{", "°", "ok"])
)


def _containers(children):
    return st.lists(children, max_size=4) | st.dictionaries(NAMES, children, max_size=4)


VALUES = st.recursive(LEAVES, _containers, max_leaves=12)
"""Values as a board may send them, small enough that two of them often share something."""

OBJECTS = st.dictionaries(NAMES, VALUES, max_size=4)

ANY_JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda children: (
        st.lists(children, max_size=4) | st.dictionaries(st.text(), children, max_size=4)
    ),
    max_leaves=12,
)


def compact(value):
    """Return a value as the firmware writes it: no blanks, characters as they are."""
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False)


def model_reply(result, key="", flags="d99fin", **more):
    """Return the text of an answer to M409."""
    return compact({"key": key, "flags": flags, "result": result, **more})
