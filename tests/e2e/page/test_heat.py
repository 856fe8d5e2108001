"""Heaters of the sub-view Machine whose second setting comes before the model knows the first."""

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN

from .. import helpers
from . import board_value, open_view, own_errors, part, type_number, wait_board, wait_text

pytestmark = pytest.mark.timeout(240)

DEAF = "OctoPrint.coreui.viewmodels.rrfModelViewModel.onDataUpdaterPluginMessage = () => undefined"
"""Nothing that the server pushes reaches the page, as while a long command keeps the line."""


@pytest.fixture
def opened(page, server, module_board_factory):
    """Function that connects a machine and returns its view, and the board."""

    def open_machine(machine):
        board = module_board_factory(machine=machine, speed=20)
        helpers.connect(server, board)
        view = open_view(page, server, ADMIN, "machine")
        expect(part(view, "tool")).not_to_have_count(0)
        return view, board

    return open_machine


def test_heaters_of_one_tool_set_in_a_row(page, opened, server, page_errors):
    view, board = opened("idex")
    copy = part(view, "tool").nth(2)
    fields = part(copy, "active")
    expect(fields).to_have_count(2)
    page.evaluate(DEAF)
    type_number(fields.nth(0), 61)
    type_number(fields.nth(1), 47)
    wait_board(server, board, "tools[2].active", [61, 47])
    type_number(fields.nth(0), 52)
    wait_board(server, board, "tools[2].active", [52, 47])
    assert own_errors(page_errors) == []


def test_heaters_of_one_tool_are_the_machine_s_again(opened, server):
    view, board = opened("idex")
    fields = part(part(view, "tool").nth(2), "active")
    type_number(fields.nth(0), 61)
    wait_board(server, board, "tools[2].active[0]", 61)
    # somebody else sets it later, and that is known
    helpers.wait_value(server, "tools[2].active[0]", 61, 15)
    board.board.execute("M568 P2 S33:34", channel="http")
    expect(fields.nth(0)).to_have_value("33")
    helpers.wait_polls(server, 3)
    type_number(fields.nth(1), 48)
    wait_board(server, board, "tools[2].active", [33, 48])


def test_each_heater_of_a_tool_has_its_own_limits(opened, server):
    view, board = opened("idex")
    with board.board.lock:
        board.board.data["heat"]["heaters"][3]["max"] = 400.0
        board.board.bump("heat")
    fields = part(part(view, "tool").nth(2), "active")
    expect(fields.nth(1)).to_have_attribute("max", "400")
    first = fields.nth(0).get_attribute("max")
    assert float(first) < 400
    type_number(fields.nth(1), 350)
    wait_board(server, board, "tools[2].active[1]", 350)


def test_a_chamber_is_switched_on_with_the_temperature_just_given(page, opened, server):
    view, board = opened("corexy")
    chamber = part(view, "chamber")
    page.evaluate(DEAF)
    type_number(part(chamber, "active"), 45)
    wait_board(server, board, "heat.heaters[2].active", 45)
    part(chamber, "state-active").click()
    wait_board(server, board, "heat.heaters[2].state", "active")
    assert board_value(board, "heat.heaters[2].active") == 45


def test_tools_of_one_name_are_two(page, opened, server):
    view, board = opened("idex")
    for number in (0, 1):
        board.board.execute(f'M563 P{number} S"Hotend"', channel="http")
    heaters = page.locator("[data-test=rrfmodel-sidebar] [data-test=heater]")
    expect(heaters.filter(has_text="Hotend")).to_have_count(2)
    board.board.execute("M568 P0 S66", channel="http")
    board.board.execute("M568 P1 S77", channel="http")
    wait_text(heaters.nth(0), "66")
    wait_text(heaters.nth(1), "77")
