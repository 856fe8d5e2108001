"""Every control of Machine, Job and Console: each is used, and the board is looked at afterwards.

A control that no row of the tables is about fails a test, and so does a row without its control.
"""

import re
from typing import Any, Callable, NamedTuple

import pytest
from playwright.sync_api import expect

from tests.support.places import ROOT

from .. import helpers
from . import (
    CONFIRM,
    SECONDS,
    TOLD,
    board_value,
    both_hosts,
    home,
    own_errors,
    part,
    show_view,
    type_number,
    wait_board,
)
from .test_job import end_job

BOARD = {"machine": "toolchanger", "speed": 60}


USABLE = """(region) => {
    const isSeen = (each) => each.offsetParent !== null || each.closest("svg");
    // the content of a menu counts where the menu can be opened
    const opener = (each) => each.closest(".btn-group").querySelector("[data-toggle]");
    const isUsable = function (each) {
        if (each.matches(":disabled, .disabled *, [aria-disabled=true]")) return false;
        const isOfMenu = each.closest(".dropdown-menu");
        return isOfMenu ? isSeen(opener(each)) && !opener(each).disabled : isSeen(each);
    };
    const markOf = function (each) {
        const group = each.closest("[data-test=job-controls] [role=group]");
        const own = each.dataset.test || each.textContent.trim() || each.outerHTML.slice(0, 200);
        return group ? group.dataset.test + "/" + own : own;
    };
    const found = region.querySelectorAll("button, input, select, a, [role=button]");
    return Array.from(found).filter(isUsable).map(markOf);
}"""
"""The marks of what can be used now, seen or in a menu; of what is unmarked its text."""


class Use(NamedTuple):
    """How a control is used, and what is so afterwards."""

    act: Callable[[Any], Any]
    """Gets the control."""
    key: Any
    """Of the board's model; ``SENT`` or ``SHOWN``."""
    wanted: Any
    """Value, ``By`` or a predicate; what the board has received; what the page shows then."""
    place: str = ""
    """Selector of what the control is in, where several are marked so."""
    before: str = ""
    """G-code that makes it possible."""


class By(float):
    """A change of a number."""


SENT = "the board has received"
SHOWN = "the page shows"


def click(control):
    control.click()


def number(value):
    return lambda control: type_number(control, value)


def text(value):
    return lambda control: control.fill(value)


def from_menu(menu):
    """Return how to pick from a menu, which is open already where it was looked at last."""

    def act(control):
        if not control.is_visible():
            group = control.locator(
                "xpath=ancestor::*[contains(concat(' ', @class, ' '), ' btn-group ')]"
            )
            opener = group.locator(f"[data-test={menu}]")
            expect(opener).to_be_enabled()
            opener.click()
        control.click()

    return act


def then(first, mark, act=click):
    """Return an action that is followed by one on what it is for."""

    def both(control):
        first(control)
        act(part(control.page.locator("#rrfmodel_machine"), mark).locator("visible=true").first)

    return both


def read_again(control):
    """Click on what reads a folder of the card; what was read a moment ago isn't sent for again."""
    with control.page.expect_response(lambda answer: "/files" in answer.url and answer.ok):
        control.click()


def in_folder(control):
    """The same in a folder below, from which one gets back."""
    view = control.page.locator("#rrfmodel_machine")
    part(view, "macro-filter").fill("")
    part(view, "macro").filter(has_text="More").click()
    expect(part(view, "macro-up")).to_be_visible()
    read_again(control)


def seen(mark, count=None):
    """Return a check that what is marked so is seen, or as often."""

    def check(region):
        found = part(region, mark).locator("visible=true")
        if count is None:
            expect(found.first).to_be_visible()
        else:
            expect(found).to_have_count(count)

    return check


def at_the_top(region):
    expect(part(region, "macro-up")).to_be_hidden()
    expect(part(region, "macro")).to_have_count(3)


def every(wanted):
    return lambda found: bool(found) and all(each == wanted for each in found)


X = "[data-axis=X]"
LEFT = "[data-tool='1']"
BED = "[data-heater='0']"
X_AT = "move.axes[0].userPosition"
FED = "move.extruders[0].position"

MACHINE = {
    "home": Use(click, "move.axes[0].homed", True, X, before="M84"),
    "home-all": Use(click, "move.axes[].homed", every(True)),
    "go": Use(number(60), X_AT, 60, X),
    "plus": Use(click, X_AT, 61, X),
    "minus": Use(click, X_AT, 60, X),
    "jog": Use(click, X_AT, 10, X),
    "jog-speed": Use(then(text("1234"), "plus"), SENT, r"F1234\b"),
    "calibrate": Use(click, SENT, r"^G32$"),
    "mesh-menu": Use(click, SHOWN, seen("mesh-probe")),
    "mesh-probe": Use(from_menu("mesh-menu"), "move.compensation.type", "mesh"),
    "mesh-clear": Use(from_menu("mesh-menu"), "move.compensation.type", "none"),
    "mesh-load": Use(from_menu("mesh-menu"), "move.compensation.type", "mesh"),
    "select": Use(click, "state.currentTool", 1, LEFT),
    "active": Use(number(61), "tools[1].active[0]", 61, LEFT),
    "standby": Use(number(43), "tools[1].standby[0]", 43, LEFT),
    "tool-standby": Use(click, "heat.heaters[1].state", "standby", LEFT),
    "tool-active": Use(click, "heat.heaters[1].state", "active", LEFT),
    "tool-off": Use(click, "heat.heaters[1].state", "off", LEFT),
    "presets": Use(click, SHOWN, seen("preset"), BED),
    "preset": Use(from_menu("presets"), "heat.heaters[0].active", lambda now: now > 0, BED),
    "state-standby": Use(click, "heat.heaters[0].state", "standby", BED),
    "state-active": Use(click, "heat.heaters[0].state", "active", BED),
    "state-off": Use(click, "heat.heaters[0].state", "off", BED),
    "all-off": Use(click, "heat.heaters[].state", every("off"), before="M140 S40"),
    "reset-fault": Use(click, "heat.heaters[2].state", "off", before="heater_fault:2"),
    "extrude": Use(click, FED, By(1)),
    "retract": Use(click, FED, By(-1)),
    "extrude-length": Use(number(6), FED, By(6)),
    "extrude-speed": Use(then(text("7"), "extrude"), SENT, r"F420\b"),
    "filaments": Use(click, SHOWN, seen("load")),
    "load": Use(from_menu("filaments"), "move.extruders[0].filament", "PLA"),
    "unload": Use(click, "move.extruders[0].filament", ""),
    "deselect": Use(click, "state.currentTool", -1),
    "slider": Use(text("80"), "fans[0].requestedValue", 0.8),
    "speed": Use(number(55), "fans[0].requestedValue", 0.55),
    "speed-factor-field": Use(number(120), "move.speedFactor", 1.2),
    "speed-more": Use(click, "move.speedFactor", 1.25),
    "speed-less": Use(click, "move.speedFactor", 1.2),
    "extrusion-factor": Use(number(95), "move.extruders[0].factor", 0.95),
    "extrusion-more": Use(click, "move.extruders[0].factor", 0.96),
    "extrusion-less": Use(click, "move.extruders[0].factor", 0.95),
    "all-extruders": Use(click, SHOWN, seen("extruder", 4)),
    "babystep-by": Use(click, "move.axes[2].babystep", -0.05),
    "babystep-clear": Use(click, "move.axes[2].babystep", 0),
    "macro-filter": Use(text("HELL"), SHOWN, seen("macro", 1)),
    "macro": Use(click, SENT, r'^M98 P"0:/macros/Say hello"'),
    "macros": Use(in_folder, SHOWN, seen("macro", 1)),
    "macro-up": Use(click, SHOWN, at_the_top),
}

FOLDS = {
    "link": Use(
        lambda control: None,
        SHOWN,
        lambda region: expect(part(region, "link").first).to_have_attribute(
            "href", re.compile("^http")
        ),
    ),
    "shaper-damping": Use(number(0.2), "move.shaping.damping", 0.2),
    "offset": Use(number(0.5), "tools[1].offsets[0]", 0.5, "[data-test=offsets-of][data-tool='1']"),
}
"""What is in the sections of Machine that fold; the sections themselves are opened for it."""

CONSOLE = {
    "console-input": Use(
        lambda control: (control.fill("M220 S90"), control.press("Enter")), "move.speedFactor", 0.9
    ),
    "console-send": Use(
        lambda control: (
            part(control.page, "console-input").fill("M220 S100"),
            control.click(),
        ),
        "move.speedFactor",
        1,
    ),
    "console-filter": Use(text("nothing is like this"), SHOWN, seen("console-line", 0)),
    "console-clear": Use(
        lambda control: (
            part(control.page, "console-filter").fill(""),
            control.click(),
        ),
        SHOWN,
        seen("console-line", 0),
    ),
}


def confirmed(control):
    control.click()
    control.page.locator(CONFIRM).click()


def by_enter(control):
    """Objects of the simulated board lie one on the other, so that only one is hit by a pointer."""
    # the page knows a little later that the object is printed again
    expect(control).to_have_attribute("aria-label", re.compile("Cancel"))
    control.press("Enter")
    control.page.locator(CONFIRM).click()


ENTRY = "[data-test=card-entry]:has-text('{}')"
LAST = "job.lastFileName"
SHORT = "0:/gcodes/short.gcode"
OTHER = "0:/gcodes/other.gcode"
LONG = "0:/gcodes/long.gcode"

CARD = {
    # a file that is selected can be used so as long as nothing was printed
    "simulate": Use(click, SENT, rf'^M37 P"{OTHER}"', before='M23 "other.gcode"'),
    "card-open": Use(click, SHOWN, seen("card-folder"), ENTRY.format("Spare parts")),
    "card-up": Use(click, SHOWN, seen("card-folder", 0)),
    "card-read": Use(read_again, SHOWN, seen("card-entry")),
    "card-print": Use(confirmed, LAST, SHORT, ENTRY.format("short.gcode")),
    "card-simulate": Use(click, SENT, rf'^M37 P"{OTHER}"', ENTRY.format("other.gcode")),
    "past-again": Use(
        confirmed,
        SENT,
        rf'^M32 "{SHORT}"',
        "[data-test=past-job]:has([data-test=past-name]:text('short'))",
    ),
    "start-last": Use(confirmed, SENT, rf'^M32 "{SHORT}"'),
    "simulate-last": Use(click, SENT, rf'^M37 P"{SHORT}"'),
}
"""Without a print."""

TURN = "[data-test={}]"

PRINT = {
    "speed-factor/turned": Use(number(110), "move.speedFactor", 1.1, TURN.format("speed-factor")),
    "speed-factor/more": Use(click, "move.speedFactor", 1.15, TURN.format("speed-factor")),
    "speed-factor/less": Use(click, "move.speedFactor", 1.1, TURN.format("speed-factor")),
    "flow/turned": Use(number(110), "move.extruders[0].factor", 1.1, TURN.format("flow")),
    "flow/more": Use(click, "move.extruders[0].factor", 1.11, TURN.format("flow")),
    "flow/less": Use(click, "move.extruders[0].factor", 1.1, TURN.format("flow")),
    "fan/turned": Use(number(40), "fans[0].requestedValue", 0.4, TURN.format("fan")),
    "fan/more": Use(click, "fans[0].requestedValue", 0.45, TURN.format("fan")),
    "fan/less": Use(click, "fans[0].requestedValue", 0.4, TURN.format("fan")),
    "tool/turned": Use(number(50), "tools[1].active[0]", 50, TURN.format("tool")),
    "tool/more": Use(click, "tools[1].active[0]", 55, TURN.format("tool")),
    "tool/less": Use(click, "tools[1].active[0]", 50, TURN.format("tool")),
    "bed/turned": Use(number(30), "heat.heaters[0].active", 30, TURN.format("bed")),
    "bed/more": Use(click, "heat.heaters[0].active", 35, TURN.format("bed")),
    "bed/less": Use(click, "heat.heaters[0].active", 30, TURN.format("bed")),
    "babystep/babystep-by": Use(
        click, "move.axes[2].babystep", -0.05, "[data-test=job-controls] [data-test=babystep]"
    ),
    "babystep/babystep-clear": Use(
        click, "move.axes[2].babystep", 0, "[data-test=job-controls] [data-test=babystep]"
    ),
    "object-cancel": Use(confirmed, "job.build.objects[0].cancelled", True),
    "object-resume": Use(click, "job.build.objects[0].cancelled", False),
    "map-object": Use(by_enter, "job.build.objects[0].cancelled", True),
    "pause": Use(click, "state.status", "paused"),
    "resume": Use(click, "state.status", "processing"),
    "cancel": Use(confirmed, "state.status", "idle"),
}
"""While the board prints from its card."""

BODY = "".join(
    f';LAYER_CHANGE\nM486 S{number % 2} A"Piece {number % 2}"\n'
    f"G1 X{20 + 60 * (number % 2)} Y20 F6000\nG1 X{40 + 60 * (number % 2)} Y40 E1\nG4 S2\n"
    for number in range(400)
)

ELSEWHERE = {
    "extent": "test_job",
    "past-all": "test_job_idle",
    "start": "test_job",
    **dict.fromkeys(
        (
            "action",
            "advance",
            "condition",
            "current",
            "keep",
            "limit",
            "probe-height",
            "probe-measure",
            "probe-set",
            "resume-print",
            "return",
            "save-parameters",
            "shaper",
            "shaper-frequency",
            "sound",
            "tune",
            "update",
            "variable-value",
        ),
        "test_panels",
    ),
}
"""What another module of these tests uses, with more to look at."""


def prepare(board):
    board.card.write("0:/macros/More/Park.g", "M117 parked\n")
    # long enough to be seen, and so to be among the last ones
    board.card.write(SHORT, "G4 S300\n")
    board.card.write(OTHER, "G4 P300\n")
    board.card.write(LONG, "T1\n" + BODY)


def fits(wanted):
    if callable(wanted):
        return wanted
    if isinstance(wanted, (int, float)) and not isinstance(wanted, bool):
        return lambda found: found is not None and abs(found - wanted) < 1e-3
    return lambda found: found == wanted


def make_possible(server, board, use):
    if not use.before:
        return
    if ":" in use.before:
        board.board.inject(use.before)
    else:
        board.board.execute(use.before, channel="http")


def use_one(page, region, server, board, mark, use):
    """Use a control; return once that shows where it has to."""
    control = region.locator(f"{use.place} [data-test={mark.rpartition('/')[2]}]")
    of_menu = control.first.locator("xpath=ancestor::ul").count()
    control = control.first if of_menu else control.locator("visible=true").first
    make_possible(server, board, use)
    if not of_menu:
        expect(control).to_be_enabled()
    sent_before = len(helpers.commands(board))
    wanted = use.wanted
    if isinstance(wanted, By):
        wanted = board_value(board, use.key) + wanted
    use.act(control)
    if use.key == SENT:
        server.wait_for(
            lambda: any(re.search(wanted, line) for line in helpers.commands(board)[sent_before:]),
            SECONDS,
            f"{wanted} to be sent",
        )
    elif use.key == SHOWN:
        wanted(region)
    else:
        wait_board(server, board, use.key, fits(wanted))


def use_all(page, region, server, board, table):
    """Use what the table has; return the marks of all that could be used in between."""
    usable = set(region.evaluate(USABLE))
    for mark, use in table.items():
        try:
            use_one(page, region, server, board, mark, use)
        except Exception as error:
            told = page.locator(TOLD).all_inner_texts()
            raise AssertionError(f"{mark}: {error}; {told}") from error
        usable |= {mark, *region.evaluate(USABLE)}
        if table is CARD and use.key in (LAST, SENT):
            # until the page knows that it is over, it refuses the next one
            server.wait_for(lambda: not board.board.job.is_printing, SECONDS, "the end of the job")
            helpers.wait_polls(server, 2)
            helpers.wait_value(server, "state.status", "idle", SECONDS)
            server.wait_state("Operational")
        elif table is PRINT and use.key not in (SENT, SHOWN):
            # a step goes from what is shown
            helpers.wait_polls(server, 2)
    return usable


@pytest.fixture
def view(page, server, board):
    board.board.speed = 60
    return show_view(page, "machine")


@both_hosts
def test_machine(page, view, server, board, page_errors):
    expect(part(view, "macro")).to_have_count(3)
    # nothing has to be heated for it
    board.board.execute("M302 S0 R0", channel="http")
    helpers.wait_value(server, "heat.coldExtrudeTemperature", 0, SECONDS)
    usable = use_all(page, view, server, board, MACHINE)
    assert usable == set(MACHINE)
    assert own_errors(page_errors) == []


@both_hosts
def test_sections_of_machine(page, view, server, board, page_errors):
    parts = page.locator("#rrfmodel_machine_parts")
    heads = parts.locator("[data-test^=fold-]:visible")
    expect(heads.first).to_be_visible()
    names = {head.get_attribute("data-test") for head in heads.all()}
    for name in names:
        part(parts, name).click()
        expect(part(parts, name)).to_have_attribute("aria-expanded", "true")
    usable = use_all(page, parts, server, board, FOLDS)
    assert usable - names - set(ELSEWHERE) == set(FOLDS)
    assert own_errors(page_errors) == []


@both_hosts
def test_console(page, server, board, page_errors):
    region = show_view(page, "console")
    assert use_all(page, region, server, board, CONSOLE) == set(CONSOLE)
    assert own_errors(page_errors) == []


@both_hosts
def test_job_without_a_print(page, view, server, board, page_errors):
    region = show_view(page, "job")
    usable = use_all(page, region, server, board, CARD)
    # a job that is seen for a moment has its own
    assert usable - set(ELSEWHERE) - set(PRINT) == set(CARD)
    assert own_errors(page_errors) == []


@both_hosts
def test_job_with_a_print(page, view, server, board, page_errors):
    home(server, board)
    board.board.speed = 2
    board.board.execute(f'M32 "{LONG}"', channel="http")
    helpers.wait_value(server, "job.build.objects", lambda found: found and len(found) > 1, SECONDS)
    try:
        region = show_view(page, "job")
        expect(part(region, "object-cancel").first).to_be_visible()
        usable = use_all(page, region, server, board, PRINT)
    finally:
        end_job(server, board)
    assert usable - set(ELSEWHERE) - set(CARD) == set(PRINT)
    assert own_errors(page_errors) == []


@pytest.mark.parametrize("mark", ELSEWHERE)
def test_others_are_used_elsewhere(mark):
    module = ROOT / "tests" / "e2e" / "page" / f"{ELSEWHERE[mark]}.py"
    assert f'"{mark}"' in module.read_text(encoding="utf-8")
