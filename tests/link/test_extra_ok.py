"""The ok too many behind a move that fails on a line of several commands, and no other ok."""

import pytest

from octoprint_rrfmodel.link.serial.extra_ok import ExtraOk

JOG = "M120 G21 G91 G1 X1 M121"
NEW, OLD = "Error: M121: insufficient axes homed\n", "Error: G0/G1: insufficient axes homed\n"
FAULT = "Error: Heater 1 fault: temperature excursion\n"


@pytest.mark.parametrize(
    "cmd, lines, taken",
    [
        (JOG, [NEW, "ok\n", "ok\n", "ok\n"], [2]),
        (JOG, [OLD, "ok\n", "ok\n", "ok\n"], [2]),
        (JOG, ["ok\n", "ok\n"], []),
        (JOG, [FAULT, "ok\n", "ok\n"], []),
        (JOG, [NEW, "ok\n", "ok T0:21.3 /0.0\n", "ok\n"], []),
        ("M120", ["Error: M120: stack overflow\n", "ok\n", "ok\n"], []),
        ("M120 M140 P0 S-273.15 M121", [FAULT, "ok\n", "ok\n"], []),
    ],
    ids=["3.5", "3.3", "no error", "other error", "not bare", "typed", "no move"],
)
def test_only_the_ok_too_many_is_taken(cmd, lines, taken):
    extra = ExtraOk()
    extra.sending(cmd, "M120")
    found = []
    for number, line in enumerate(lines):
        if extra.awaits is not None and extra.is_in(line):
            found.append(number)
    assert found == taken


def test_a_command_that_goes_out_in_between_changes_nothing():
    extra = ExtraOk()
    extra.sending(JOG, "M120")
    assert not extra.is_in(NEW)
    assert not extra.is_in("ok\n")
    extra.sending("M105", "M105")
    assert extra.is_in("ok\n")
    assert extra.awaits is None
