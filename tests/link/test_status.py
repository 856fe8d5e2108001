"""The state's parts about what the line is busy with, and what of it is worth a message."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.heater_ages import HeaterAges
from octoprint_rrfmodel.link.link import Doing
from octoprint_rrfmodel.link.status import PluginStatus, worth_telling
from octoprint_rrfmodel.rrf.follow.follower import Warmed


def state_of(doing, heater_ages=None):
    follower = SimpleNamespace(
        protocol="M409",
        ready=True,
        resets=0,
        counters={},
        too_large=(),
        store=SimpleNamespace(revision=1),
    )
    return PluginStatus(
        lambda: "1",
        SimpleNamespace(
            kind="serial",
            protocol=None,
            is_operational=True,
            is_rrf=False,
            rewritten=0,
            doing=lambda: doing,
        ),
        SimpleNamespace(
            follower=follower, polls=0, bytes=0, is_stale=lambda: False, why_silent=lambda: None
        ),
        known=SimpleNamespace(age=lambda: 0.5, ages=dict, now=lambda: 106.14),
        warnings=list,
        is_first_run=lambda: False,
        heater_ages=lambda: heater_ages or {},
        beside=lambda: None,
        simulated_file=lambda: None,
        jobs=lambda: 0,
    )()


def test_says_how_the_bytes_travel_and_what_the_line_is_doing():
    assert (state_of(None)["link"], state_of(None)["doing"]) == ("serial", None)
    told = state_of(Doing("G28", "homing", 100.0))["doing"]
    assert told == {"command": "G28", "what": "homing", "since": 6.1}


@pytest.mark.parametrize(
    "command", ['M587 S"net" P"secret"', 'M551 P"secret"', 'M589 S"a" P"secret"']
)
def test_no_password_is_shown(command):
    assert "secret" not in str(state_of(Doing(command, "other", 100.0)))


def test_what_takes_long_is_worth_a_message_and_a_prints_lines_are_not():
    quiet = worth_telling(state_of(None))
    assert worth_telling(state_of(Doing("G1 X1", "other", 106.0))) == quiet
    homing = worth_telling(state_of(Doing("G28", "homing", 100.0)))
    assert homing != quiet
    # the time goes on by itself
    assert worth_telling(state_of(Doing("G28", "homing", 90.0))) == homing
    # and so does a heater's
    assert worth_telling(state_of(None, {"0": 1.2})) == quiet


def test_how_old_a_temperature_is_that_the_line_has_told():
    now = [100.0]
    ages = HeaterAges(lambda: now[0])
    ages.warmed(Warmed({}, frozenset((1, 0))))
    now[0] = 101.5
    ages.warmed(Warmed({}, frozenset((1,))))
    now[0] = 102.0
    assert ages() == {"0": 2.0, "1": 0.5}
    ages.replied(None, 101.0)
    assert ages() == {}
    ages.warmed(Warmed({}, frozenset((1,))))
    ages.forgotten()
    assert ages() == {}
