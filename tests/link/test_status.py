"""The state's parts about what the line is busy with, and what of it is worth a message."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.link import Doing
from octoprint_rrfmodel.link.status import PluginStatus, worth_telling


def state_of(doing):
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
            kind="serial", is_operational=True, is_rrf=False, rewritten=0, doing=lambda: doing
        ),
        SimpleNamespace(
            follower=follower, polls=0, bytes=0, is_stale=lambda: False, why_silent=lambda: None
        ),
        known=SimpleNamespace(age=lambda: 0.5, now=lambda: 106.14),
        warnings=list,
        is_first_run=lambda: False,
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
