"""Sentences for refusals, and how many commands go through in a second."""

import functools
from types import SimpleNamespace

import pytest

from octoprint_rrfmodel.control.machine_commands import MachineCommands
from octoprint_rrfmodel.control.rate import BURST, RATE, Rate
from octoprint_rrfmodel.host import command_texts
from octoprint_rrfmodel.rrf.gcode.commands import Situation
from octoprint_rrfmodel.rrf.views.machine import Machine
from tests.rrf.commanded import FREE, go, on
from tests.rrf.gcode.test_commands_bad import TABLE as BAD
from tests.rrf.gcode.test_commands_forbidden import TABLE as FORBIDDEN

OF_THE_GLUE = {"not_a_command", "too_many"}


@functools.cache
def refusals():
    """Return a refusal of each code, by the code."""
    halted = on(**{"state.status": "halted"})
    paused = on(**{"state.status": "paused"})
    prints = on(**{"state.status": "processing"})
    found = [
        *(go(name, on(kind, **members), **given) for name, given, kind, members, _ in BAD),
        *(
            go(name, on(**members), situation, **given)
            for name, given, members, situation, _ in FORBIDDEN
        ),
        go("refresh", on(), key="nothing"),
        go("home", Machine({}), Situation(False, False, False, False, True)),
        go("home", Machine({}), FREE._replace(is_rrf=False)),
        go("home", Machine({}), FREE),
        go("home", halted),
        go("variable", on(firmware="2.05"), name="retries", value=4),
        go("home", paused),
        go("jog", prints, axes={"X": 1}),
        go("job", on(), FREE._replace(octoprint_prints=True), action="pause"),
        go("tool_state", on(firmware="2.05"), tool=0, state="active"),
        go("object", on(firmware="2.05"), index=0, action="cancel"),
    ]
    return {refusal.code: refusal for refusal in found}


@pytest.mark.parametrize("code", sorted(set(command_texts._texts()) - OF_THE_GLUE))
def test_each_code_has_a_sentence(code):
    refusal = refusals()[code]
    text = command_texts.command_text(refusal.code, refusal.values)
    assert text[0].isupper() and text.endswith(".") and "%" not in text
    for value in refusal.values.values():
        assert value in text


def test_each_sentence_has_a_code():
    known = set(command_texts._texts())
    assert known == set(refusals()) | OF_THE_GLUE


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


class Host:
    """The link as far as commands see it."""

    def __init__(self, machine):
        self.sent = []
        self.looked = []
        self.machine = machine
        self.is_rrf = self.is_operational = True
        self.commands_to = MachineCommands(
            self,
            lambda: self.machine,
            SimpleNamespace(
                is_waiting=False, holds_the_line=lambda: False, is_answered=lambda: False
            ),
            recovery=SimpleNamespace(refusal=lambda: "Not now."),
            look=self.looked.append,
            rate=Rate(lambda: 0.0),
        )

    def has_a_print(self):
        return False

    is_paused = has_a_print

    def carried(self, lines, machine):
        return list(lines)

    def is_streaming_a_print(self):
        return False

    def send(self, lines, tags, force=False):
        self.sent.append((lines, tags))


def test_other_plugins_call_a_function():
    host = Host(on())
    command = host.commands_to.command
    assert command("filament", action="load", name="PLA") is None
    assert command("fan", fan=0, speed=1) is None
    assert host.sent == [
        (['M701 S"PLA"', "M703"], {"trigger:rrfmodel.command"}),
        (["M106 P0 S1"], {"trigger:rrfmodel.command"}),
    ]
    # asked at once what has come of it, but for what blocks
    assert host.looked == [None]
    command("refresh", key="heat.heaters[0]")
    command("refresh")
    assert host.looked == [None, "heat", ""]


@pytest.mark.parametrize(
    "name, parameters, sentence",
    [
        ("fan", {"fan": 9, "speed": 1}, "The machine has no fan 9. Its fans are: 0, 1."),
        ("explode", {}, None),
        ("message_box", {"action": "ok"}, "No message waits for an answer."),
        ("recover", {}, "Not now."),
    ],
)
def test_a_function_says_why_it_refuses(name, parameters, sentence):
    host = Host(on())
    with pytest.raises(ValueError) as refused:
        host.commands_to.command(name, **parameters)
    assert sentence in (None, str(refused.value))
    assert host.sent == []


def test_a_function_is_bounded_too():
    host = Host(on())
    for _ in range(BURST):
        host.commands_to.command("fan", fan=0, speed=1)
    with pytest.raises(ValueError, match="Too many"):
        host.commands_to.command("fan", fan=0, speed=1)
    assert len(host.sent) == BURST
