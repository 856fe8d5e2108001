"""The strip above every sub-view: of one height whatever comes and goes, each thing said once."""

import re

import pytest
from playwright.sync_api import expect

from .. import helpers
from . import SECONDS, TOLD, both_hosts, own_errors, part, show_view

BOARD = {"machine": "cartesian", "speed": 5}

IS_WHOLE = """(name) => {
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    const before = core.status();
    const told = core.onDataUpdaterPluginMessage;
    core.onDataUpdaterPluginMessage = () => undefined;
    core.fromStatus(Object.assign({}, before, {warnings: []}));
    return new Promise((done) => setTimeout(done, 50)).then(function () {
        const found = name.scrollWidth <= name.clientWidth + 1;
        core.onDataUpdaterPluginMessage = told;
        core.fromStatus(before);
        return found;
    });
}"""
"""Whether a text isn't cut while nothing is wrong with the machine."""

VIEWS = ("machine", "job", "chart", "console", "model")

STREAMED = "G92 X20 Y20 Z1\n" + "G1 X21 F600\nG1 X20 F600\n" * 1000

FAULT = re.compile("Heater .* reports a fault")

PLACE = """() => [document.querySelector("[data-test=strip]"),
    document.querySelector(".rrfmodel-region")].map((element) => {
        const {top, height} = element.getBoundingClientRect();
        return element.dataset.test ? [Math.round(top), Math.round(height)] : Math.round(top);
    })"""
"""Where the strip is and how high, and where what follows it begins."""

WATCH = """(place) => {
    window.places = new Set();
    const look = () => window.places.add(JSON.stringify(eval(place)()));
    const always = () => { look(); window.looking = requestAnimationFrame(always); };
    always();
}"""


DIALOGS = """() => {
    window.dialogs = 0;
    $("#rrfmodel_box_dialog").on("show", () => { window.dialogs += 1; });
}"""
"""Counts the dialogs that open, however soon they close again."""


@pytest.fixture
def strip(page):
    return part(page, "strip")


def faults(region):
    """Return the rows of the strip about heaters."""
    return part(region, "strip-alert").filter(has_text=FAULT)


def places(page):
    """Return the different places in which the strip has been since it was watched."""
    return page.evaluate("cancelAnimationFrame(window.looking), Array.from(window.places)")


@both_hosts
def test_says_state_tool_position_and_age_on_each_view(page, strip, board, page_errors):
    board.board.execute("T0", channel="http")
    for view in VIEWS:
        show_view(page, view)
        expect(part(strip, "strip-state")).to_have_text("Idle")
        expect(part(strip, "strip-tool")).to_have_text("T0 E0")
        expect(part(strip, "strip-position")).to_have_text(re.compile(r"X \d+\.\d Y .* Z "))
        expect(part(strip, "strip-age")).to_have_text(re.compile(r"\d s ago"))
    board.board.execute("T-1 P0", channel="http")
    assert own_errors(page_errors) == []


def test_nothing_moves_while_a_machine_homes_and_has_a_fault(page, strip, board):
    show_view(page, "machine")
    expect(part(strip, "strip-state")).to_have_text("Idle")
    page.evaluate(WATCH, PLACE)
    board.board.speed = 2
    part(page, "home-all").click()
    expect(part(strip, "strip-state")).to_have_text(re.compile("Homing"))
    board.board.inject("heater_fault:1")
    expect(faults(strip)).to_contain_text("Heater E0 reports a fault")
    board.board.execute('M117 "A long message to the people in front"', channel="http")
    expect(part(strip, "strip-state")).to_have_text("Idle")
    faults(strip).locator("[data-test=strip-fix]").click()
    expect(faults(strip)).to_have_count(0)
    assert len(places(page)) == 1


def test_a_fault_is_said_once_and_mended_there(page, strip, server, board):
    show_view(page, "chart")
    page.evaluate(DIALOGS)
    board.board.inject("heater_fault:1")
    expect(faults(strip)).to_contain_text("Heater E0 reports a fault")
    helpers.wait_value(server, "state.messageBox", lambda box: box is not None, SECONDS)
    helpers.wait_polls(server, 2)
    # neither as a dialog nor as a notification, nor beside it
    assert page.evaluate("window.dialogs") == 0
    assert page.locator(TOLD).count() == 0
    assert page.locator("#sidebar_plugin_rrfmodel [data-test=warning]").count() == 0
    said = page.locator("body").inner_text()
    assert len(FAULT.findall(said)) == 1
    colour = "element => getComputedStyle(element).backgroundColor"
    assert faults(strip).evaluate(colour) == "rgb(168, 50, 45)"
    part(strip, "strip-fix").first.click()
    helpers.wait_value(server, "heat.heaters[1].state", lambda state: state != "fault", SECONDS)
    # what the board has told with a box of its own is answered with it
    helpers.wait_value(server, "state.messageBox", None, SECONDS)
    expect(faults(strip)).to_have_count(0)
    assert page.evaluate("window.dialogs") == 0


def test_who_sees_no_strip_is_told_by_a_notification(page, strip, server, board):
    page.locator('#tabs a[href="#term"]').evaluate("link => link.click()")
    board.board.inject("heater_fault:1")
    told = page.locator(TOLD).filter(has_text="Heater E0 reports a fault")
    expect(told).to_have_count(1)
    # and in the sidebar, which stays
    aside = page.locator("#sidebar_plugin_rrfmodel [data-test=warning]")
    expect(aside).to_contain_text("Heater E0 reports a fault")
    show_view(page, "machine")
    expect(faults(strip)).to_contain_text("Heater E0 reports a fault")
    expect(told).to_have_count(0)
    part(strip, "strip-fix").first.click()
    expect(faults(strip)).to_have_count(0)


def test_several_warnings_have_one_row_and_open_over_the_view(page, strip, board):
    show_view(page, "machine")
    board.board.inject("heater_fault:0")
    board.board.inject("heater_fault:1")
    alerts = faults(strip)
    expect(alerts).to_have_count(2)
    expect(alerts.locator("visible=true")).to_have_count(1)
    before = page.evaluate(PLACE)
    more = part(strip, "strip-more")
    more.press("Enter")
    expect(alerts.locator("visible=true")).to_have_count(2)
    assert page.evaluate(PLACE) == before
    more.press("Escape")
    expect(alerts.locator("visible=true")).to_have_count(1)
    board.board.clear("heater_fault")
    board.board.execute("M562", channel="http")
    expect(alerts).to_have_count(0)


@both_hosts
def test_a_streamed_print_is_told_in_one_line(page, strip, server, page_errors):
    show_view(page, "model")
    server.upload("streamed.gcode", STREAMED)
    server.select_and_print("streamed.gcode")
    job = part(strip, "strip-job")
    expect(job).to_contain_text("streamed.gcode")
    expect(job).to_contain_text("%")
    expect(part(strip, "strip-state")).to_contain_text("Printing")
    server.post("/api/job", json={"command": "cancel"})
    server.wait_state("Operational", 60)
    expect(job).to_have_text(re.compile(r"^\s*$"))
    assert own_errors(page_errors) == []


def test_a_job_of_the_board_is_told_in_one_line(page, strip, board):
    show_view(page, "chart")
    name = "Chess set (4 pieces).gcode"
    board.board.card.write(f"0:/gcodes/{name}", "G4 S2\n" * 300)
    board.board.execute(f'M32 "{name}"', channel="http")
    job = part(strip, "strip-job")
    expect(job).to_contain_text(name)
    expect(job).to_contain_text(re.compile(r"\d %"))
    # whole, as long as nothing stands beside it
    assert page.locator(".rrfmodel-strip-name").evaluate(IS_WHOLE)
    board.board.execute("M25", channel="http")
    expect(part(strip, "strip-state")).to_have_text("Paused")
    board.board.execute("M0", channel="http")
    expect(job).to_have_text(re.compile(r"^\s*$"))


@both_hosts
def test_without_a_machine_it_says_so_and_connects(page, strip, server, board, page_errors):
    view = show_view(page, "machine")
    # a list of the card that is cut off is an error of the network in the browser's log
    expect(part(view, "macro").first).to_be_visible()
    before = page.evaluate(PLACE)
    helpers.disconnect(server)
    expect(part(strip, "strip-state")).to_have_text("Not connected")
    assert page.evaluate(PLACE) == before
    for view in ("chart", "console"):
        part(page, f"view-{view}").click()
        expect(part(strip, "no-machine")).to_be_visible()
    part(strip, "strip-fix").click()
    expect(part(strip, "strip-state")).to_have_text("Idle")
    assert own_errors(page_errors) == []


def test_halted_it_has_the_restart(page, strip, server, board):
    show_view(page, "job")
    before = page.evaluate(PLACE)
    board.board.execute("M112", channel="http")
    expect(part(strip, "strip-state")).to_have_text("Halted")
    fix = part(strip, "strip-fix").locator("visible=true")
    expect(fix).to_have_text("Restart the machine")
    assert page.evaluate(PLACE) == before
    restarts_before = helpers.restarts(server)
    fix.click()
    server.wait_for(lambda: not board.board.is_halted, 60, "the restart")
    helpers.wait_restarted(server, restarts_before)
    expect(part(strip, "strip-state")).to_have_text("Idle")


def test_a_reader_sees_what_is_wrong_without_its_button(reader_page, board):
    show_view(reader_page, "machine")
    board.board.inject("heater_fault:1")
    expect(faults(reader_page)).to_contain_text("Heater E0 reports a fault")
    expect(part(reader_page, "strip-fix")).to_have_count(0)
    board.board.clear("heater_fault")
    board.board.execute("M562 P1", channel="http")
