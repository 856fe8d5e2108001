"""Replies laid over a model: the rules, what is shared, and what is said to have changed."""

import copy

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.model.merge import DEEPEST, NestedTooDeep, patched, paths, replaced
from tests.support.examples import some

from ..independent import differing, overlaid, same
from ..strategies import NUMBERS, OBJECTS, VALUES

# what is known, what comes, the result of a patch, the result of a replacement, changed paths
# of the patch, changed paths of the replacement
RULES = {
    "equal": ({"a": 1}, {"a": 1}, {"a": 1}, {"a": 1}, [], []),
    "other value": ({"a": 1}, {"a": 2}, {"a": 2}, {"a": 2}, ["a"], ["a"]),
    "member that is absent": ({"a": 1, "b": 2}, {"a": 1}, {"a": 1, "b": 2}, {"a": 1}, [], ["b"]),
    "nothing": ({"a": 1}, {}, {"a": 1}, {}, [], ["a"]),
    "new member": ({"a": 1}, {"b": 2}, {"a": 1, "b": 2}, {"b": 2}, ["b"], ["a", "b"]),
    "null is a value": ({"a": 1}, {"a": None}, {"a": None}, {"a": None}, ["a"], ["a"]),
    "null that is known": ({"a": None}, {"a": None}, {"a": None}, {"a": None}, [], []),
    "value for null": ({"a": None}, {"a": 0}, {"a": 0}, {"a": 0}, ["a"], ["a"]),
    "null for an object": ({"a": {"b": 1}}, {"a": None}, {"a": None}, {"a": None}, ["a"], ["a"]),
    "object for null": ({"a": None}, {"a": {"b": 1}}, {"a": {"b": 1}}, {"a": {"b": 1}},
                        ["a"], ["a"]),
    "true is not 1": ({"a": 1}, {"a": True}, {"a": True}, {"a": True}, ["a"], ["a"]),
    "0 is not false": ({"a": False}, {"a": 0}, {"a": 0}, {"a": 0}, ["a"], ["a"]),
    "0 is 0.0": ({"a": 0.0}, {"a": 0}, {"a": 0.0}, {"a": 0.0}, [], []),
    "true in a list": ([1, 0], [True, 0.0], [True, 0], [True, 0], ["[0]"], ["[0]"]),
    "nested": (
        {"heat": {"heaters": [{"current": 20, "max": 285}]}},
        {"heat": {"heaters": [{"current": 21}]}},
        {"heat": {"heaters": [{"current": 21, "max": 285}]}},
        {"heat": {"heaters": [{"current": 21}]}},
        ["heat.heaters[0].current"],
        ["heat.heaters[0].current", "heat.heaters[0].max"],
    ),
    "list grows": ([1], [1, 2, 3], [1, 2, 3], [1, 2, 3], ["[1]", "[2]"], ["[1]", "[2]"]),
    "list shrinks": ([1, 2, 3], [1], [1], [1], ["[1]", "[2]"], ["[1]", "[2]"]),
    "list gets empty": ([1, {"a": 1}], [], [], [], ["[0]", "[1]"], ["[0]", "[1]"]),
    "list shrinks and changes": ([1, 2], [3], [3], [3], ["[0]", "[1]"], ["[0]", "[1]"]),
    "slot gets empty": ([{"a": 1}, {"a": 2}], [None, {}], [None, {"a": 2}], [None, {}],
                        ["[0]"], ["[0]", "[1].a"]),
    "slot is filled": ([None], [{"a": 1}], [{"a": 1}], [{"a": 1}], ["[0]"], ["[0]"]),
    "element unchanged": ([{"a": 1}, {"a": 2}], [{}, {"a": 3}],
                          [{"a": 1}, {"a": 3}], [{}, {"a": 3}],
                          ["[1].a"], ["[0].a", "[1].a"]),
    "lists in lists": ([[1, 2], [3]], [[1], [3, 4]], [[1], [3, 4]], [[1], [3, 4]],
                       ["[0][1]", "[1][1]"], ["[0][1]", "[1][1]"]),
    "list for an object": ({"a": {}}, {"a": []}, {"a": []}, {"a": []}, ["a"], ["a"]),
    "object for a list": ({"a": []}, {"a": {}}, {"a": {}}, {"a": {}}, ["a"], ["a"]),
    "text for a number": ({"a": 1}, {"a": "1"}, {"a": "1"}, {"a": "1"}, ["a"], ["a"]),
    "other kinematics": (
        {"kinematics": {"name": "coreXY", "forwardMatrix": [[1]]}},
        {"kinematics": {"name": "delta", "towers": [{"xPos": 1}]}},
        {"kinematics": {"name": "delta", "forwardMatrix": [[1]], "towers": [{"xPos": 1}]}},
        {"kinematics": {"name": "delta", "towers": [{"xPos": 1}]}},
        ["kinematics.name", "kinematics.towers"],
        ["kinematics.forwardMatrix", "kinematics.name", "kinematics.towers"],
    ),
}  # fmt: skip


@pytest.mark.parametrize(
    ("old", "new", "patch", "whole", "patch_paths", "whole_paths"), RULES.values(), ids=RULES
)
def test_rule(old, new, patch, whole, patch_paths, whole_paths):
    for merge, expected, changed in ((patched, patch, patch_paths), (replaced, whole, whole_paths)):
        value, changes = merge(old, new)
        assert same(value, expected)
        assert sorted(paths(changes)) == changed
        if not changed:
            assert value is old
            assert changes is None


def test_value_that_changed_as_a_whole_has_the_path_it_is_at():
    assert list(paths(True)) == [""]
    assert list(paths(True, "move.axes")) == ["move.axes"]
    assert list(paths(None, "move")) == []


def test_members_of_a_replacement_come_in_its_own_order():
    value, _ = replaced({"a": 1, "b": 2, "c": 3}, {"c": 3, "x": 0, "a": 5})
    assert list(value) == ["c", "x", "a"]


def test_unchanged_parts_are_the_same_objects():
    old = {"heat": {"heaters": [{"current": 1}, {"current": 2}]}, "move": {"axes": [{}]}}
    value, _ = patched(
        old, {"heat": {"heaters": [{"current": 1}, {"current": 3}]}, "move": {"axes": [{}]}}
    )
    assert value["move"] is old["move"]
    assert value["heat"] is not old["heat"]
    assert value["heat"]["heaters"][0] is old["heat"]["heaters"][0]


def shared_where_equal(old, new):
    """Return whether each part of ``new`` that is as in ``old`` is the same object."""
    if type(old) is not type(new) or not isinstance(old, (dict, list)):
        return True
    if same(old, new):
        return old is new
    if isinstance(old, dict):
        return all(shared_where_equal(old[name], new[name]) for name in old.keys() & new.keys())
    return all(map(shared_where_equal, old, new))


@settings(max_examples=some(150))
@given(VALUES, VALUES)
def test_patch_is_what_a_plain_merge_gives(old, new):
    before = copy.deepcopy((old, new))
    value, changes = patched(old, new)
    assert same(value, overlaid(old, new))
    assert sorted(paths(changes)) == sorted(differing(old, value))
    assert shared_where_equal(old, value)
    assert repr((old, new)) == repr(before), "what is handed in is not changed"


@settings(max_examples=some(150))
@given(VALUES, VALUES)
def test_replacement_is_what_came(old, new):
    before = copy.deepcopy((old, new))
    value, changes = replaced(old, new)
    assert same(value, new)
    assert sorted(paths(changes)) == sorted(differing(old, new))
    assert shared_where_equal(old, value)
    assert repr((old, new)) == repr(before)


@settings(max_examples=some(100))
@given(OBJECTS, VALUES)
def test_merging_once_more_changes_nothing(old, new):
    for merge in (patched, replaced):
        value, _ = merge(old, new)
        assert merge(value, new) == (value, None)
        assert merge(value, new)[0] is value


@settings(max_examples=some(100))
@given(st.lists(OBJECTS, min_size=1, max_size=5))
def test_snapshots_stay_as_they_were(patches):
    model, snapshots = {}, []
    for patch in patches:
        model, _ = patched(model, patch)
        snapshots.append((model, copy.deepcopy(model)))
    assert all(repr(kept) == repr(then) for kept, then in snapshots)


def nested(levels, leaf=1, of=dict):
    value = leaf
    for _ in range(levels):
        value = {"a": value} if of is dict else [value]
    return value


@pytest.mark.parametrize("merge", [patched, replaced], ids=["patch", "replacement"])
@pytest.mark.parametrize("of", [dict, list])
@pytest.mark.parametrize(
    "old",
    [{}, {"a": 1}, [], [1], None, {"a": {"a": {}}}, [[[]]], nested(DEEPEST, 2)],
    ids=lambda value: repr(value)[:20],
)
def test_too_many_levels_are_refused_whatever_is_known(merge, of, old):
    assert same(merge([], nested(DEEPEST, of=of))[0], nested(DEEPEST, of=of))
    with pytest.raises(NestedTooDeep):
        merge(old, nested(DEEPEST + 1, of=of))
    with pytest.raises(NestedTooDeep):
        merge(old, nested(DEEPEST + 1, {}, of=of))
    with pytest.raises(NestedTooDeep):
        merge({"x": old}, {"x": nested(100000, of=of)})


@pytest.mark.parametrize("merge", [patched, replaced], ids=["patch", "replacement"])
@pytest.mark.parametrize("leaf", [1, {}, []], ids=repr)
@pytest.mark.parametrize("levels", range(DEEPEST - 3, DEEPEST + 3))
def test_what_was_taken_once_can_be_taken_again(merge, leaf, levels):
    new = {"x": nested(levels, leaf)}
    try:
        value, _ = merge({}, new)
    except NestedTooDeep:
        assert levels >= DEEPEST - 1, "the object around it and an empty one in it count too"
        return
    assert merge(value, copy.deepcopy(new)) == (value, None)


@given(NUMBERS)
def test_equal_number_of_another_type_is_no_change(number):
    assert patched({"a": number}, {"a": float(number)})[1] is None
