import copy
import json

import pytest

from octoprint_rrfmodel.rrf.model.frozen import frozen

VALUE = {"heat": {"heaters": [{"current": 21.5}, None]}, "name": "Duet"}

CHANGES = {
    "item": lambda value: value.__setitem__("name", 1),
    "del": lambda value: value.__delitem__("name"),
    "update": lambda value: value.update(a=1),
    "pop": lambda value: value.pop("name"),
    "popitem": lambda value: value.popitem(),
    "clear": lambda value: value.clear(),
    "setdefault": lambda value: value.setdefault("a", 1),
    "deep item": lambda value: value["heat"]["heaters"][0].__setitem__("current", 1),
    "list item": lambda value: value["heat"]["heaters"].__setitem__(0, 1),
    "append": lambda value: value["heat"]["heaters"].append(1),
    "extend": lambda value: value["heat"]["heaters"].extend([1]),
    "insert": lambda value: value["heat"]["heaters"].insert(0, 1),
    "remove": lambda value: value["heat"]["heaters"].remove(None),
    "sort": lambda value: value["heat"]["heaters"].sort(),
    "reverse": lambda value: value["heat"]["heaters"].reverse(),
    "add": lambda value: value["heat"]["heaters"].__iadd__([1]),
}


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_refuses_every_change(change):
    value = frozen(VALUE)
    with pytest.raises(TypeError, match="snapshot"):
        change(value)
    assert value == VALUE


def test_is_equal_and_json_takes_it():
    value = frozen(VALUE)
    assert value == VALUE
    assert isinstance(value["heat"]["heaters"], list)
    assert json.loads(json.dumps(value)) == VALUE


def test_does_not_freeze_what_it_was_made_of():
    source = {"a": [1]}
    value = frozen(source)
    source["a"].append(2)
    assert value == {"a": [1]}


def test_deep_copy_can_be_changed():
    value = copy.deepcopy(frozen(VALUE))
    value["heat"]["heaters"].append({})
    assert value["heat"]["heaters"] == [{"current": 21.5}, None, {}]


def test_copy_of_the_top_can_be_changed():
    value = dict(frozen(VALUE))
    value["name"] = "other"
    assert value["name"] == "other"
    assert VALUE["name"] == "Duet"
