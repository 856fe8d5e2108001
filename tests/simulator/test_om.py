"""Numbers, escapes and limits of M409's text."""

from __future__ import annotations

import json
import math

import pytest

from octoprint_rrfmodel.simulator.firmware import VERSIONS
from octoprint_rrfmodel.simulator.model.om import ModelText, encoded, first_element, number, quoted

NUMBERS = {
    "zero": (0.0, 3, "0"),
    "negative zero": (-0.0, 3, "0"),
    "trailing zeros": (1.0, 2, "1.00"),
    "temperature": (21.345, 1, "21.3"),
    "half to even, down": (1.25, 1, "1.2"),
    "half to even, up": (24.75, 1, "24.8"),
    "24.25": (24.25, 1, "24.2"),
    "all digits": (12.3456789, 7, "12.34568"),
    "no limit given": (12.3456789, 0, "12.34568"),
    "below one": (0.123456789, 7, "0.1234568"),
    "hundreds": (123.456789, 7, "123.4568"),
    "a hundred thousand": (123456.7, 3, "123456.7"),
    "more": (1234567.5, 7, "1234567.5"),
    "negative keeps them": (-1234567.5, 7, "-1234567.5000000"),
    "too small": (0.0001, 3, "0.000"),
    "negative and too small": (-0.0001, 1, "-0.0"),
    "NaN": (math.nan, 1, "null"),
    "infinity": (math.inf, 1, "null"),
    "huge": (1e19, 1, "1.0e+19"),
    "beyond float32": (1e300, 1, "null"),
}


@pytest.mark.parametrize(("value", "decimals", "text"), NUMBERS.values(), ids=NUMBERS)
def test_number(value, decimals, text):
    assert number(value, decimals) == text


STRINGS = {
    "plain": ("abc", '"abc"'),
    "quote": ('a"b', '"a\\"b"'),
    "backslash": ("a\\b", '"a\\\\b"'),
    "line breaks": ("a\r\n\tb", '"a\\r\\n\\tb"'),
    "control": ("a\x00\x07b", '"a??b"'),
    "other letters": ("ü€/\x7f", '"ü€/\x7f"'),
}


@pytest.mark.parametrize(("text", "expected"), STRINGS.values(), ids=STRINGS)
def test_string(text, expected):
    assert quoted(text) == expected


def test_exponential_numbers():
    text = encoded({"a": 21.5, "b": 0.0, "c": 3}, exponents=True)
    assert text == '{"a":2.15e+1,"b":0,"c":3}'


def text_of(firmware="3.5.3", buffers=40):
    return ModelText(VERSIONS[firmware], buffers)


HEATERS = {
    "heat": {
        "bedHeaters": [0, -1],
        "heaters": [{"active": 60, "current": 21.345, "max": 120, "standby": 0.0}, None],
    },
    "global": {"a": 1.5, "n": 3},
    "state": {"upTime": 7},
}

REPLIES = {
    "decimals by member": (
        "heat.heaters[0]",
        "",
        '{"key":"heat.heaters[0]","flags":"","result":'
        '{"active":60.0,"current":21.34,"max":120.0,"standby":0}}',
    ),
    "a leaf": (
        "heat.heaters[0].current",
        "",
        '{"key":"heat.heaters[0].current","flags":"","result":21.34}',
    ),
    "every element": (
        "heat.heaters[].active",
        "",
        '{"key":"heat.heaters[].active","flags":"","result":[60.0,null],"next":0}',
    ),
    "integers": (
        "heat.bedHeaters",
        "",
        '{"key":"heat.bedHeaters","flags":"","result":[0,-1],"next":0}',
    ),
    "variables have all digits": (
        "global",
        "",
        '{"key":"global","flags":"","result":{"a":1.500000,"n":3}}',
    ),
    "length": ("#heat.heaters", "", '{"key":"#heat.heaters","flags":"","result":2}'),
    "unknown": ("nothing", "", '{"key":"nothing","flags":"","result":null}'),
    "depth 1 for an empty key": (
        "",
        "",
        '{"key":"","flags":"","result":{"heat":{},"global":{},"state":{}}}',
    ),
    "depth 1 also with f": ("", "f", '{"key":"","flags":"f","result":{"heat":{},"state":{}}}'),
    "key is echoed with escapes": ('a"b', "", '{"key":"a\\"b","flags":"","result":null}'),
    "start beyond the end": (
        "heat.heaters",
        "a60",
        '{"key":"heat.heaters","flags":"a60","result":[],"next":0}',
    ),
}


@pytest.mark.parametrize(("key", "flags", "text"), REPLIES.values(), ids=REPLIES)
def test_reply(key, flags, text):
    assert text_of().reply(HEATERS, key, flags) == text


def test_model_is_not_changed():
    before = json.dumps(HEATERS)
    text_of().reply(HEATERS, "", "d99v")
    assert json.dumps(HEATERS) == before


def rows(count, width=100):
    return {"global": {"rows": [f"{index:03d}" + "x" * (width - 3) for index in range(count)]}}


@pytest.mark.parametrize(("buffers", "limit"), [(40, 4608), (26, 2816), (24, 2560)])
def test_a_root_array_is_cut_at_half_the_buffers(buffers, limit):
    text = text_of(buffers=buffers)
    assert text.array_bytes == limit
    reply = text.reply(rows(60), "global.rows", "")
    found = json.loads(reply)
    shown = found["result"]
    assert found["next"] == len(shown)
    # the last element that was written started below the limit
    tail = f'],"next":{found["next"]}}}'
    body = reply[: -len(tail)]
    assert len(body) >= limit
    assert len(body) - len(f',"{shown[-1]}"') < limit


def test_pages_are_complete():
    text, seen, start = text_of(buffers=26), [], 0
    while True:
        found = json.loads(text.reply(rows(60), "global.rows", f"d99a{start}"))
        seen += found["result"]
        start = found["next"]
        if not start:
            break
    assert seen == rows(60)["global"]["rows"]


def test_nested_arrays_are_not_cut():
    found = json.loads(text_of().reply(rows(60), "global", ""))
    assert len(found["result"]["rows"]) == 60
    assert "next" not in found


@pytest.mark.parametrize(("buffers", "most"), [(40, 10240), (26, 6656)])
def test_what_does_not_fit_is_answered_by_an_error(buffers, most):
    text = text_of(buffers=buffers)
    assert text.most_bytes == most
    assert text.reply(rows(200), "global", "") == '{"err":-1}'
    fits = {"global": {"a": "x" * (most - 60)}}
    assert text.reply(fits, "global", "").startswith('{"key"')


@pytest.mark.parametrize(
    ("flags", "firmware", "count"),
    [
        ("", "3.5.3", 9),
        ("d99vn", "3.5.1", 9),
        ("d99f", "3.5.3", 12),
        ("a0", "3.6", 12),
        ("", "3.4", 12),
        ("", "3.3", 12),
    ],
)
def test_move_axes_are_limited_to_nine(flags, firmware, count):
    model = {"move": {"axes": [{"letter": "X", "userPosition": 0.0} for _ in range(12)]}}
    text = text_of(firmware)
    assert len(json.loads(text.reply(model, "move.axes", flags))["result"]) == count
    assert len(json.loads(text.reply(model, "move", flags))["result"]["axes"]) == count


OLD_LEAVES = {
    "name behind a number": ("state.upTime.x", 7),
    "index behind a number": ("state.upTime[0]", 7),
    "all of a leaf": ("heat.heaters[].active.x", [60.0, None]),
    "null stays null": ("state.nothing.x", None),
    "dot": ("state.upTime.", 7),
}


@pytest.mark.parametrize(("key", "expected"), OLD_LEAVES.values(), ids=OLD_LEAVES)
@pytest.mark.parametrize("firmware", ["3.3", "3.4"])
def test_up_to_34_the_rest_of_a_key_behind_a_leaf_is_ignored(firmware, key, expected):
    found = json.loads(text_of(firmware).reply(HEATERS, key, ""))
    assert found["key"] == key
    assert found["result"] == expected


def test_from_35_it_is_not():
    assert json.loads(text_of("3.5.3").reply(HEATERS, "state.upTime.x", ""))["result"] is None


@pytest.mark.parametrize(
    ("firmware", "shown"), [("3.3", False), ("3.4", True), ("3.5.3", True), ("3.6", True)]
)
def test_flag_i_came_with_34(firmware, shown):
    model = {"state": {"messageBox": None, "status": "idle"}}
    found = json.loads(text_of(firmware).reply(model, "state", "fi"))
    assert ("messageBox" in found["result"]) is shown
    assert found["flags"] == "fi"


@pytest.mark.parametrize(("firmware", "text"), [("3.3", "21.3"), ("3.4", "21.34")])
def test_decimals_of_older_firmware(firmware, text):
    assert text_of(firmware).reply(HEATERS, "heat.heaters[0].current", "").endswith(f":{text}}}")


@pytest.mark.parametrize(
    ("flags", "start"), [("", 0), ("a5", 5), ("d99a12", 12), ("a", 0), ("a1a7", 7)]
)
def test_first_element(flags, start):
    assert first_element(flags) == start
