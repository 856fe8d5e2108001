"""Sentences of the firmware's in lines that are far longer than one."""

import pytest

from octoprint_rrfmodel.rrf.wire.alerts import alerts
from octoprint_rrfmodel.rrf.wire.errors import is_halted, is_serious
from octoprint_rrfmodel.rrf.wire.refusals import refusal
from octoprint_rrfmodel.rrf.wire.sentences import sentences

LONG = "x" * 64_000


@pytest.mark.parametrize("line", ["{}{}", "{1}{0}"])
def test_glued_to_something_longer_it_is_found(line):
    assert is_serious(line.format("Heater 1 fault", LONG))
    assert is_halted(line.format("the machine is halted", LONG))


def test_message_that_begins_a_long_line_is_found():
    assert [alert.code for alert in alerts(f"Heater 1 fault: {LONG}")] == ["heater_fault"]
    assert refusal(f"Error: G1: insufficient axes homed {LONG}").code == "refused_move"


def test_what_is_no_longer_than_several_is_whole():
    line = "a" * 4000
    assert sentences(line) is line
    assert len(sentences(LONG)) < 5000
