"""The sub-view Machine, above: heaters, fans, axes and factors, each control used on the board."""

import pytest
from playwright.sync_api import expect

from tests.support.browser import PATIENCE_MS

from .. import helpers
from . import (
    SECONDS,
    board_value,
    both_hosts,
    home,
    own_errors,
    part,
    show_view,
    type_number,
    wait_board,
    wait_text,
)

MARKUP = "<img src=x onerror=alert(1)>"


BOARD = {"machine": "toolchanger", "speed": 10}


@pytest.fixture
def view(page, board):
    board.board.execute("M568 P1 S0 R0 A0\nM220 S100\nM221 D0 S100", channel="http")
    return show_view(page, "machine")


def near(wanted):
    return lambda found: found is not None and abs(found - wanted) < 0.01


def axis(view, letter):
    return view.locator(f"[data-test=axis-row][data-axis={letter}]")


def test_tool_temperatures_and_state(view, server, board, page_errors):
    tool = part(view, "tool").first
    type_number(part(tool, "active"), 61)
    wait_board(server, board, "tools[1].active[0]", 61)
    type_number(part(tool, "standby"), 43)
    wait_board(server, board, "tools[1].standby[0]", 43)
    for state in ("standby", "active", "off"):
        part(tool, f"state-{state}").click()
        wait_board(server, board, "heat.heaters[1].state", state)
        wait_text(part(tool, "state"), state)
    assert own_errors(page_errors) == []


def test_offsets_of_a_tool(view, server, board, page_errors):
    tool = part(view, "tool").first
    expect(part(tool, "offset")).to_have_count(0)
    part(tool, "show-offsets").click()
    fields = part(tool, "offset")
    before = board_value(board, "tools[1].offsets")
    assert len(before) > 2
    expect(fields).to_have_count(len(before))
    type_number(fields.nth(1), -0.75)
    wait_board(server, board, "tools[1].offsets", [before[0], -0.75, *before[2:]])
    wait_text(part(tool, "offsets"), "Y -0.75")
    assert own_errors(page_errors) == []


def test_a_move_has_the_speed_that_is_shown(view, server, board):
    home(server, board)
    sent = len(helpers.commands(board))
    part(view, "jog-speed").fill("1200")
    part(view, "step").filter(has_text="10").first.click()
    part(axis(view, "X"), "plus").click()
    (move,) = server.wait_for(
        lambda: [line for line in helpers.commands(board)[sent:] if "G1 X10" in line],
        45,
        "the move",
    )
    assert "F1200" in move.split()


def test_what_is_typed_stays_until_it_is_sent_or_given_up(view, server, board):
    field = part(part(view, "tool").first, "standby")
    expect(field).not_to_have_value("", timeout=PATIENCE_MS)
    before = field.input_value()
    field.fill("99")
    board.board.execute("M568 P3 S31", channel="http")
    wait_board(server, board, "tools[3].active[0]", 31)
    helpers.wait_polls(server, 3)
    expect(field).to_have_value("99")
    field.press("Escape")
    expect(field).to_have_value(before)
    assert board_value(board, "tools[1].standby[0]") != 99


def test_what_is_out_of_range_is_not_sent(view, server, board):
    field = part(part(view, "tool").first, "active")
    before = board_value(board, "tools[1].active[0]")
    type_number(field, 900)
    expect(field).to_have_value("900")
    type_number(field, 37)
    wait_board(server, board, "tools[1].active[0]", 37)
    assert before != 900


def test_bed(view, server, board, page_errors):
    bed = part(view, "bed")
    type_number(part(bed, "active"), 44)
    wait_board(server, board, "heat.heaters[0].active", 44)
    type_number(part(bed, "standby"), 33)
    wait_board(server, board, "heat.heaters[0].standby", 33)
    for state in ("standby", "active", "off"):
        part(bed, f"state-{state}").click()
        wait_board(server, board, "heat.heaters[0].state", state)
    assert own_errors(page_errors) == []


@both_hosts
def test_axes(view, server, board, page_errors):
    board.board.execute("M84", channel="http")
    helpers.wait_value(server, "move.axes[].homed", lambda homed: not any(homed), SECONDS)
    part(view, "home-all").click()
    wait_board(server, board, "move.axes[].homed", lambda homed: homed and all(homed), 60)
    wait_text(part(axis(view, "X"), "homed"), "homed")
    part(axis(view, "X"), "homed").and_(view.locator(".label-success")).wait_for()
    type_number(part(axis(view, "X"), "go"), 40)
    wait_board(server, board, "move.axes[0].userPosition", near(40))
    part(view, "step").filter(has_text="10").first.click()
    part(axis(view, "X"), "plus").click()
    wait_board(server, board, "move.axes[0].userPosition", near(50))
    part(axis(view, "X"), "minus").click()
    wait_board(server, board, "move.axes[0].userPosition", near(40))
    wait_text(part(axis(view, "X"), "user"), "40.00")
    part(axis(view, "Y"), "home").click()
    helpers.wait_polls(server, 2)
    assert own_errors(page_errors) == []


def test_selecting_feeding_and_putting_down(view, server, board, page_errors):
    home(server, board)
    tool = part(view, "tool").first
    part(tool, "select").click()
    wait_board(server, board, "state.currentTool", 1, 45)
    view.locator("[data-test=tool].rrfmodel-chosen").wait_for()
    board.board.execute("M568 P1 S210 A2", channel="http")
    helpers.wait_value(server, "heat.heaters[1].current", lambda now: now > 200, 90)
    before = board_value(board, "move.extruders[0].position")
    part(view, "extrude-length").fill("6")
    part(view, "extrude").click()
    wait_board(server, board, "move.extruders[0].position", near(before + 6), 45)
    part(view, "retract").click()
    wait_board(server, board, "move.extruders[0].position", near(before), 45)
    board.board.execute("M568 P1 A0", channel="http")
    part(view, "deselect").click()
    wait_board(server, board, "state.currentTool", -1, 45)
    assert own_errors(page_errors) == []


def test_fans_factors_and_baby_steps(view, server, board, page_errors):
    type_number(part(part(view, "fan").first, "speed"), 55)
    wait_board(server, board, "fans[0].requestedValue", near(0.55))
    type_number(part(view, "speed-factor"), 120)
    wait_board(server, board, "move.speedFactor", near(1.2))
    type_number(part(view, "extrusion-factor").first, 95)
    wait_board(server, board, "move.extruders[0].factor", near(0.95))
    home(server, board)
    part(view, "babystep-by").filter(has_text="+0.05").click()
    wait_board(server, board, "move.axes[2].babystep", near(0.05))
    wait_text(part(view, "babystep"), "0.050")
    part(view, "babystep-clear").click()
    wait_board(server, board, "move.axes[2].babystep", near(0))
    assert own_errors(page_errors) == []


def test_heater_fault_is_reset(page, view, server, board):
    board.board.inject("heater_fault:2")
    wait_text(part(view, "fault"), "Heater 2")
    # the firmware opens a message box about it
    page.locator("[data-test=box-ok]").click()
    page.locator("[data-test=box]").wait_for(state="hidden")
    part(view, "reset-fault").click()
    wait_board(server, board, "heat.heaters[2].state", "off")
    expect(part(view, "fault")).to_have_count(0, timeout=PATIENCE_MS)


def test_text_of_the_printer_is_text(view, server, board, page_errors):
    board.board.execute(f'M563 P1 S"{MARKUP}"', channel="http")
    wait_text(part(view, "tool").first, MARKUP)
    assert view.locator("img").count() == 0
    board.board.execute('M563 P1 S"Left"', channel="http")
    assert own_errors(page_errors) == []


def test_who_may_only_read_can_use_nothing(reader_page):
    view = show_view(reader_page, "machine")
    controls = view.locator("button:visible, input:visible")
    expect(part(view, "axis-row")).not_to_have_count(0)
    expect(part(view, "tool")).not_to_have_count(0)
    assert controls.count() > 20
    assert {control.is_disabled() for control in controls.all()} == {True}


def test_says_why_what_it_shows_is_old(page, view, server):
    reason = page.locator("[data-test=tab-reason]")
    expect(reason).to_be_hidden()
    server.commands("G4 S20")
    expect(reason).to_be_visible(timeout=PATIENCE_MS)
    expect(reason).to_contain_text("long command")
    expect(reason).to_be_hidden(timeout=PATIENCE_MS)


def test_refusals_are_told(page, view, server, board):
    board.board.execute("M18", channel="http")
    helpers.wait_value(server, "move.axes[0].homed", False, 45)
    part(axis(view, "X"), "plus").click()
    expect(page.locator(".ui-pnotify-text").last).to_contain_text(
        "Home these axes first: X", timeout=PATIENCE_MS
    )
