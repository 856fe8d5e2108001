"""Everyday use by Tab, Enter and the letters alone: no pointer, and no focus but by walking."""

import pytest
from playwright.sync_api import expect

from . import SECONDS, board_value, both_hosts, own_errors, part, show_view, wait_board
from .test_job import end_job

BOARD = {"machine": "cartesian", "speed": 10}

FILE = "0:/gcodes/by_keyboard.gcode"

FAR = 400
"""Stops of the whole page of OctoPrint, at most."""


def prepare(board):
    board.card.write(FILE, "G4 S2\n" * 300)


HAS_FOCUS = "(each) => each === document.activeElement"


def walk_to(locator, key="Tab"):
    """Press a key until the element has the focus."""
    expect(locator).to_be_enabled()
    page = locator.page
    for _stop in range(FAR):
        if locator.evaluate(HAS_FOCUS):
            return
        page.keyboard.press(key)
    pytest.fail(f"{locator} isn't reached by {key}")


@both_hosts
def test_homes_heats_answers_and_pauses(page, server, board, page_errors):
    view = show_view(page, "machine")
    board.board.execute("M84", channel="http")
    wait_board(server, board, "move.axes[].homed", lambda found: not any(found))

    walk_to(part(view, "home-all"))
    page.keyboard.press("Enter")
    wait_board(server, board, "move.axes[].homed", all, SECONDS)

    # further up, where nobody has to go around the page
    active = view.locator("[data-test=heat-row][data-kind=bed] [data-test=active]")
    walk_to(active, "Shift+Tab")
    page.keyboard.press("Control+A")
    page.keyboard.type("40")
    page.keyboard.press("Enter")
    wait_board(server, board, "heat.heaters[0].active", 40)
    walk_to(part(view, "all-off"), "Shift+Tab")
    page.keyboard.press("Enter")
    wait_board(server, board, "heat.heaters[0].state", "off")

    board.board.execute('M291 P"Is it clear?" S3', channel="http")
    box = page.locator("#rrfmodel_box_dialog")
    expect(part(box, "box-ok")).to_be_enabled()
    walk_to(part(box, "box-ok"))
    page.keyboard.press("Enter")
    wait_board(server, board, "state.messageBox", None)
    expect(box).to_be_hidden()

    board.board.execute(f'M32 "{FILE}"', channel="http")
    try:
        walk_to(part(page, "view-job"), "Shift+Tab")
        page.keyboard.press("Enter")
        walk_to(part(page.locator("#rrfmodel_job"), "pause"))
        page.keyboard.press("Enter")
        wait_board(server, board, "state.status", "paused")
        walk_to(part(page.locator("#rrfmodel_job"), "cancel"))
        page.keyboard.press("Enter")
        expect(page.locator(".modal.in")).to_be_visible()
        walk_to(page.locator(".modal.in .modal-footer .btn-danger"))
        page.keyboard.press("Enter")
        wait_board(server, board, "state.status", "idle")
    finally:
        end_job(server, board)
        board.board.speed = 10
    assert board_value(board, "state.status") == "idle"
    assert own_errors(page_errors) == []
