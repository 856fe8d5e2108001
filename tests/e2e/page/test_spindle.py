"""The sub-view Machine of a router: its spindle, and the laser in its stead."""

import pytest
from playwright.sync_api import expect

from .. import helpers
from . import SECONDS, board_value, home, part, show_view, type_number, wait_board, wait_text

BOARD = {"machine": "cnc", "speed": 20}


@pytest.fixture
def view(page, board):
    return show_view(page, "machine")


@pytest.fixture(autouse=True)
def _as_it_was(server, board):
    yield
    board.board.execute("M5 P0", channel="http")
    with board.board.lock:
        board.board.data["state"]["machineMode"] = "CNC"
        board.board.data["move"]["currentMove"]["laserPwm"] = None
        board.board.bump("state", "move")
    helpers.wait_value(server, "state.machineMode", "CNC", SECONDS)
    helpers.wait_value(server, "spindles[0].state", "stopped", SECONDS)


def test_speed_and_direction(view, server, board):
    spindle = part(view, "spindle")
    expect(spindle).to_have_count(1)
    type_number(part(spindle, "rpm"), 8000)
    wait_board(server, board, "spindles[0].active", 8000)
    wait_board(server, board, "spindles[0].state", "forward")
    # one that somebody else has turned round goes on as it turns
    board.board.execute("M4 P0 S500", channel="http")
    expect(part(spindle, "reverse")).to_be_checked()
    type_number(part(spindle, "rpm"), 700)
    wait_board(server, board, "spindles[0].active", 700)
    assert board_value(board, "spindles[0].state") == "reverse"
    part(spindle, "reverse").uncheck()
    type_number(part(spindle, "rpm"), 900)
    wait_board(server, board, "spindles[0].state", "forward")
    part(spindle, "reverse").check()
    type_number(part(spindle, "rpm"), 6000)
    wait_board(server, board, "spindles[0].state", "reverse")
    part(spindle, "stop").click()
    wait_board(server, board, "spindles[0].state", "stopped")
    expect(part(spindle, "reverse")).not_to_be_checked()
    # and in the mode for it a laser is shown
    expect(part(view, "laser")).to_be_hidden()
    with board.board.lock:
        board.board.data["state"]["machineMode"] = "Laser"
        board.board.data["move"]["currentMove"]["laserPwm"] = 0.5
        board.board.bump("state")
    wait_text(part(view, "laser"), "50 %")


def test_direction_that_is_chosen_before_the_last_speed_is_answered(page, view, server, board):
    spindle = part(view, "spindle")
    reverse = part(spindle, "reverse")
    held = []
    page.route(
        "**/api/plugin/rrfmodel",
        lambda route: held.append((route, route.fetch())),
        times=1,
    )
    type_number(part(spindle, "rpm"), 900)
    # what is held is seen while Playwright is at work
    server.wait_for(lambda: page.wait_for_timeout(20) or held, 45, "the speed to be sent")
    wait_board(server, board, "spindles[0].state", "forward")
    reverse.check()
    route, answer = held[0]
    with page.expect_response("**/api/plugin/rrfmodel"):
        route.fulfill(response=answer)
    wait_text(part(spindle, "current"), "900")
    expect(reverse).to_be_checked()
    type_number(part(spindle, "rpm"), 6000)
    wait_board(server, board, "spindles[0].active", 6000)
    assert board_value(board, "spindles[0].state") == "reverse"


def test_a_router_has_workplaces_and_nothing_of_a_printer(page, view, server, board):
    for name in ("heat", "extrusion", "filament", "mesh-menu", "babystep", "fans"):
        assert not part(view, name).filter(visible=True).count(), name
    text = view.inner_text() + page.locator("#rrfmodel_machine_parts").inner_text()
    assert not [word for word in ("Heat", "Tools", "Filament", "Unload", "Probe") if word in text]
    place = part(view.locator("[data-test=axis-row][data-axis=X]"), "position")
    assert float(place.evaluate("element => parseFloat(getComputedStyle(element).fontSize)")) > 20
    home(server, board)
    board.board.execute("G1 X40 Y30 F12000", channel="http")
    helpers.wait_value(server, "move.axes[0].machinePosition", 40, SECONDS)
    part(view, "workplace").select_option("G55")
    wait_board(server, board, "move.workplaceNumber", 1)
    part(view.locator("[data-test=axis-row][data-axis=X]"), "set-zero").click()
    wait_board(server, board, "move.axes[0].workplaceOffsets[1]", 40)
    expect(place).to_have_text("0.00")
    part(view, "set-all-zero").click()
    wait_board(server, board, "move.axes[1].workplaceOffsets[1]", 30)
    board.board.execute("G10 L2 P2 X0 Y0 Z0", channel="http")
    board.board.execute("G59.3", channel="http")
    expect(part(view, "workplace")).to_have_value("8")
    board.board.execute("G54", channel="http")
    helpers.wait_value(server, "move.workplaceNumber", 0, SECONDS)


DELTA = """() => {
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    const tell = core.onDataUpdaterPluginMessage;
    core.onDataUpdaterPluginMessage = () => undefined;
    const told = (move) =>
        tell("rrfmodel", {type: "model", changed: {move: move}, status: core.status()});
    const move = core.latest.move;
    const find = () => document.querySelectorAll("#rrfmodel_machine [data-test=home]").length;
    const before = find();
    told(Object.assign({}, move, {kinematics: {name: "delta"}}));
    return new Promise((done) => setTimeout(done)).then(function () {
        const seen = [before, find()];
        told(move);
        core.onDataUpdaterPluginMessage = tell;
        return seen;
    });
}"""


def test_towers_of_a_delta_home_together(page, view):
    expect(part(view, "home")).to_have_count(3)
    assert page.evaluate(DELTA) == [3, 0]
