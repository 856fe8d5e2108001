"""Texts turned into values; what can't be is a ``MalformedReply``, and nothing else is raised."""

import json
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.wire.reply import (
    MalformedReply,
    ModelReply,
    NoBuffers,
    StatusReply,
    decode,
)
from tests.support.examples import some

from ..strategies import ANY_JSON, compact, model_reply

READ = {
    "object": ('{"key":"heat","flags":"d99vn","result":{}}', ModelReply("heat", "d99vn", {}, 0)),
    "length": ('{"key":"#tools","flags":"","result":2}', ModelReply("#tools", "", 2, 0)),
    "null": ('{"key":"x","flags":"","result":null}', ModelReply("x", "", None, 0)),
    "page": ('{"key":"t","flags":"a2","result":[1],"next":3}', ModelReply("t", "a2", [1], 3)),
    "last page": ('{"key":"t","flags":"","result":[],"next":0}', ModelReply("t", "", [], 0)),
    "SBC": (
        '{"key":"network","result":{"name":"x"}}',
        ModelReply("network", None, {"name": "x"}, 0),
    ),
    "escapes": (
        '{"key":"a\\"b","flags":"\\\\","result":"\\r\\n\\t/\\/"}',
        ModelReply('a"b', "\\", "\r\n\t//", 0),
    ),
    "other members": (
        '{"key":"","flags":"","more":[],"result":{}}',
        ModelReply("", "", {}, 0),
    ),
    "no buffers": ('{"err":-1}', NoBuffers()),
    "status": ('{"status":"I","time":53.0}', StatusReply({"status": "I", "time": 53.0})),
    "config": (
        '{"axisMins":[0.00], "sysdir":"0:/"}',
        StatusReply({"axisMins": [0], "sysdir": "0:/"}),
    ),
}

BROKEN = {
    "empty": "",
    "text": "ok",
    "cut": '{"key":"heat","flags":"d99vn","result":{"beds":[',
    "spoilt number": '{"status":"I","machine":[150.000 ,150.005.000]}',
    "NUL byte": '{"status":"I","name":"a\0b"}',
    "two replies": '{"key":"","flags":"","result":1}{"key":"","flags":"","result":1}',
    "ok behind": '{"status":"I"}ok',
    "no result": '{"key":"","flags":""}',
    "key that is none": '{"key":1,"flags":"","result":1}',
    "null for a key": '{"key":null,"flags":"","result":1}',
    "flags that are none": '{"key":"","flags":[],"result":1}',
    "next that is none": '{"key":"","flags":"","result":[],"next":"3"}',
    "next that is a fraction": '{"key":"","flags":"","result":[],"next":1.5}',
    "next that is true": '{"key":"","flags":"","result":[],"next":true}',
    "list": "[1]",
    "nan that ends": '{"status":nan',
    "nan for a name": "{nan:1}",
    "member without a value": '{"key":"","flags":"","result":}',
}

NUMBERS = [
    ("0", 0),
    ("0.0", 0.0),
    ("-0.000", 0.0),
    ("150.000", 150.0),
    ("-1234567.5000000", -1234567.5),
    ("1.0e+19", 1.0e19),
    ("1.0e19", 1.0e19),
    ("3.4e+38", 3.4e38),
    ("1e99", 1e99),
    ("1e-999", 0.0),
    ("1e999", None),
    ("-1e999", None),
    ("1E+9999", None),
    ("1.5e0000000999", None),
    ("9" * 400 + ".0", None),
    ("9007199254740993", 9007199254740993),
    ("9" * 400, int("9" * 400)),
    ("nan", None),
    ("-nan", None),
    ("NaN", None),
    ("inf", None),
    ("-inf", None),
    ("Infinity", None),
    ("-Infinity", None),
]


@pytest.mark.parametrize(("text", "expected"), READ.values(), ids=READ)
def test_reply_is_read(text, expected):
    reply = decode(text)
    assert reply == expected
    assert type(reply) is type(expected)


@pytest.mark.parametrize("text", BROKEN.values(), ids=BROKEN)
def test_broken_reply_says_what_is_wrong(text):
    with pytest.raises(MalformedReply) as error:
        decode(text)
    assert len(str(error.value)) < 250


@pytest.mark.parametrize("form", ["[{}]", '{{"a":{}}}', '{{"a":"}}nan{{","b":{}}}', "{}"])
@pytest.mark.parametrize(("text", "value"), NUMBERS, ids=[text[:20] for text, _ in NUMBERS])
def test_number_is_read_or_null(text, value, form):
    """``nan`` and the like come from M408; a value that no float can hold is null as well."""
    expected = {
        "[{}]": [value],
        '{{"a":{}}}': {"a": value},
        '{{"a":"}}nan{{","b":{}}}': {"a": "}nan{", "b": value},
        "{}": value,
    }[form]
    assert decode('{"status":"I","x":' + form.format(text) + "}").fields["x"] == expected
    assert decode('{"key":"","flags":"","result":' + form.format(text) + "}").result == expected


def test_number_with_more_digits_than_python_converts_is_malformed():
    with pytest.raises(MalformedReply):
        decode('{"status":"I","x":' + "9" * 5000 + "}")


def test_words_that_stand_in_a_text_stay():
    text = '{"status":"I","name":"nan -inf \\"nan\\" 1e999","x":nan}'
    assert decode(text).fields == {"status": "I", "name": 'nan -inf "nan" 1e999', "x": None}


def test_characters_come_as_they_are():
    name = "25°C \ufffd \xb0 €\U0001f600"
    assert decode(model_reply({"name": name})).result == {"name": name}


@settings(max_examples=some(150))
@given(st.text() | st.text('{}[]":,0.e-+nafiky\\', max_size=60))
def test_any_text_is_read_or_malformed(text):
    for candidate in (text, '{"key":' + text, '{"status":"I","x":' + text + "}"):
        try:
            reply = decode(candidate)
        except MalformedReply:
            continue
        assert isinstance(reply, (ModelReply, StatusReply, NoBuffers))


def finite(value):
    """Return whether no number in a value is infinite or none."""
    if isinstance(value, dict):
        return all(map(finite, value.values()))
    if isinstance(value, list):
        return all(map(finite, value))
    return not isinstance(value, float) or math.isfinite(value)


@settings(max_examples=some(100))
@given(ANY_JSON)
def test_no_number_that_json_lacks_gets_in(value):
    reply = decode(json.dumps({"key": "", "flags": "", "result": value}, separators=(",", ":")))
    assert finite(reply.result)


@settings(max_examples=some(100))
@given(
    st.dictionaries(
        st.from_regex("[a-zA-Z_.]+", fullmatch=True), st.integers() | st.text(), max_size=4
    )
)
def test_status_members_come_as_they_are(members):
    fields = {"status": "I", **members}
    if "key" not in fields:
        assert decode(compact(fields)) == StatusReply(fields)
