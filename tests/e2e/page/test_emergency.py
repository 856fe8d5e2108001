"""The emergency stop of the tab: asked about, sent past what is printed, and its way back."""

from playwright.sync_api import expect

from .. import helpers
from . import CONFIRM, both_hosts, home, part

BOARD = {"machine": "cartesian", "speed": 5}

STREAMED = "G92 X20 Y20 Z1\n" + "G1 X21 F600\nG1 X20 F600\n" * 1000


def test_a_reader_can_not_stop_the_machine(reader_page, board):
    expect(part(reader_page, "emergency-stop")).to_be_disabled()
    expect(part(reader_page, "restart")).to_be_disabled()
    assert not board.board.is_halted


def test_restarts_the_machine(page, server, board):
    resets = helpers.status(server)["resets"]
    home(server, board)
    restarts_before = helpers.restarts(server)
    part(page, "restart").click()
    page.locator(CONFIRM).click()
    helpers.wait_restarted(server, restarts_before)
    # it is another start of the board
    assert not any(helpers.value(server, "move.axes[].homed"))
    assert helpers.status(server)["resets"] >= resets


@both_hosts
def test_stops_what_is_printed_and_comes_back(page, server, board):
    server.upload("streamed.gcode", STREAMED)
    server.select_and_print("streamed.gcode")
    server.wait_state("Printing")
    stop = part(page, "emergency-stop")
    stop.click()
    # nothing happens until it was confirmed
    page.locator(".modal.in .modal-footer [data-dismiss=modal]").click()
    expect(page.locator(".modal.in")).to_have_count(0)
    helpers.wait_polls(server, 1)
    assert not board.board.is_halted
    stop.press("Enter")
    page.locator(CONFIRM).click()
    server.wait_for(lambda: board.board.is_halted, 45, "the machine to be halted")
    # the way back is offered
    restarts_before = helpers.restarts(server)
    fix = part(page, "strip-fix")
    fix.filter(has_text="Restart the machine").click()
    server.wait_for(lambda: not board.board.is_halted, 60, "the restart")
    helpers.wait_restarted(server, restarts_before)
