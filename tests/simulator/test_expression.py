"""Expressions in braces."""

from __future__ import annotations

import pytest

from octoprint_rrfmodel.simulator.text.expression import (
    BadExpression,
    arguments,
    evaluate,
    text_of,
)

MEMBERS = {"heat.heaters[0].current": 21.5, "global.name": "Duet", "#tools": 2}

VALUES = {
    "number": ("{12}", 12),
    "float": ("{1.5}", 1.5),
    "precedence": ("{1 + 2 * 3}", 7),
    "parentheses": ("{(1 + 2) * 3}", 9),
    "minus": ("{-2 - -3}", 1),
    "text": ('{"a" ^ "b"}', "ab"),
    "quotes in a text": ("""{"it''s ""'A'B""" + '"""}', """it's "ab\""""),
    "braces in a text": ('{"{a}" ^ "}"}', "{a}}"),
    "number in a text": ('{"a" ^ 1.50}', "a1.50"),
    "comparison": ("{2 >= 1 && 1 != 2}", True),
    "not": ("{!true}", False),
    "null": ("{null}", None),
    "member": ("{heat.heaters[0].current + 0.5}", 22.0),
    "variable": ("{global.name}", "Duet"),
    "length": ("{#tools}", 2),
    "array": ("{1, 2, 3}", [1, 2, 3]),
    "array of one": ("{1,}", [1]),
    "nested": ("{{1, 2}, {3, 4}}", [[1, 2], [3, 4]]),
}


@pytest.mark.parametrize(("text", "expected"), VALUES.values(), ids=VALUES)
def test_value(text, expected):
    assert evaluate(text, MEMBERS.get) == expected


@pytest.mark.parametrize(
    "text", ["", "{", "{}", "{1 +}", "{1} 2", '{"a" - 1}', "{-true.x", "{$}", '{-"a"}']
)
def test_bad_expression(text):
    with pytest.raises(BadExpression):
        evaluate(text, MEMBERS.get)


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (None, "null"),
        (True, "true"),
        (1.5, "1.500000"),
        (2.0, "2.000000"),
        ([1, "a"], "{1,a}"),
        ("x", "x"),
    ],
)
def test_text_of(value, text):
    assert text_of(value) == text


def test_arguments():
    assert arguments('"a", 1 + 1', MEMBERS.get) == ["a", 2]
