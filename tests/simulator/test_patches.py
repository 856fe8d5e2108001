"""What the websocket of a single-board computer tells of changes."""

from __future__ import annotations

import copy

import pytest

from octoprint_rrfmodel.simulator.network.sbc.patches import Patches
from tests.simulator.patched import applied

BEFORE = {
    "global": {"a": 1, "b": {"c": [1, 2]}},
    "heat": {"heaters": [{"current": 20.0, "state": "off"}, {"current": 21.0}, None]},
    "job": {"layers": [{"height": 0.2}], "file": {"fileName": None}},
    "messages": [{"content": "one"}],
    "state": {"messageBox": None, "status": "idle", "gpOut": [1, 2]},
    "tools": [{"axes": [[0], [1]]}, {"axes": [[0], [1]]}],
}
CHANGES = {
    "a member": (("state", "status"), "busy", {"state": {"status": "busy"}}),
    "a box opens": (("state", "messageBox"), {"seq": 1}, {"state": {"messageBox": {"seq": 1}}}),
    "plain values": (("state", "gpOut"), [1, 3], {"state": {"gpOut": [1, 3]}}),
    "one of a list": (
        ("heat", "heaters", 1, "current"),
        30.0,
        {"heat": {"heaters": [{}, {"current": 30.0}, None]}},
    ),
    "an empty slot": (("heat", "heaters", 0), None, {"heat": {"heaters": [None, {}, None]}}),
    "one less": (("tools",), [{"axes": [[0], [1]]}], {"tools": [{}]}),
    "lists in a list": (
        ("tools", 0, "axes"),
        [[0], [2]],
        {"tools": [{"axes": [[], [2]]}, {}]},
    ),
    "a message more": (
        ("messages",),
        [{"content": "one"}, {"content": "two"}],
        {"messages": [{"content": "two"}]},
    ),
    "no layers": (("job", "layers"), [], {"job": {"layers": []}}),
    "a variable is gone": (("global",), {"b": {"c": [1, 2]}}, {"global": {"a": None}}),
    "a variable is whole": (("global", "b"), {"c": [1]}, {"global": {"b": {"c": [1]}}}),
}


@pytest.mark.parametrize(("path", "value", "patch"), CHANGES.values(), ids=CHANGES)
def test_a_patch_has_what_has_changed(path, value, patch):
    patches, after = Patches(BEFORE), copy.deepcopy(BEFORE)
    where = after
    for step in path[:-1]:
        where = where[step]
    where[path[-1]] = value
    assert patches.next(after) == patch
    assert applied(BEFORE, patch) == after
    assert patches.next(after) is None


def test_messages_that_have_become_old_are_not_told_again():
    patches, after = Patches(BEFORE), copy.deepcopy(BEFORE)
    after["messages"] = [{"content": "one"}, {"content": "two"}]
    assert patches.next(after) == {"messages": [{"content": "two"}]}
    after["messages"] = [{"content": "two"}]
    assert patches.next(after) is None
    after["messages"] = [{"content": "two"}, {"content": "three"}]
    assert patches.next(after) == {"messages": [{"content": "three"}]}
    after["messages"] = []
    assert patches.next(after) is None


def test_layers_of_the_next_print_come_behind_the_empty_list():
    patches, after = Patches(BEFORE), copy.deepcopy(BEFORE)
    after["job"]["layers"] = [{"height": 0.3}]
    assert patches.next(after) == {"job": {"layers": []}}
    assert patches.next(after) == {"job": {"layers": [{"height": 0.3}]}}
