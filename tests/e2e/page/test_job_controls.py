"""The sub-view Job: what is turned during a print, and what a click says at once."""

import pytest
from playwright.sync_api import expect

from .. import helpers
from . import CONFIRM, SECONDS, own_errors, part, show_view, type_number, wait_board
from .test_job import end_job

BOARD = {"machine": "corexy"}

JOB = "#rrfmodel_job"

CLICK = """([selector, name]) => {
    document.querySelector(selector).click();
    const job = document.querySelector("#rrfmodel_job");
    const button = job.querySelector(`[data-test=${name}]`);
    return {
        busy: button.getAttribute("aria-busy"),
        disabled: button.disabled,
        title: button.title,
        status: job.querySelector("[data-test=status]").innerText,
    };
}"""
"""Clicks on an element and returns what a button and the state say then."""

FILE = "0:/gcodes/long.gcode"

LONG = "".join(f"G4 P{400 + number % 2}\n" for number in range(600))


def prepare(board):
    board.card.write(FILE, LONG)


@pytest.fixture(params=["card", "octoprint"])
def printing(request, server, board):
    """A print of either kind, with a tool that is in use."""
    board.board.execute("T0", channel="http")
    board.board.execute("M568 P0 S200 R100 A2", channel="http")
    helpers.wait_value(server, "state.currentTool", 0, SECONDS)
    # behind a print's first line it may be long until the model has it
    helpers.wait_value(server, "tools[0].active[0]", 200, SECONDS)
    if request.param == "card":
        board.board.execute(f'M32 "{FILE}"', channel="http")
        helpers.wait_value(server, "job.file.fileName", FILE, SECONDS)
    else:
        server.upload("long.gcode", LONG)
        server.select_and_print("long.gcode")
        server.wait_state("Printing")
    yield request.param
    if request.param == "card":
        end_job(server, board)
    elif server.job()["state"] != "Operational":
        server.post("/api/job", json={"command": "cancel"})
    server.wait_state("Operational")
    board.board.execute("M568 P0 S0 R0 A0", channel="http")


TURNED = [
    ("speed-factor", "more", "move.speedFactor", 1.05),
    ("flow", "less", "move.extruders[0].factor", 0.99),
    ("fan", "more", "fans[0].requestedValue", 0.05),
    ("tool", "less", "tools[0].active[0]", 195),
    ("bed", "more", "heat.heaters[0].active", 5),
]


def test_what_is_turned_during_a_print(page, server, board, printing, page_errors):
    view = show_view(page, "job")
    expect(part(view, "speed-factor")).to_be_visible()
    # a step goes from what is shown
    expect(part(part(view, "tool").first, "turned")).to_have_value("200")
    for name, button, key, value in TURNED:
        part(part(view, name).first, button).click()
        wait_board(server, board, key, lambda found, value=value: abs(found - value) < 1e-6)
    type_number(part(part(view, "speed-factor"), "turned"), 100)
    wait_board(server, board, "move.speedFactor", 1)
    baby = part(view, "babystep")
    part(baby, "babystep-by").nth(3).click()
    wait_board(server, board, "move.axes[2].babystep", 0.05)
    expect(part(baby, "babystep-value")).to_have_text("0.050 mm")
    part(baby, "babystep-clear").click()
    wait_board(server, board, "move.axes[2].babystep", 0)
    for line in ("M221 D0 S100", "M106 P0 S0", "M140 S0"):
        board.board.execute(line, channel="http")
    assert own_errors(page_errors) == []


UNKNOWN = """() => {
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    const move = core.latest.move;
    const tell = (changed) => core.onDataUpdaterPluginMessage("rrfmodel",
        {type: "model", changed, status: core.status()});
    tell({move: Object.assign({}, move, {speedFactor: null})});
    return new Promise((done) => setTimeout(() => {
        const row = document.querySelector("#rrfmodel_job [data-test=speed-factor]");
        const found = Array.from(row.querySelectorAll("[data-test=less], [data-test=more]"))
            .map((button) => button.disabled);
        tell({move: move});
        done(found);
    }));
}"""


def test_a_step_from_what_is_not_known_is_not_offered(page, server, board, printing):
    view = show_view(page, "job")
    expect(part(part(view, "speed-factor"), "more")).to_be_enabled()
    assert page.evaluate(UNKNOWN) == [True, True]
    expect(part(part(view, "speed-factor"), "more")).to_be_enabled()


def test_a_click_is_answered_at_once(page, server, board, printing):
    view = show_view(page, "job")
    for name, text in (("pause", "Pausing …"), ("cancel", "Cancelling …")):
        button = part(view, name)
        expect(button).to_be_enabled()
        if name == "cancel":
            button.click()
            page.locator(CONFIRM).wait_for()
        # read in the same breath, as a print may pause before anybody has looked
        clicked = page.evaluate(
            CLICK, [CONFIRM if name == "cancel" else f"{JOB} [data-test=pause]", name]
        )
        assert clicked == {"busy": "true", "disabled": True, "title": text, "status": text}
        if name == "pause":
            expect(button).not_to_have_attribute("aria-busy", "true")
            expect(part(view, "status")).to_have_text("Paused")
            expect(button).to_have_attribute("title", "The print is paused.")
    expect(part(view, "cancel")).to_be_hidden()


def test_who_may_only_look_turns_nothing(reader_page, printing):
    view = show_view(reader_page, "job")
    expect(part(view, "speed-factor")).to_be_visible()
    for name in ("more", "less", "turned", "babystep-by"):
        expect(part(view, name).first).to_be_disabled()
