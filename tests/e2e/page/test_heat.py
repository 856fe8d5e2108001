"""Heaters of the sub-view Machine: several of one tool, and settings in a row."""

import copy
import re

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN

from .. import helpers
from . import (
    SECONDS,
    board_value,
    heat_row,
    open_view,
    own_errors,
    part,
    show_view,
    type_number,
    wait_board,
    wait_text,
)

DEAF = "OctoPrint.coreui.viewmodels.rrfModelViewModel.onDataUpdaterPluginMessage = () => undefined"
"""Nothing that the server pushes reaches the page, as while a long command keeps the line."""


BOARD = {"machine": "idex", "speed": 20}


@pytest.fixture(scope="module")
def built(board):
    """What the board is made of, as far as tests change it."""
    return copy.deepcopy({key: board.board.data[key] for key in ("heat", "tools")})


@pytest.fixture(autouse=True)
def _as_built(server, board, built):
    yield
    board.board.clear("heater_fault")
    with board.board.lock:
        board.board.data.update(copy.deepcopy(built))
        board.board.bump(*built)


@pytest.fixture
def view(page):
    return show_view(page, "machine")


def of_tool(view, number):
    """Return the rows of a tool, one for each of its heaters."""
    return view.locator(f"[data-test=heat-row][data-tool='{number}']")


def open_deaf(page, server):
    """Return the sub-view in a page that hears nothing more once it has the model."""
    view = open_view(page, server, ADMIN, "machine")
    expect(part(view, "heat-row")).not_to_have_count(0)
    page.evaluate(DEAF)
    return view


def test_heaters_of_one_tool_set_in_a_row(own_page, server, board, page_errors):
    view = open_deaf(own_page, server)
    fields = part(of_tool(view, 2), "active")
    expect(fields).to_have_count(2)
    type_number(fields.nth(0), 61)
    type_number(fields.nth(1), 47)
    wait_board(server, board, "tools[2].active", [61, 47])
    type_number(fields.nth(0), 52)
    wait_board(server, board, "tools[2].active", [52, 47])
    assert own_errors(page_errors) == []


def test_heaters_of_one_tool_are_the_machine_s_again(view, server, board):
    fields = part(of_tool(view, 2), "active")
    type_number(fields.nth(0), 61)
    wait_board(server, board, "tools[2].active[0]", 61)
    # somebody else sets it later, and that is known
    helpers.wait_value(server, "tools[2].active[0]", 61, 45)
    board.board.execute("M568 P2 S33:34", channel="http")
    expect(fields.nth(0)).to_have_value("33")
    helpers.wait_polls(server, 3)
    type_number(fields.nth(1), 48)
    wait_board(server, board, "tools[2].active", [33, 48])


def test_each_heater_of_a_tool_has_its_own_limits(view, server, board):
    with board.board.lock:
        board.board.data["heat"]["heaters"][3]["max"] = 400.0
        board.board.bump("heat")
    fields = part(of_tool(view, 2), "active")
    expect(fields.nth(1)).to_have_attribute("max", "400")
    first = fields.nth(0).get_attribute("max")
    assert float(first) < 400
    type_number(fields.nth(1), 350)
    wait_board(server, board, "tools[2].active[1]", 350)


@pytest.fixture
def with_chamber(server, board, board_factory):
    """Another machine in the board's place, one with a chamber."""
    other = board_factory(machine="corexy", speed=20)
    helpers.connect(server, other, SECONDS)
    yield other
    helpers.connect(server, board, SECONDS)


def test_a_chamber_is_switched_on_with_the_temperature_just_given(own_page, server, with_chamber):
    board = with_chamber
    chamber = heat_row(open_deaf(own_page, server), 2)
    type_number(part(chamber, "active"), 45)
    wait_board(server, board, "heat.heaters[2].active", 45)
    part(chamber, "state-active").click()
    wait_board(server, board, "heat.heaters[2].state", "active")
    assert board_value(board, "heat.heaters[2].active") == 45


def test_tools_of_one_name_are_two(page, board):
    for number in (0, 1):
        board.board.execute(f'M563 P{number} S"Hotend"', channel="http")
    heaters = page.locator("[data-test=rrfmodel-sidebar] [data-test=heater]")
    expect(heaters.filter(has_text="Hotend")).to_have_count(2)
    board.board.execute("M568 P0 S66", channel="http")
    board.board.execute("M568 P1 S77", channel="http")
    wait_text(heaters.nth(0), "66")
    wait_text(heaters.nth(1), "77")


def test_each_heater_of_a_tool_has_its_own_temperature(view, server, board):
    board.board.execute("M568 P2 S210:190 R150:140", channel="http")
    tool = of_tool(view, 2)
    expect(part(tool, "active")).to_have_count(2)
    expect(part(tool, "active").nth(1)).to_have_value("190")
    type_number(part(tool, "active").nth(0), 215)
    wait_board(server, board, "tools[2].active", [215, 190])
    type_number(part(tool, "standby").nth(1), 130)
    wait_board(server, board, "tools[2].standby", [150, 130])
    # one that is off doesn't keep the others from being set
    with board.board.lock:
        board.board.data["tools"][2]["active"] = [215, -273.1]
    expect(part(tool, "active").nth(1)).to_have_value("")
    type_number(part(tool, "active").nth(0), 220)
    wait_board(server, board, "tools[2].active", [220, 0])
    # a fault of any of them is the tool's
    heaters = board_value(board, "tools[2].heaters")
    board.board.inject(f"heater_fault:{heaters[1]}")
    wait_text(part(heat_row(view, heaters[1], tool=2), "alarm"), "fault")


def test_a_second_heater_has_a_row_of_its_own_in_line(view):
    """Its field stands below the first one's, and the tool's states are there once."""
    rows = of_tool(view, 2)
    expect(rows).to_have_count(2)
    expect(part(rows, "tool-active")).to_have_count(1)
    first, second = (part(row, "active").bounding_box() for row in rows.all())
    assert first["x"] == second["x"]
    assert {row.bounding_box()["height"] <= 40 for row in rows.all()} == {True}


def test_each_value_has_its_unit(view):
    assert re.fullmatch(r"\d+\.\d °C", view.locator(".rrfmodel-heat-now").nth(1).inner_text())
    for row in part(view, "axis-row").all():
        assert re.search(r"\d\.\d\d mm", row.inner_text())
