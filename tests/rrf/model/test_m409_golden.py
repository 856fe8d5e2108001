"""The evaluator against answers of the firmware's own code."""

import json
import re

import pytest

from octoprint_rrfmodel.rrf.model.m409 import answer

STEP = re.compile(r"([^.\[\]]+)|\[([0-9]+)\]")


@pytest.fixture(scope="module")
def golden(shared_dir):
    """Answers of the firmware to requests on a small tree, and that tree."""
    with open(shared_dir / "golden" / "m409-small.json", encoding="utf-8") as file:
        return json.load(file)


def built(rows):
    """Return model and marks that the rows describe."""
    model, marks = {}, {}
    for row in rows:
        if not row["path"]:
            continue
        if row["flags"] is not None:
            marks[re.sub(r"\[[0-9]+\]", "[]", row["path"])] = frozenset(row["flags"])
        kind = row["type"]
        value = {"object": {}, "array": []}.get(kind, row.get("value"))
        *parents, last = [name or int(index) for name, index in STEP.findall(row["path"])]
        place = model
        for step in parents:
            place = place[step]
        if isinstance(last, int):
            assert len(place) == last
            place.append(value)
        else:
            place[last] = value
    return model, marks


def differences(expected, got, path=""):
    """Yield where two values differ; numbers count as equal within the printed decimals."""
    if isinstance(expected, dict) and isinstance(got, dict):
        if list(expected) != list(got):
            yield f"{path}: members {list(expected)} are {list(got)}"
        for name in expected.keys() & got.keys():
            yield from differences(expected[name], got[name], f"{path}.{name}")
    elif isinstance(expected, list) and isinstance(got, list):
        if len(expected) != len(got):
            yield f"{path}: {len(expected)} elements are {len(got)}"
        for index, (one, other) in enumerate(zip(expected, got)):
            yield from differences(one, other, f"{path}[{index}]")
    elif isinstance(expected, Printed) and type(got) in (int, float):
        if abs(expected.value - got) > 0.5 * 10**-expected.decimals + 1e-9:
            yield f"{path}: {expected.value} is {got}"
    elif type(expected) is not type(got) or expected != got:
        yield f"{path}: {expected!r} is {got!r}"


class Printed:
    """A number that the firmware printed with so many decimals."""

    def __init__(self, text):
        self.value = float(text)
        self.decimals = len(text.partition(".")[2])


def firmware_says(case):
    return json.loads(case["output"], parse_float=Printed)


def is_comparable(case):
    """Return whether the answer is one that has to be imitated: there is one, and it is JSON."""
    return case["output"] is not None and case.get("valid_json", True)


def test_golden_answers_are_all_there(golden):
    assert len(golden["cases"]) == 1250
    assert len([case for case in golden["cases"] if is_comparable(case)]) > 1200


def test_every_answer_is_the_firmwares(golden):
    model, marks = built(golden["model"])
    wrong = []
    for case in filter(is_comparable, golden["cases"]):
        got = answer(model, case["key"], case["flags"], marks, firmware=True)
        found = list(differences(firmware_says(case), got))
        if found:
            wrong.append((case["key"], case["flags"], found))
    assert not wrong


def test_comparison_notices_a_rule_that_is_not_followed(golden):
    """With one mark missing the comparison above has to find something."""
    model, marks = built(golden["model"])
    marks["alpha"] = frozenset()
    assert any(
        list(
            differences(
                firmware_says(case),
                answer(model, case["key"], case["flags"], marks, firmware=True),
            )
        )
        for case in filter(is_comparable, golden["cases"])
    )


def test_page_deviates_only_in_the_depth_of_an_empty_key_with_f(golden):
    """With ``firmware=False`` the default depth differs, and nothing else on a small tree."""
    model, marks = built(golden["model"])
    for case in filter(is_comparable, golden["cases"]):
        key, flags = case["key"], case["flags"]
        if key == "" and "f" in flags and "d" not in flags:
            flags += "d99"
        theirs = answer(model, key, flags, marks, firmware=True)
        ours = answer(model, key, case["flags"], marks)
        assert ours["result"] == theirs["result"], (key, case["flags"])
