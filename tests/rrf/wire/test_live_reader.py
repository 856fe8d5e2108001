"""The fast reader of live replies against a full decoding of each."""

import json
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.model.merge import patched
from octoprint_rrfmodel.rrf.wire.live_reader import LiveReader
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply, decode
from tests.support.examples import some

from ..independent import same
from ..strategies import VALUES, compact, model_reply

MEMBERS = st.sampled_from(["state", "heat", "move", "seqs", "a b", "tools", 'x"y', "k:z"])

CONTAINERS = st.lists(VALUES, max_size=3) | st.dictionaries(MEMBERS, VALUES, max_size=3)

RESULTS = st.dictionaries(MEMBERS, CONTAINERS | VALUES, max_size=4)


@st.composite
def successive_results(draw):
    """Results that mostly differ from the one before in a member or two, as a board's do."""
    result = draw(RESULTS)
    results = [result]
    for _ in range(draw(st.integers(1, 6))):
        edit = draw(st.sampled_from(["same", "change", "remove", "add", "reorder", "other"]))
        result = dict(result)
        names = list(result)
        if edit == "other":
            result = draw(RESULTS)
        elif edit == "add" or not names:
            result[draw(MEMBERS)] = draw(CONTAINERS)
        elif edit == "change":
            result[draw(st.sampled_from(names))] = draw(CONTAINERS | VALUES)
        elif edit == "remove":
            del result[draw(st.sampled_from(names))]
        elif edit == "reorder":
            result = {name: result[name] for name in draw(st.permutations(names))}
        results.append(result)
    return results


def read(reader, text):
    """Return what a reader's user gets: the members that changed, or all of them."""
    members = reader.changed(text)
    if members is None:
        members = decode(text).result
        reader.remember(text)
    return members


@settings(max_examples=some(120))
@given(successive_results(), st.sampled_from([compact, json.dumps]))
def test_model_is_the_same_as_with_full_decoding(results, written):
    reader, fast, slow = LiveReader(), {}, {}
    for result in results:
        text = written({"key": "", "flags": "d99fin", "result": result})
        fast, _ = patched(fast, read(reader, text))
        slow, _ = patched(slow, decode(text).result)
        assert same(fast, slow)


@settings(max_examples=some(100))
@given(successive_results(), st.data())
def test_broken_text_is_malformed_or_read_and_harms_nothing(results, data):
    """Texts cut, spoilt or glued in between; what is read after them is right again."""
    reader, fast, slow = LiveReader(), {}, {}
    for result in results:
        text = model_reply(result)
        start = data.draw(st.integers(len(model_reply(None)) - len("null}"), len(text)))
        broken = text[:start] + data.draw(st.sampled_from(["", "\0", "}", "]", ",", "nan", "ok"]))
        if data.draw(st.booleans()):
            broken += text[start + data.draw(st.integers(0, 3)) :]
        try:
            expected = decode(broken)
        except MalformedReply:
            expected = None
        try:
            members = read(reader, broken)
        except MalformedReply:
            members = None
        if expected is None:
            assert members is None
            reader.forget()  # as its user does
        elif members is not None and isinstance(expected.result, dict):
            fast, _ = patched(fast, members)
            slow, _ = patched(slow, expected.result)
            assert same(fast, slow)
        fast, _ = patched(fast, read(reader, text))
        slow, _ = patched(slow, result)
        assert same(fast, slow)


def changes_between(first, second):
    reader = LiveReader()
    reader.remember(model_reply(first))
    return reader.changed(model_reply(second))


SUCCESSIVE = {
    "nothing": ({"a": {"x": 1}, "b": [1]}, {"a": {"x": 1}, "b": [1]}, {}),
    "one member": ({"a": {"x": 1}, "b": [1]}, {"a": {"x": 1}, "b": [2]}, {"b": [2]}),
    "first member": ({"a": {"x": 1}, "b": [1]}, {"a": {"x": 12}, "b": [1]}, {"a": {"x": 12}}),
    "null": ({"a": {"x": 1}, "b": [1]}, {"a": None, "b": [1]}, {"a": None}),
    "braces in a text": ({"a": {"x": ""}, "b": []}, {"a": {"x": '"}},'}, "b": []},
                         {"a": {"x": '"}},'}}),
    "longer number": ({"a": 1, "b": 2}, {"a": 12, "b": 2}, None),
    "number": ({"a": 1, "b": 2}, {"a": 3, "b": 2}, {"a": 3}),
    "name with quotes": ({'a"b': 1, "c:d": 2}, {'a"b': 3, "c:d": 4}, {'a"b': 3, "c:d": 4}),
    "member gone": ({"a": {"x": 1}, "b": [1]}, {"a": {"x": 1}}, None),
    "member new": ({"a": {"x": 1}}, {"a": {"x": 1}, "b": [1]}, None),
    "other order": ({"a": {"x": 1}, "b": [1]}, {"b": [1], "a": {"x": 1}}, None),
    "other name": ({"a": {"x": 1}, "b": [1]}, {"a": {"x": 1}, "c": [1]}, None),
    "all gone": ({"a": {"x": 1}}, {}, None),
}  # fmt: skip


@pytest.mark.parametrize(("first", "second", "members"), SUCCESSIVE.values(), ids=SUCCESSIVE)
def test_only_members_whose_text_differs_are_decoded(first, second, members):
    assert changes_between(first, second) == members


def test_empty_result_twice_is_read():
    reader = LiveReader()
    for _ in range(3):
        assert read(reader, model_reply({})) == {}


@pytest.mark.parametrize("end", ["", "}", "]", ",", ",}", "}}}", "x"])
def test_text_that_ends_between_two_members_is_no_success(end):
    reader = LiveReader()
    text = model_reply({"a": {"x": 1}, "b": {"y": 2}})
    reader.remember(text)
    cut = text[: text.index(',"b"')] + end
    assert reader.changed(cut) is None


def test_nan_in_a_live_reply_is_null():
    reader = LiveReader()
    text = model_reply({"heat": {"x": 1}})
    for _ in range(2):
        assert read(reader, text.replace("1", "nan")) == {"heat": {"x": None}}
    reader.remember(text)
    assert read(reader, text.replace("1", "nan")) == {"heat": {"x": None}}


@pytest.mark.parametrize("number", ["1e999", "9" * 400 + ".0", "-1.5e+400"])
def test_number_that_no_float_holds_is_null_in_a_changed_member_too(number):
    reader = LiveReader()
    text = model_reply({"heat": {"x": 1}, "b": [2]})
    reader.remember(text)
    value = read(reader, text.replace("1", number))["heat"]["x"]
    assert value is None or math.isfinite(value)


def test_nesting_bomb_in_a_changed_member_is_malformed():
    reader = LiveReader()
    text = model_reply({"a": {"x": 1}})
    reader.remember(text)
    with pytest.raises(MalformedReply):
        read(reader, text.replace('{"x":1}', "[" * 100000 + "]" * 100000))
    assert read(reader, text) == {"a": {"x": 1}}


def test_nothing_is_compared_after_forgetting():
    reader = LiveReader()
    text = model_reply({"a": {"x": 1}})
    reader.remember(text)
    reader.forget()
    assert reader.changed(text) is None


@pytest.mark.parametrize(
    "text",
    [
        '{"key":"","flags":"d99fin","result":null}',
        '{"key":"","flags":"d99fin","result":[],"next":0}',
        '{"key":"","flags":"d99fin","result": {"a":1}}',
        '{"key":"","flags":"d99fin","result":{"a": 1}}',
    ],
)
def test_what_is_not_built_like_a_live_root_is_left_to_full_decoding(text):
    reader = LiveReader()
    reader.remember(text)
    assert reader.changed(text) is None
