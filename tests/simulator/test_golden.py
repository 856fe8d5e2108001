"""M409's text, byte for byte, against what the firmware's own code printed."""

from __future__ import annotations

import re

import pytest

from octoprint_rrfmodel.simulator.firmware import VERSIONS
from octoprint_rrfmodel.simulator.model.decimals import tree_of
from octoprint_rrfmodel.simulator.model.om import OUT_OF_BUFFERS, ModelText

STEP = re.compile(r"\.?([^.\[]+)|\[(\d+)\]")


def built(rows):
    """Return model, marks and decimals of the rows."""
    root, marks, decimals = {}, {}, {}
    for row in rows[1:]:
        steps = [name or int(index) for name, index in STEP.findall(row["path"])]
        holder = root
        for step in steps[:-1]:
            holder = holder[step]
        value = {"object": {}, "array": []}.get(row["type"], row.get("value"))
        if row["type"] == "object" or row["type"] == "array":
            value = type(value)()
        if isinstance(steps[-1], int):
            assert steps[-1] == len(holder)
            holder.append(value)
        else:
            holder[steps[-1]] = value
        pattern = re.sub(r"\[\d+\]", "[]", row["path"])
        if row["flags"]:
            marks[pattern] = frozenset(row["flags"])
        if row["type"] == "float":
            decimals[pattern] = row["decimals"]
    return root, marks, decimals


@pytest.mark.parametrize(
    ("firmware", "differing"), [("3.4", "output_3_4"), ("3.5.3", ""), ("3.6", "output_3_6")]
)
def test_against_the_firmware(golden, firmware, differing):
    model, marks, decimals = built(golden["model"])
    text = ModelText(VERSIONS[firmware], 40, marks)
    text.decimals = tree_of(decimals)
    wrong = []
    for case in golden["cases"]:
        expected = case.get(differing, case["output"])
        # what the firmware prints as malformed JSON, nobody imitates
        if case.get("valid_json", True) is False:
            continue
        reply = text.reply(model, case["key"], case["flags"])
        wanted = OUT_OF_BUFFERS if expected is None else expected.rstrip("\n")
        if reply != wanted:
            wrong.append((case["key"], case["flags"], wanted, reply))
    assert wrong == []
