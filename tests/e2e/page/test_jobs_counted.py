"""Fifteen everyday jobs, done by mouse and counted: clicks, scrolling and typing.

What Duet Web Control (DWC) 3.5.3 takes for them was counted in its source, from the view on which
somebody is. Nothing here may take more.
"""

import re
from typing import Any, Callable, NamedTuple

import pytest
from playwright.sync_api import expect

from tests.support import waiting

from .. import helpers
from . import (
    CONFIRM,
    SECONDS,
    both_hosts,
    heat_row,
    own_errors,
    part,
    show_view,
    wait_board,
    wait_text,
)
from .test_job import end_job

BOARD = {"machine": "cartesian", "speed": 10}

FILE = "0:/gcodes/counted.gcode"


class Hand:
    """What a person does at the page, counted."""

    def __init__(self, page):
        self.page = page
        self.steps = 0

    def click(self, control, **more):
        """Click on what is seen; to bring it into sight is a step as well."""
        expect(control).to_be_visible()
        expect(control).to_be_enabled()
        box = waiting.wait_for(control.bounding_box, SECONDS, "its place")
        if box["y"] < 0 or box["y"] + box["height"] > self.page.viewport_size["height"]:
            self.steps += 1
        control.click(**more)
        self.steps += 1

    def type(self, control, text):
        control.press_sequentially(text)
        self.steps += 1


def machine(hand):
    return hand.page.locator("#rrfmodel_machine")


def job(hand):
    return hand.page.locator("#rrfmodel_job")


def tool(hand):
    return heat_row(machine(hand), 1, tool=0)


def bed(hand):
    return heat_row(machine(hand), 0)


def preset(hand, row):
    hand.click(part(row, "presets"))
    hand.click(part(row, "preset").first)


def preheat(hand):
    preset(hand, tool(hand))
    hand.click(part(tool(hand), "tool-active"))


def jog(hand):
    hand.click(machine(hand).locator("[data-axis=X] [data-step='10']"))


def babystep(hand):
    hand.click(part(job(hand), "babystep-by").last)


def faster(hand):
    hand.click(part(part(job(hand), "speed-factor"), "more"))


def macro(hand):
    hand.click(part(machine(hand), "macro").filter(has_text="Say hello"))


def filament(hand):
    hand.click(part(machine(hand), "filaments"))
    hand.click(part(machine(hand), "load").filter(has_text="PLA"))


def layer(hand):
    hand.click(part(hand.page, "view-job"))
    expect(part(job(hand), "layer")).to_contain_text(re.compile(r"\d+ / \d+"))
    expect(part(job(hand), "job-ends")).to_contain_text("left")


def pause(hand):
    hand.click(part(job(hand), "pause"))


def cancel(hand):
    hand.click(part(job(hand), "cancel"))
    hand.click(hand.page.locator(CONFIRM))


def answer(hand):
    hand.click(hand.page.locator("#rrfmodel_box_dialog [data-test=box-ok]"))


def value(hand):
    hand.click(part(hand.page, "view-model"))
    find = part(hand.page, "find")
    hand.click(find)
    hand.type(find, "upTime")
    wait_text(hand.page.locator("#rrfmodel_model"), "upTime")


def fan(hand):
    slider = part(machine(hand), "slider").first
    box = slider.bounding_box()
    hand.click(slider, position={"x": box["width"] / 2, "y": box["height"] / 2})


def why(hand):
    wait_text(part(hand.page, "strip-state"), "Paused")


class Job(NamedTuple):
    name: str
    do: Callable[[Hand], Any]
    steps: int
    dwc: int
    key: str = ""
    """What of the board shows that it was done."""
    wanted: Any = None


def above(least):
    return lambda found: found is not None and found > least


IDLE = (
    Job(
        "home all axes",
        lambda hand: hand.click(part(machine(hand), "home-all")),
        1,
        1,
        "move.axes[].homed",
        lambda found: bool(found) and all(found),
    ),
    Job("jog X by 10 mm", jog, 1, 1, "move.axes[0].userPosition", above(9.9)),
    Job(
        "change the tool",
        lambda hand: hand.click(part(tool(hand), "select")),
        1,
        1,
        "state.currentTool",
        0,
    ),
    Job("preheat a tool", preheat, 3, 3, "heat.heaters[1].state", "active"),
    Job(
        "heat the bed",
        lambda hand: preset(hand, bed(hand)),
        2,
        2,
        "heat.heaters[0].state",
        "active",
    ),
    Job("fan to 50 %", fan, 1, 1, "fans[0].requestedValue", lambda found: abs(found - 0.5) < 0.051),
    Job("load filament", filament, 2, 3, "move.extruders[0].filament", "PLA"),
    Job("run a macro", macro, 1, 1),
    Job("answer a message box", answer, 1, 1, "state.messageBox", None),
    Job("find a value of the object model", value, 3, 4),
)
"""Beside a machine that does nothing; DWC's model is a tree without a search."""

PRINTING = (
    Job("layer and time left", layer, 1, 1),
    Job("baby step in a print", babystep, 1, 1, "move.axes[2].babystep", above(0.01)),
    Job("speed factor in a print", faster, 1, 1, "move.speedFactor", above(1.01)),
    Job("pause", pause, 1, 1, "state.status", "paused"),
    Job("why it isn't printing", why, 0, 0),
    Job("cancel", cancel, 2, 2, "state.status", "idle"),
)

JOBS = IDLE + PRINTING


def prepare(board):
    layers = (
        f";LAYER_CHANGE\n;Z:{number * 0.2 + 0.2:.1f}\nG1 Z{number * 0.2 + 0.2:.1f}\nG4 S3\n"
        for number in range(100)
    )
    board.card.write(FILE, "; layer_height = 0.2\n" + "".join(layers))


def done(job, page, server, board):
    """Do a job; return what it took."""
    hand = Hand(page)
    job.do(hand)
    if job.key:
        wait_board(server, board, job.key, job.wanted, SECONDS)
    return hand.steps


def counted(jobs, page, server, board):
    return {job.name: done(job, page, server, board) for job in jobs}


@pytest.mark.parametrize("job", JOBS, ids=lambda job: job.name)
def test_none_is_worse_than_in_dwc(job):
    assert job.steps <= job.dwc


@both_hosts
def test_beside_an_idle_machine(page, server, board, page_errors):
    board.board.execute("T-1", channel="http")
    helpers.wait_value(server, "state.currentTool", -1, SECONDS)
    view = show_view(page, "machine")
    expect(part(view, "macro")).not_to_have_count(0)
    found = {}
    for job in IDLE:
        page.evaluate("window.scrollTo(0, 0)")
        if job.do is answer:
            board.board.execute('M291 P"Is it?" S2', channel="http")
        found[job.name] = done(job, page, server, board)
    assert found == {job.name: job.steps for job in IDLE}
    for line in ("M568 P0 S0 A0", "M140 S0", "M106 P0 S0", "M702"):
        board.board.execute(line, channel="http")
    assert own_errors(page_errors) == []


@both_hosts
def test_beside_a_print(page, server, board, page_errors):
    show_view(page, "machine")
    board.board.execute(f'M32 "{FILE}"', channel="http")
    helpers.wait_value(server, "job.file.fileName", FILE, SECONDS)
    try:
        assert counted(PRINTING, page, server, board) == {job.name: job.steps for job in PRINTING}
    finally:
        end_job(server, board)
        board.board.speed = 10
        board.board.execute("M220 S100", channel="http")
    assert own_errors(page_errors) == []
