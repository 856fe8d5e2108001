"""A message box that holds the line and takes no answer over it: told once, and a way out."""

from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.guard.message_boxes import BOX_WAITS, MessageBoxes
from octoprint_rrfmodel.guard.recovery import Recovery
from octoprint_rrfmodel.integrations.octoprint_events import MachineEvents

EVENT = "plugin_rrfmodel_message_box_unanswerable"


class Rig:
    def __init__(self, version="3.5.3"):
        self.now = 10.0
        self.model = {"boards": [{"firmwareVersion": version}]}
        self.blocked = "long_command"
        self.waits_in_a_box = False
        self.told = []
        self.shown = []
        self.fired = []
        self.boxes = MessageBoxes(
            lambda: self.model,
            lambda: self.now,
            link=SimpleNamespace(
                blocked=lambda: self.blocked, waits_in_a_box=lambda: self.waits_in_a_box
            ),
            tell=self.told.append,
            show=self.shown.append,
        )
        known = SimpleNamespace(model=lambda: self.model, is_ready=lambda: False)
        self.events = MachineEvents(lambda *event: self.fired.append(event), known, self.boxes)

    def hear(self):
        """Let the firmware print what comes with a box."""
        for listener in (self.boxes, self.events):
            listener.heard("box")

    def reply(self):
        self.now += 1
        for listener in (self.boxes, self.events):
            listener.replied(None, self.now)


def test_is_told_once_until_it_is_answered():
    rig = Rig()
    rig.hear()
    rig.hear()
    assert (rig.told, rig.fired) == ([BOX_WAITS], [(EVENT, {})])
    assert rig.boxes.holds_the_line()
    # answered elsewhere: the macro ends, and a question is answered again
    rig.blocked = None
    assert not rig.boxes.holds_the_line()
    rig.reply()
    assert not rig.boxes.is_open
    rig.blocked = "long_command"
    rig.hear()
    assert (rig.told, rig.fired) == ([BOX_WAITS] * 2, [(EVENT, {})] * 2)


@pytest.mark.parametrize("version, blocked", [("3.4.6", "long_command"), ("3.5.3", None)])
def test_one_that_can_be_answered_or_is_another_channels_is_no_news(version, blocked):
    rig = Rig(version)
    rig.blocked = blocked
    rig.hear()
    assert (rig.told, rig.fired, rig.boxes.holds_the_line()) == ([], [], False)


@pytest.mark.parametrize(
    "is_held, card_prints, is_refused",
    [(False, False, True), (True, False, False), (True, True, True)],
)
def test_a_restart_is_a_way_out_of_a_print_that_nobody_can_end(
    is_held, card_prints, is_refused, monkeypatch
):
    monkeypatch.setattr("octoprint_rrfmodel.guard.recovery.gettext", str)
    printer = SimpleNamespace(
        is_printing=lambda: True, is_paused=lambda: False, is_operational=lambda: True
    )
    recovery = Recovery(
        lambda: printer,
        SimpleNamespace(is_rrf=True, can_restart=True),
        lambda: SimpleNamespace(prints=card_prints, is_halted=False),
        notifications=None,
        is_held=lambda: is_held,
    )
    assert (recovery.refusal() is not None) is is_refused


TEXT = ("- Tool -", "Is it clean?", "Both sides?", "Send M292 to continue or M292 P1 to cancel")


def test_a_box_that_can_be_answered_is_shown_from_its_text_until_it_is():
    rig = Rig("3.4.6")
    rig.waits_in_a_box = True
    for text in ("ok", *TEXT):
        rig.boxes.line(text)
    (box,) = rig.shown
    assert (box["title"], box["message"], box["mode"]) == ("Tool", "Is it clean?\nBoth sides?", 3)
    assert rig.boxes.wait_for_a_person() and not rig.boxes.holds_the_line()
    rig.boxes.tick()
    assert len(rig.shown) == 1
    # the next one of the same macro is another one
    rig.boxes.line("Send M292 to continue")
    assert rig.shown[1]["seq"] != box["seq"]
    assert (rig.shown[1]["mode"], rig.shown[1]["title"]) == (2, "")
    rig.waits_in_a_box = False
    rig.boxes.tick()
    rig.boxes.tick()
    assert rig.shown[2:] == [None]


def test_a_box_is_shown_once_whichever_is_noted_first():
    rig = Rig("3.4.6")
    for text in TEXT:
        rig.boxes.line(text)
    assert rig.shown == []
    # what the line waits for is noted when the line is read
    rig.waits_in_a_box = True
    rig.boxes.heard("box")
    assert len(rig.shown) == 1
    rig.boxes.heard("box")
    assert len(rig.shown) == 1


@pytest.mark.parametrize("version, waits", [("3.5.3", True), ("3.4.6", False)])
def test_a_box_that_cannot_be_answered_or_holds_nothing_is_not_shown(version, waits):
    rig = Rig(version)
    rig.waits_in_a_box = waits
    for text in TEXT:
        rig.boxes.line(text)
    assert rig.shown == []
