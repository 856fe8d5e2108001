"""What DSF tells, as a board tells it: patches, counters, messages."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.model import dsf
from octoprint_rrfmodel.rrf.model.m409 import answer
from tests.simulator.patched import applied

WHOLE = {
    "global": {"a": 1, "b": {"c": [1, 2]}},
    "heat": {"heaters": [{"current": 20.0, "state": "off", "max": 200}, {"current": 21.0}, None]},
    "job": {"layers": [{"height": 0.2}], "file": {"fileName": None}},
    "messages": [{"content": "old", "type": 0}],
    "plugins": {"Other": {"data": {"token": "x"}}},
    "sbc": {"dsf": {"version": "3.5.3"}},
    "state": {"messageBox": None, "status": "idle", "gpOut": [1, 2]},
    "tools": [{"axes": [[0], [1]]}, {"axes": [[0], [1]]}],
    "volumes": [{"freeSpace": 10, "mounted": True}],
}


@pytest.fixture
def told():
    return dsf.begun(WHOLE)


def test_what_no_board_has_is_left_out(told):
    assert set(told.model) == {"global", "heat", "job", "state", "tools", "volumes", "seqs"}
    assert told.model["job"] == {"file": {"fileName": None}}
    patch = {"plugins": {"Other": {"data": {"token": "y"}}}, "job": {"layers": [{}]}}
    assert "plugins" not in dsf.after(told, patch).model
    assert dsf.after(told, patch).model["job"] == {"file": {"fileName": None}}


PATCHES = {
    "a live member": ({"state": {"status": "busy"}}, ()),
    "a live member of a list": ({"heat": {"heaters": [{}, {"current": 22.0}, None]}}, ()),
    "one that isn't live": ({"heat": {"heaters": [{"max": 210}, {}, None]}}, ("heat",)),
    "an element is gone": ({"tools": [{}]}, ("tools",)),
    "an element is new": ({"tools": [{}, {}, {"axes": []}]}, ("tools",)),
    "an empty slot": ({"heat": {"heaters": [{}, None, None]}}, ("heat",)),
    "a slot is filled": ({"heat": {"heaters": [{}, {}, {"current": 3.0}]}}, ("heat",)),
    "lists of lists": ({"tools": [{"axes": [[], [2]]}, {}]}, ("tools",)),
    "plain values": ({"state": {"gpOut": [1, 3]}}, None),
    "a variable": ({"global": {"b": {"c": [3]}}}, ("global",)),
    "a variable is gone": ({"global": {"a": None}}, ("global",)),
    "free space": ({"volumes": [{"freeSpace": 9}]}, ()),
    "the card is out": ({"volumes": [{"freeSpace": None, "mounted": False}]}, ("volumes",)),
    "a key is new": ({"move": {"axes": []}}, ("move",)),
}


@pytest.mark.parametrize(("patch", "moved"), PATCHES.values(), ids=PATCHES)
def test_patches_are_laid_over_the_model(told, patch, moved):
    then = dsf.after(told, patch)
    expected = {
        key: value
        for key, value in applied(WHOLE, patch).items()
        if key not in ("messages", "plugins", "sbc")
    }
    expected["job"] = {"file": {"fileName": None}}
    before, now = told.model["seqs"], then.model["seqs"]
    assert {key: value for key, value in then.model.items() if key != "seqs"} == expected
    if moved is not None:
        assert [key for key in now if now[key] != before.get(key)] == list(moved)
    # what somebody has kept is as it was
    assert told == dsf.begun(WHOLE)


def deep(levels):
    return {} if not levels else {"a": deep(levels - 1)}


BAD = {
    "no object": [1],
    "unchanged and not known": {"tools": [{}, {}, {}]},
    "unchanged in an empty slot": {"heat": {"heaters": [{}, {}, {}]}},
    "another kind": {"heat": {"heaters": {"current": 1}}},
    "a key of another kind": {"tools": {"0": {}}},
    "deeper than any model": {"state": {"x": deep(60)}},
    "deeper, in what is known": {"state": deep(60)},
    "a variable that is deeper": {"global": {"x": deep(60)}},
}


@pytest.mark.parametrize("patch", BAD.values(), ids=BAD)
def test_what_does_not_fit_is_told(told, patch):
    with pytest.raises(dsf.Unpatchable):
        dsf.after(told, patch)


@pytest.mark.parametrize("whole", [None, [], {}, {"state": None}, {"state": deep(60)}])
def test_what_is_no_model_is_told(whole):
    with pytest.raises(dsf.Unpatchable):
        dsf.begun(whole)


def test_messages_are_told_once_and_in_a_boards_words(told):
    assert told.messages == ()
    said = [{"content": "a", "type": 2}, {"content": "b", "type": 1}, {"content": " ", "type": 0}]
    then = dsf.after(told, {"messages": said})
    assert then.messages == ("Error: a", "Warning: b")
    assert dsf.after(then, {"state": {"status": "busy"}}).messages == ()
    # said while nobody listened
    missed = {"content": "c", "type": 0}
    again = dsf.begun({**WHOLE, "messages": [*WHOLE["messages"], *said, missed]}, then)
    assert again.messages == ("c",)


def test_nonsense_among_messages_is_left_out(told):
    nonsense = [None, {"content": 5}, {"content": "x", "type": "y"}, {"content": "y", "type": 9}]
    assert dsf.after(told, {"messages": nonsense}).messages == ("x", "y")
    assert dsf.after(told, {"messages": None}).messages == ()


def test_a_whole_model_moves_all_counters_on(told):
    again = dsf.begun(WHOLE, told).model["seqs"]
    assert all(again[key] > told.model["seqs"][key] for key in again if key != "volChanges")
    assert dsf.with_another_card(told).model["seqs"]["volChanges"] == [1]


NAMES = st.sampled_from(
    ["heat", "heaters", "global", "job", "messages", "state", "tools", "volumes"]
)
ANYTHING = st.recursive(
    st.none() | st.booleans() | st.floats() | st.text(max_size=3),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(NAMES, inner, max_size=3),
    max_leaves=12,
)


@given(st.lists(ANYTHING, max_size=4))
def test_whatever_comes_is_a_model_or_none(patches):
    told = dsf.begun(WHOLE)
    for patch in patches:
        before = json.dumps(told)
        try:
            then = dsf.after(told, patch)
        except dsf.Unpatchable:
            continue
        assert json.dumps(told) == before
        assert "messages" not in then.model and then.model["seqs"]
        answer(then.model, "", "d99fin")
        told = then


def followed(follower, told):
    """Let a follower ask until it has nothing to ask but live values."""
    for _ in range(40):
        request = follower.next_request()
        is_live = request.key == "" and follower.ready and not follower.behind
        follower.take(json.dumps(answer(told.model, request.key, request.flags)))
        if is_live and not follower.behind:
            return
    raise AssertionError("it doesn't come to an end")


def test_a_recorded_session_is_followed_as_a_board_is(shared_dir):
    lines = (shared_dir / "captures" / "om345_mb6hc_sbc_job_session.jsonl").read_text("utf-8")
    whole, *patches = [json.loads(line) for line in lines.splitlines()]
    told, follower, expected = dsf.begun(whole), Follower(), whole
    said = []
    for patch in patches:
        followed(follower, told)
        late = {"volumes": None}
        assert {**follower.store.model, **late} == {**told.model, **late}
        told, expected = dsf.after(told, patch), applied(expected, patch)
        said += told.messages
        kept = {key: value for key, value in expected.items() if key not in dsf.LEFT_OUT}
        kept["job"] = {name: each for name, each in kept["job"].items() if name != "layers"}
        # the recording's own oddities are those of both
        assert {**told.model, "seqs": None} == {**kept, "seqs": None}
    followed(follower, dsf.with_another_card(told))
    assert follower.store.model["volumes"] == told.model["volumes"]
    assert follower.resets == 0
    assert [text.partition(" ")[0] for text in said] == ["Resume", "Cancelled"]
    moved = sum(value for value in told.model["seqs"].values() if type(value) is int)
    assert moved < len(patches) / 4, "what is live is no reason to fetch a key"
