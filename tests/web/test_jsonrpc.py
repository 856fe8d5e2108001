"""JSON-RPC 2.0: the specification's own cases, and what a hostile client sends."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from octoprint_rrfmodel.web.moonraker import jsonrpc
from octoprint_rrfmodel.web.moonraker.jsonrpc import RpcError, respond


def run(method, params):
    if method == "subtract":
        return params["minuend"] - params["subtrahend"]
    if method == "refused":
        raise RpcError(jsonrpc.REFUSED, "Not now.")
    raise RpcError(jsonrpc.METHOD_NOT_FOUND, "There is no such method.")


def call(**members):
    return {"jsonrpc": "2.0", "method": "subtract", "id": 1, **members}


NUMBERS = {"minuend": 42, "subtrahend": 23}

RESULTS = [
    ("a call", call(params=NUMBERS), {"result": 19, "id": 1}),
    ("id is a string", call(params=NUMBERS, id="a"), {"result": 19, "id": "a"}),
    ("id is null", call(params=NUMBERS, id=None), {"result": 19, "id": None}),
]

FAILURES = [
    ("not JSON", '{"jsonrpc": "2.0", "method": "subtract"', -32700, None),
    ("an empty text", "", -32700, None),
    ("nested too deep", "[" * 100_000, -32700, None),
    ("a number", "1", -32600, None),
    ("no version", json.dumps({"method": "subtract", "id": 1}), -32600, 1),
    ("another version", json.dumps(call(jsonrpc="1.0")), -32600, 1),
    ("no method", json.dumps({"jsonrpc": "2.0", "id": 3}), -32600, 3),
    ("a method that is no string", json.dumps(call(method=1)), -32600, 1),
    ("an id that is an object", json.dumps(call(id={})), -32600, None),
    ("an id that is a truth value", json.dumps(call(id=True)), -32600, None),
    (
        "an id that is no number",
        '{"jsonrpc": "2.0", "method": "subtract", "id": NaN}',
        -32700,
        None,
    ),
    (
        "an id that is too large for a number",
        '{"jsonrpc": "2.0", "method": "subtract", "id": 1e999}',
        -32700,
        None,
    ),
    ("a method that fails", json.dumps(call(params={"minuend": "a", "subtrahend": 1})), -32603, 1),
    ("an empty batch", "[]", -32600, None),
    ("a batch too large", json.dumps([call(params=NUMBERS)] * 21), -32600, None),
    ("an unknown method", json.dumps(call(method="foobar")), -32601, 1),
    ("parameters by position", json.dumps(call(params=[42, 23])), -32602, 1),
    ("a refusal", json.dumps(call(method="refused")), -32000, 1),
]


@pytest.mark.parametrize(
    "message, wanted", [row[1:] for row in RESULTS], ids=[row[0] for row in RESULTS]
)
def test_result(message, wanted):
    assert json.loads(respond(json.dumps(message), run)) == {"jsonrpc": "2.0", **wanted}


@pytest.mark.parametrize(
    "text, code, identifier", [row[1:] for row in FAILURES], ids=[row[0] for row in FAILURES]
)
def test_failure(text, code, identifier):
    answer = json.loads(respond(text, run))
    assert set(answer) == {"jsonrpc", "error", "id"}
    assert answer["error"]["code"] == code
    assert answer["error"]["message"].endswith(".")
    assert answer["id"] == identifier


def without_id(**members):
    message = call(**members)
    del message["id"]
    return message


@pytest.mark.parametrize(
    "message",
    [without_id(params=NUMBERS), without_id(method="foobar"), [without_id(params=NUMBERS)]],
    ids=["known", "unknown method", "batch"],
)
def test_notification_gets_no_answer(message):
    assert respond(json.dumps(message), run) is None


def test_batch_is_answered_in_order():
    batch = [call(params=NUMBERS), without_id(params=NUMBERS), 1, call(method="x", id=2)]
    answers = json.loads(respond(json.dumps(batch), run))
    assert [answer.get("id") for answer in answers] == [1, None, 2]
    assert answers[0]["result"] == 19
    assert [answer["error"]["code"] for answer in answers[1:]] == [-32600, -32601]


def test_notification_to_a_client():
    text = jsonrpc.notification("notify_klippy_ready", [])
    assert json.loads(text) == {"jsonrpc": "2.0", "method": "notify_klippy_ready", "params": []}


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(), inner, max_size=3),
)


@given(st.dictionaries(st.sampled_from(["jsonrpc", "method", "params", "id"]), JSON))
def test_anything_is_answered_or_ignored(message):
    text = respond(json.dumps(message), lambda method, params: None)
    answer = {} if text is None else json.loads(text, parse_constant=pytest.fail)
    assert text is None or ("error" in answer) != ("result" in answer)


@given(st.text())
def test_any_text_is_answered(text):
    answer = respond(text, lambda method, params: None)
    assert answer is None or json.loads(answer)
