"""The store: what is known, snapshots, and the number of changes."""

import copy

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.model.merge import DEEPEST, NestedTooDeep, paths
from octoprint_rrfmodel.rrf.model.store import ModelStore
from tests.support.examples import some

from ..independent import differing, overlaid, same
from ..strategies import OBJECTS, VALUES


@pytest.fixture
def store():
    store = ModelStore()
    store.patch(
        {"move": {"axes": [{"letter": "X"}], "idle": {"timeout": 30}}, "heat": {"heaters": []}}
    )
    return store


def test_nothing_is_known_at_first():
    assert ModelStore().model == {}
    assert ModelStore().revision == 0


def test_patch_adds_to_what_is_known(store):
    changes = store.patch({"move": {"idle": {"factor": 0.3}}})
    assert store.model["move"]["idle"] == {"timeout": 30, "factor": 0.3}
    assert list(paths(changes)) == ["move.idle.factor"]
    assert store.revision == 2


def test_patch_that_changes_nothing_is_no_revision(store):
    snapshot = store.model
    assert store.patch({"move": {"axes": [{}]}}) == {}
    assert store.model is snapshot
    assert store.revision == 1


@pytest.mark.parametrize(
    ("path", "value", "changed"),
    [
        ("move", {"axes": []}, ["move.axes[0]", "move.idle"]),
        ("move.axes", [{"letter": "X"}, {"letter": "Y"}], ["move.axes[1]"]),
        ("move.idle.timeout", 20, ["move.idle.timeout"]),
        ("global", {"a": [1]}, ["global"]),
        ("global", None, ["global"]),
        ("global", {}, ["global"]),
        ("job.file.size", 5, ["job.file.size"]),
        ("heat.heaters", [], []),
        ("heat.heaters.x", 1, ["heat.heaters.x"]),
    ],
)
def test_replacement_takes_the_place_of_what_was_there(store, path, value, changed):
    before = store.model
    changes = store.replace(path, value)
    assert sorted(paths(changes)) == changed
    known = store.model
    for name in path.split("."):
        known = known[name]
    assert known == value
    assert (store.model is before) is (not changed)
    assert store.revision == (2 if changed else 1)
    assert {**store.model, path.partition(".")[0]: 0} == {**before, path.partition(".")[0]: 0}


@pytest.mark.parametrize("path", ["move", "move.idle", "global", "global.a.b"])
def test_too_deep_a_value_leaves_all_as_it_was(store, path):
    deep = 1
    for _ in range(DEEPEST + 1):
        deep = [deep]
    before, kept = store.model, copy.deepcopy(store.model)
    with pytest.raises(NestedTooDeep):
        store.replace(path, deep)
    with pytest.raises(NestedTooDeep):
        store.patch({"state": {"a": 1}, "move": {"x": deep}})
    assert store.model is before
    assert before == kept
    assert store.revision == 1


def test_forgetting_is_a_change_only_where_something_was_known(store):
    store.forget()
    assert (store.model, store.revision) == ({}, 2)
    store.forget()
    assert store.revision == 2


@settings(max_examples=some(100))
@given(
    st.lists(
        st.tuples(st.none() | st.sampled_from(["a", "a.b", "Z.a.b"]), OBJECTS | VALUES), max_size=6
    )
)
def test_changes_are_what_differs_and_snapshots_stay(steps):
    store = ModelStore()
    for path, value in steps:
        before, kept, revision = store.model, copy.deepcopy(store.model), store.revision
        if path is None:
            value = value if isinstance(value, dict) else {"a": value}
            changes = store.patch(value)
            assert same(store.model, overlaid(kept, value))
        else:
            changes = store.replace(path, value)
        told = sorted(paths(changes))
        assert same(before, kept)
        assert (store.revision > revision) is bool(told)
        found = sorted(differing(kept, store.model))
        # where a parent was made, or took the place of something else, the parent changed
        assert all(any(one.startswith(other) for other in found) for one in told)
        assert bool(found) is bool(told)
