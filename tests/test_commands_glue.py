"""Sentences for refusals, and how many commands go through in a second."""

import pytest

from tests.rrf.commanded import FREE, go, on
from tests.rrf.test_commands_bad import TABLE as BAD
from tests.rrf.test_commands_forbidden import TABLE as FORBIDDEN

pytest.importorskip("flask_babel")

from octoprint_rrfmodel import command_texts  # noqa: E402
from octoprint_rrfmodel.rate import BURST, RATE, Rate  # noqa: E402
from octoprint_rrfmodel.rrf.commands import Situation  # noqa: E402
from octoprint_rrfmodel.rrf.machine import Machine  # noqa: E402

HALTED = on(**{"state.status": "halted"})
PAUSED = on(**{"state.status": "paused"})
PRINTS = on(**{"state.status": "processing"})

REFUSALS = [
    *(go(name, on(kind, **members), **given) for name, given, kind, members, _ in BAD),
    *(
        go(name, on(**members), situation, **given)
        for name, given, members, situation, _ in FORBIDDEN
    ),
    go("refresh", on(), key="nothing"),
    go("home", Machine({}), Situation(False, False, False, False, True)),
    go("home", Machine({}), FREE._replace(is_rrf=False)),
    go("home", Machine({}), FREE),
    go("home", HALTED),
    go("home", PAUSED),
    go("jog", PRINTS, axes={"X": 1}),
    go("job", on(), FREE._replace(octoprint_prints=True), action="pause"),
    go("tool_state", on(firmware="2.05"), tool=0, state="active"),
    go("object", on(firmware="2.05"), index=0, action="cancel"),
]

OF_THE_GLUE = {"not_a_command", "too_many"}


@pytest.mark.parametrize("refusal", {refusal.code: refusal for refusal in REFUSALS}.values())
def test_each_code_has_a_sentence(refusal):
    text = command_texts.command_text(refusal.code, refusal.values)
    assert text[0].isupper() and text.endswith(".") and "%" not in text
    for value in refusal.values.values():
        assert value in text


def test_each_sentence_has_a_code():
    known = set(command_texts._texts())
    assert known == {refusal.code for refusal in REFUSALS} | OF_THE_GLUE


def test_a_percent_sign_is_no_place_for_a_value():
    refusal = go("home", on(), axes=["%(known)s %d"])
    assert "%(known)s %d" in command_texts.command_text(refusal.code, refusal.values)


def test_commands_a_second_are_bounded():
    now = 100.0
    rate = Rate(lambda: now)
    assert [rate.allows() for _ in range(BURST + 5)] == [True] * BURST + [False] * 5
    now += 0.5
    assert [rate.allows() for _ in range(int(RATE / 2) + 1)] == [True] * int(RATE / 2) + [False]
    now += 3600
    assert sum(rate.allows() for _ in range(10 * BURST)) == BURST
