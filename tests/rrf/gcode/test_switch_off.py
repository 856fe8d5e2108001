"""What means that heaters are to be off, and the lines for all that a machine has."""

import pytest

from octoprint_rrfmodel.rrf.gcode.switch_off import all_off, switched_off
from octoprint_rrfmodel.rrf.views.machine import Machine


@pytest.mark.parametrize(
    "command, kind",
    [
        ("M104 S0", "tool"),
        ("M104 T1 S0", "tool"),
        ("M109 S0", "tool"),
        ("M568 P1 A0", "tool"),
        ("M568 P1 S-273.15", "tool"),
        ("G10 P1 S0 R0", "tool"),
        ("M140 S0", "bed"),
        ("M140 P1 S-274", "bed"),
        ("M141 S0", "chamber"),
        ("M104 S200", None),
        ("M104", None),
        ("M568 P1 A1", None),
        ("G10", None),
        ("G10 L2 S0", None),
        ("M140 R0", None),
        ("M106 S0", None),
        ("M84", None),
    ],
)
def test_kind(command, kind):
    assert switched_off(command, command.split()[0]) == kind


@pytest.mark.parametrize(
    "model",
    [
        {},
        {"tools": None, "heat": None},
        {"tools": [None, {"number": 0}], "heat": {"bedHeaters": [-1, None], "heaters": []}},
    ],
)
def test_nothing_to_switch_off(model):
    assert all_off(Machine(model)) == []


def test_before_m568():
    model = {
        "boards": [{"firmwareVersion": "2.05"}],
        "tools": [{"number": 0, "heaters": [1]}],
        "heat": {"bedHeaters": [0], "heaters": [{}, {}]},
    }
    lines = [off.line for off in all_off(Machine(model))]
    assert lines == ["G10 P0 S-273.15 R-273.15", "M120 M140 P0 S-273.15 M121"]
