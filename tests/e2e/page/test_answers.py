"""An answer to every click: a mark until the machine shows the effect, and what it says to it."""

import re

import pytest
from playwright.sync_api import expect

from tests.support.waiting import within

from .. import helpers
from . import SECONDS, TOLD, both_hosts, own_errors, part, show_view, type_number

BOARD = {"machine": "cartesian"}

MARK = """([selector, act]) => new Promise((resolve) => {
    const element = document.querySelector(selector);
    let begun = performance.now();
    document.addEventListener("change", () => (begun = performance.now()), {capture: true});
    const log = (window.marks = {marked: null, over: null});
    const seen = () => window.seen && window.seen(element);
    new MutationObserver(function () {
        const isBusy = element.getAttribute("aria-busy") === "true";
        if (isBusy && log.marked === null)
            Object.assign(log, {marked: performance.now() - begun, first: seen()});
        if (!isBusy && log.marked !== null && log.over === null)
            log.over = {after: performance.now() - begun, seen: seen()};
    }).observe(element, {attributes: true, attributeFilter: ["aria-busy"]});
    if (act) element.click();
    resolve();
})"""
"""Clicks, and notes when the mark comes and goes, and what is seen as it does.

The time counts from the click, or from when something is entered.
"""

AXES = """() => { window.seen = () =>
    OctoPrint.coreui.viewmodels.rrfModelViewModel.latest.move.axes.map((axis) => axis.homed); }"""

FIELD = """() => { window.seen = (field) => {
    const {x, y, width, height} = field.getBoundingClientRect();
    return [field.value, x, y, width, height];
}; }"""

AT_ONCE_MS = 200


@pytest.fixture(autouse=True)
def _at_speed(server, board):
    yield
    board.board.speed = 300
    server.wait_for(lambda: helpers.status(server)["doing"] is None, SECONDS, "a free line")
    board.board.speed = 1


def wait_over(page, server, seconds=SECONDS):
    """Return when the mark came, and what was seen as it went."""
    marks = {}

    def is_over():
        marks.update(page.evaluate("window.marks"))
        return marks["over"]

    server.wait_for(is_over, seconds, "the end of the mark")
    return marks


@both_hosts
def test_homing_is_marked_until_the_axes_are_homed(page, server, board, page_errors):
    view = show_view(page, "machine")
    board.board.execute("M84", channel="http")
    helpers.wait_value(server, "move.axes[].homed", lambda homed: not any(homed), SECONDS)
    expect(part(page, "strip-state")).to_have_text("Idle")
    board.board.speed = 2
    page.evaluate(AXES)
    place = part(view, "home-all").bounding_box()
    page.evaluate(MARK, ["#rrfmodel_machine [data-test=home-all]", True])
    expect(part(page, "strip-state")).to_have_text(re.compile("Homing"))
    assert part(view, "home-all").bounding_box() == place
    marks = wait_over(page, server)
    assert marks["marked"] < within(AT_ONCE_MS / 1000) * 1000
    assert marks["over"]["seen"] == [True, True, True]
    assert part(view, "home-all").bounding_box() == place
    assert own_errors(page_errors) == []


def test_a_number_shows_what_was_sent_until_the_machine_does(page, server, board):
    view = show_view(page, "machine")
    field = part(view, "active").first
    before = field.bounding_box()
    shown = ["43", *(before[name] for name in ("x", "y", "width", "height"))]
    page.evaluate(FIELD)
    page.evaluate(MARK, ["#rrfmodel_machine [data-test=active]", False])
    type_number(field, 43)
    marks = wait_over(page, server)
    assert marks["marked"] < within(AT_ONCE_MS / 1000) * 1000
    assert marks["first"] == marks["over"]["seen"] == shown
    heaters = helpers.value(server, "heat.heaters")
    assert 43 in [heater["active"] for heater in heaters if heater]
    type_number(field, 0)
    expect(field).not_to_have_attribute("aria-busy", "true")


@pytest.mark.parametrize(
    ("code", "said"),
    [
        ('M98 P"missing.g"', "Macro file missing.g not found"),
        ("echo {1+2}", "3"),
    ],
)
def test_what_the_machine_answers_is_told(page, server, board, code, said):
    show_view(page, "machine")
    told = page.locator(TOLD).filter(has_text=said)
    page.evaluate("(code) => { OctoPrint.coreui.viewmodels.rrfModelViewModel.script(code); }", code)
    expect(told).to_have_count(1)


def test_an_error_is_told_in_red(page, server, board):
    show_view(page, "machine")
    page.evaluate(
        """() => { OctoPrint.coreui.viewmodels.rrfModelViewModel.script("M563 P77 D99"); }"""
    )
    told = page.locator(".ui-pnotify:visible .alert-error").filter(has_text="Error:")
    expect(told).to_have_count(1)
    # where it lies on no button that stops something
    assert told.bounding_box()["y"] > 600


def test_what_others_ask_is_told_to_nobody(page, server):
    show_view(page, "machine")
    server.commands('M98 P"nowhere.g"')
    lines = lambda: server.get("/plugin/rrfmodel/console").json()["lines"]  # noqa: E731
    server.wait_for(
        lambda: [line for line in lines() if "nowhere.g not found" in line["message"]],
        SECONDS,
        "the reply",
    )
    helpers.wait_polls(server, 2)
    assert page.locator(TOLD).filter(has_text="nowhere.g").count() == 0


@pytest.mark.parametrize(("action", "says"), [("pause", "Pausing…"), ("cancel", "Cancelling…")])
def test_a_job_that_is_to_end_says_so_at_once(page, server, board, action, says):
    show_view(page, "chart")
    board.board.speed = 5
    board.board.execute('M32 "square.gcode"', channel="http")
    helpers.wait_value(server, "state.status", "processing", SECONDS)
    state = part(page, "strip-state")
    expect(state).to_contain_text("Printing")
    shown = page.evaluate(
        """(action) => {
            const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
            window.over = false;
            core.command("job", {action}).shown.always(() => (window.over = true));
            return new Promise((done) => setTimeout(() => done(
                document.querySelector("[data-test=strip-state]").innerText)));
        }""",
        action,
    )
    # before the board can have said anything
    assert shown == says
    server.wait_for(lambda: page.evaluate("window.over"), SECONDS, "the end of the mark")
    expect(state).to_have_text("Paused" if action == "pause" else re.compile("Idle|Busy"))
    board.board.execute("M25\nM0", channel="http")
    helpers.wait_value(server, "state.status", "idle", SECONDS)


FORBIDDEN = """(command) => OctoPrint.coreui.viewmodels.rrfModelViewModel.forbidden(command)"""

STREAMED = "G92 X20 Y20 Z1\n" + "G1 X21 F600\nG1 X20 F600\n" * 1000


def test_what_a_print_forbids_is_known_with_its_reason(page, server, board):
    show_view(page, "machine")
    assert page.evaluate(FORBIDDEN, "jog") == ""
    server.upload("streamed.gcode", STREAMED)
    server.select_and_print("streamed.gcode")
    server.wait_state("Printing")
    server.wait_for(lambda: page.evaluate(FORBIDDEN, "jog"), SECONDS, "the reason")
    for command, values in (
        ("jog", {"axes": {"X": 1}}),
        ("home", {}),
        ("select_tool", {"tool": 0}),
        ("macro", {"path": "x.g"}),
    ):
        assert page.evaluate(FORBIDDEN, command) == "Not while a print runs."
        # as the server sees it
        answer = server.post("/api/plugin/rrfmodel", json={"command": command, **values})
        assert answer.status_code == 409, command
    assert page.evaluate(FORBIDDEN, "fan") == ""
    server.post("/api/job", json={"command": "pause"})
    server.wait_state("Paused", 60)
    server.wait_for(lambda: page.evaluate(FORBIDDEN, "jog") == "", SECONDS, "a paused print")
    assert page.evaluate(FORBIDDEN, "home") == "Not before the print is over."
    server.post("/api/job", json={"command": "cancel"})
    server.wait_state("Operational", 60)
    server.wait_for(lambda: page.evaluate(FORBIDDEN, "home") == "", SECONDS, "no print")


QUESTION = """(text) => OctoPrint.coreui.viewmodels.rrfModelViewModel.confirm(
    "title " + text, "message " + text, "proceed " + text, () => (window.proceeded = true))"""


def test_a_question_is_text_wherever_its_words_come_from(page, page_errors):
    show_view(page, "machine")
    name = "<img src=x onerror=alert(1)><b>&amp;"
    page.evaluate(QUESTION, name)
    question = page.locator(".modal.in")
    expect(question.locator("h3")).to_have_text(f"title {name}")
    expect(question.locator(".modal-body p").first).to_have_text(f"message {name}")
    expect(question.locator(".btn-danger")).to_have_text(f"proceed {name}")
    assert question.locator("img, b").count() == 0
    question.locator(".btn-danger").click()
    expect(question).to_have_count(0)
    assert page.evaluate("window.proceeded") is True
    assert own_errors(page_errors) == []


QUICK = """() => {
    const told = ko.observable(100);
    const core = {
        received: ko.observable({age: 0, at: Date.now()}), status: ko.observable({blocked: null})
    };
    const given = RRFModel.lastGiven(core, () => [told()]);
    const shown = [];
    const open = $.Deferred();
    for (const sent of [95, 96]) given.send([sent], open);
    for (const value of [100, 95, 96, 90]) {
        told(value);
        shown.push(given.values()[0]);
    }
    return shown;
}"""


def test_what_was_sent_first_is_no_news_when_the_machine_tells_it(page):
    """Or a third click, counted from it, would take back the second."""
    assert page.evaluate(QUICK) == [96, 96, 96, 90]
