"""Temperatures that the line tells by itself, in the model."""

import pytest

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.follow.reported import members_of
from octoprint_rrfmodel.rrf.wire.report import entries, is_report

HEATERS = [
    {"current": 20.01, "active": 0, "standby": 0, "state": "off"},
    {"current": 150.0, "active": 210, "standby": 150, "state": "standby"},
    None,
    {"current": 21.0, "active": 50, "standby": 0, "state": "active", "avgPwm": 0.5},
    {"current": 22.0, "active": 0, "standby": 0, "state": "fault"},
]

MODEL = {
    "heat": {"bedHeaters": [0, 2], "chamberHeaters": [-1, 3], "heaters": HEATERS},
    "tools": [None, {"number": 1, "heaters": [1, 4]}, {"number": 2, "heaters": []}],
}


@pytest.mark.parametrize(
    "line, told",
    [
        # the first slot has no number
        ("B:20.5 /60.0", {0: {"current": 20.5, "state": "active", "active": 60.0}}),
        ("ok B:20.5 /0.0", {0: {"current": 20.5}}),
        ("C1:21.5 /50.0", {3: {"current": 21.5}}),
        ("C1:21.5 /55.0", {3: {"current": 21.5, "active": 55.0}}),
        # slots and tools that the machine hasn't got
        ("C:1 /2 B1:1 /2 B9:1 /2 T7:1 /2 T2:1 /2 T0:1 /2", {}),
        # a tool's further heaters, and one in a fault, whose target is nobody's
        (
            "T:151.0 /150.0 T1:151.0 /150.0 23.0 /99.0",
            {1: {"current": 151.0}, 4: {"current": 23.0}},
        ),
        ("T1:151.0 /210.0", {1: {"current": 151.0, "state": "active"}}),
        ("T1:151.0 /205.0", {1: {"current": 151.0, "active": 205.0, "standby": 205.0}}),
        ("T1:-273.1 /0.0", {1: {"current": -273.1, "active": 0.0, "standby": 0.0}}),
        ("X:1.000 Y:2.000 Z:3.000 E:0.000", {}),
        ("ok", {}),
        ("T1:nan /0 B:x", {}),
        ("", {}),
    ],
)
def test_what_a_report_tells(line, told):
    assert members_of(entries(line), MODEL) == told


def test_a_model_without_heat_stays_as_it_is():
    assert members_of(entries("T0:20.0 /0.0 B:20.0 /0.0"), {}) == {}


@pytest.mark.parametrize(
    "line, is_one",
    [
        ("T:20.0 /0.0", True),
        ("T0:20.0 /0.0", True),
        ("B:20.0 /0.0", True),
        ("C1:20.0 /0.0", True),
        ("Begin file list", False),
        ("T", False),
        ("Cancelled printing file", False),
        ("", False),
    ],
)
def test_is_report(line, is_one):
    assert is_report(line) is is_one


def test_nothing_but_the_temperatures_changes_and_old_snapshots_stay():
    follower = Follower()
    follower.store.patch(MODEL)
    before = follower.store.model
    warmed = follower.warm("T0:1 /2 B:33.3 /60.0")
    assert warmed.heaters == {0}
    assert warmed.changes == {
        "heat": {"heaters": {0: {"current": True, "state": True, "active": True}}}
    }
    after = follower.store.model
    assert after["heat"]["heaters"][0] == {
        "current": 33.3,
        "active": 60.0,
        "standby": 0,
        "state": "active",
    }
    assert after["heat"]["heaters"][1:] == HEATERS[1:]
    assert after["tools"] is before["tools"]
    assert before["heat"]["heaters"][0]["current"] == 20.01
    assert follower.warm("M117") is None
