"""A few scenes of the week, so that the tool does not rot; the week is ``make endurance``."""

import pytest

pytest.importorskip("octoprint")
from octoprint_rrfmodel.host.version import IS_2

if not IS_2:
    pytest.skip("the tool is the same in both hosts", allow_module_level=True)

from octoprint_rrfmodel.simulator.faults import FAULTS

from .companions import WHILE_IDLE
from .levels import LIMITS, levels
from .network import NetworkWeek
from .network_rig import MOST_A_SECOND, busiest
from .scenes import BY_NAME, SCENES, turn_of
from .week import Week

pytestmark = pytest.mark.slow

OTHERWISE = {"reset", "disconnect", "halted", "usb_box_stuck"}
"""Faults that are scenes of their own, or over with a reset alone."""

FEW = ["print", "card job", "reset"]


def test_every_fault_belongs_to_a_scene():
    assert {companion.name for companion in WHILE_IDLE} | OTHERWISE == {
        name for name in FAULTS if not name.startswith("net_")
    }


def test_every_scene_comes_once_a_round():
    names = [turn_of(7, turn)[0].name for turn in range(2 * len(SCENES))]
    assert sorted(names) == sorted([*BY_NAME] * 2)
    assert turn_of(7, 3)[:2] == turn_of(7, 3)[:2]


def test_what_rises_is_not_level():
    def samples(rising):
        return [{name: 100 + number * rising for name in LIMITS} for number in range(30)]

    assert all(level.is_level for level in levels(samples(0)))
    assert not any(level.is_level for level in levels(samples(500)))


def test_a_few_scenes():
    outcome = Week(1, 400.0, has_pages=False, names=FEW).run(300, most=len(FEW))
    assert outcome.harm == []
    assert outcome.turns == len(FEW)
    assert outcome.lines > 300
    assert outcome.hours > 0.5


def test_busiest_time():
    assert busiest([]) == 0
    assert busiest([0, 1, 2, 30, 31, 32, 33, 34], seconds=10) == 0.5
    assert busiest(range(100), seconds=10) == 1.1


def test_a_few_scenes_over_the_network():
    week = NetworkWeek(4).run(300, most=3)
    assert week.verdict() == []
    assert week.turns == 3
    assert week.requests > 30
    assert max(week.quiet_rates) <= MOST_A_SECOND
    assert week.hours > 1
