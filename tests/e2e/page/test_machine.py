"""The sub-view Machine, above: heaters, fans, axes and factors, each control used on the board."""

import copy
import re

import pytest
from playwright.sync_api import expect

from .. import helpers
from . import (
    SECONDS,
    board_value,
    both_hosts,
    heat_row,
    home,
    own_errors,
    part,
    show_view,
    type_number,
    unfold,
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
    row = heat_row(view, 1, tool=1)
    type_number(part(row, "active"), 61)
    wait_board(server, board, "tools[1].active[0]", 61)
    type_number(part(row, "standby"), 43)
    wait_board(server, board, "tools[1].standby[0]", 43)
    for state in ("standby", "active", "off"):
        part(row, f"tool-{state}").click()
        wait_board(server, board, "heat.heaters[1].state", state)
        expect(part(row, f"tool-{state}")).to_have_attribute("aria-pressed", "true")
    assert own_errors(page_errors) == []


LIT = re.compile("rrfmodel-next")


def test_a_temperature_that_heats_nothing_says_what_comes_next(view, server, board):
    row = heat_row(view, 1, tool=1)
    active = part(row, "tool-active")
    expect(part(row, "tool-off")).to_have_attribute("aria-pressed", "true")
    expect(active).not_to_have_class(LIT)
    type_number(part(row, "active"), 60)
    expect(active).to_have_class(LIT)
    expect(active).to_have_attribute("title", "Heat to 60 °C")
    active.click()
    wait_board(server, board, "heat.heaters[1].state", "active")
    expect(active).to_have_attribute("aria-pressed", "true")
    expect(active).not_to_have_class(LIT)
    # and all of them at once
    board.board.execute("M140 S40", channel="http")
    helpers.wait_value(server, "heat.heaters[0].state", "active", SECONDS)
    part(view, "all-off").click()
    for heater in (0, 1):
        wait_board(server, board, f"heat.heaters[{heater}].state", "off")


def test_temperatures_of_octoprint_are_offered(page, view, server, board, page_errors):
    (profile,) = page.evaluate("""() => {
        const known = OctoPrint.coreui.viewmodels.settingsViewModel.temperature_profiles;
        return known().slice(0, 1);
    }""")
    for row, key, heats in (
        (heat_row(view, 1, tool=1), "tools[1].active[0]", profile["extruder"]),
        (heat_row(view, 0), "heat.heaters[0].active", profile["bed"]),
    ):
        part(row, "presets").click()
        chosen = part(row, "preset").filter(has_text=profile["name"])
        expect(chosen).to_have_text(f"{profile['name']} {heats} °C")
        chosen.click()
        wait_board(server, board, key, float(heats))
        expect(part(row, "active")).to_have_value(str(heats))
    part(view, "all-off").click()
    wait_board(server, board, "heat.heaters[0].state", "off")
    assert own_errors(page_errors) == []


def test_the_last_ten_minutes_are_a_curve(view, server, board):
    board.board.execute("M568 P1 S200 A2", channel="http")
    curve = part(heat_row(view, 1, tool=1), "curve")
    expect(curve).to_have_attribute("d", re.compile(r"^M[\d.]+ [\d.]+L"))


DAILY = ("heat-row", "home-all", "axis-row", "extrude", "fan", "speed-factor", "babystep", "macro")

HEIGHT = 900


def test_five_tools_need_no_scrolling(page, view, server, board, page_errors):
    """What is used daily lies in the window, and no row of a heater is higher than 40 pixels."""
    with board.board.lock:
        heat, tools, move = (board.board.data[key] for key in ("heat", "tools", "move"))
        before = copy.deepcopy((heat["heaters"], tools, move["extruders"]))
        heat["heaters"].append(copy.deepcopy(heat["heaters"][4]))
        more = copy.deepcopy(tools[10])
        more.update(number=11, name="A fifth one", heaters=[5])
        tools.append(more)
        move["extruders"].append(copy.deepcopy(move["extruders"][0]))
        board.board.bump("heat", "tools", "move")
    try:
        expect(part(view, "heat-row")).to_have_count(6)
        expect(part(view, "macro")).not_to_have_count(0)
        page.evaluate("window.scrollTo(0, 0)")
        tab = page.locator("#tab_plugin_rrfmodel").bounding_box()
        for name in DAILY:
            for element in part(view, name).all():
                box = element.bounding_box()
                assert box["y"] + box["height"] <= HEIGHT, (name, box)
                assert box["x"] >= tab["x"], (name, box)
                assert box["x"] + box["width"] <= tab["x"] + tab["width"], (name, box)
        for row in part(view, "heat-row").all():
            assert row.bounding_box()["height"] <= 40
    finally:
        with board.board.lock:
            heat["heaters"][:], tools[:], move["extruders"][:] = before
            board.board.bump("heat", "tools", "move")
    assert own_errors(page_errors) == []


def test_offsets_of_a_tool(page, view, server, board, page_errors):
    parts = page.locator("#rrfmodel_machine_parts")
    expect(part(parts, "offset")).to_have_count(0)
    fields = part(unfold(parts, "offsets").locator("[data-tool='1']"), "offset")
    before = board_value(board, "tools[1].offsets")
    assert len(before) > 2
    expect(fields).to_have_count(len(before))
    type_number(fields.nth(1), -0.75)
    wait_board(server, board, "tools[1].offsets", [before[0], -0.75, *before[2:]])
    wait_text(part(part(parts, "offsets"), "summary"), "Y -0.75 mm")
    assert own_errors(page_errors) == []


def test_a_move_has_the_speed_that_is_shown(view, server, board):
    home(server, board)
    sent = len(helpers.commands(board))
    part(view, "jog-speed").fill("1200")
    by(axis(view, "X"), 10).click()
    (move,) = server.wait_for(
        lambda: [line for line in helpers.commands(board)[sent:] if "G1 X10" in line],
        45,
        "the move",
    )
    assert "F1200" in move.split()


def by(row, distance):
    """Return the button of an axis for one distance: each has its own."""
    return row.locator(f"[data-step='{distance}']")


def test_what_is_typed_stays_until_it_is_sent_or_given_up(view, server, board):
    field = part(heat_row(view, 1, tool=1), "standby")
    expect(field).not_to_have_value("")
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
    field = part(heat_row(view, 1, tool=1), "active")
    before = board_value(board, "tools[1].active[0]")
    type_number(field, 900)
    expect(field).to_have_value("900")
    type_number(field, 37)
    wait_board(server, board, "tools[1].active[0]", 37)
    assert before != 900


def test_bed(view, server, board, page_errors):
    bed = heat_row(view, 0)
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
    expect(part(axis(view, "X"), "homed")).to_have_attribute("data-homed", "true")
    wait_text(part(axis(view, "X"), "homed"), "homed")
    type_number(part(axis(view, "X"), "go"), 40)
    wait_board(server, board, "move.axes[0].userPosition", near(40))
    by(axis(view, "X"), 10).click()
    wait_board(server, board, "move.axes[0].userPosition", near(50))
    by(axis(view, "X"), -50).click()
    wait_board(server, board, "move.axes[0].userPosition", near(0))
    part(axis(view, "X"), "plus").click()
    wait_board(server, board, "move.axes[0].userPosition", near(1))
    wait_text(part(axis(view, "X"), "position"), "1.00")
    part(axis(view, "X"), "minus").click()
    wait_board(server, board, "move.axes[0].userPosition", near(0))
    part(axis(view, "Y"), "home").click()
    helpers.wait_polls(server, 2)
    assert own_errors(page_errors) == []


def test_selecting_feeding_and_putting_down(view, server, board, page_errors):
    home(server, board)
    row = heat_row(view, 1, tool=1)
    part(row, "select").click()
    wait_board(server, board, "state.currentTool", 1, 45)
    expect(part(row, "select")).to_have_attribute("aria-pressed", "true")
    board.board.execute("M568 P1 S210 A2", channel="http")
    helpers.wait_value(server, "heat.heaters[1].current", lambda now: now > 200, 90)
    before = board_value(board, "move.extruders[0].position")
    type_number(part(view, "extrude-length"), 6)
    wait_board(server, board, "move.extruders[0].position", near(before + 6), 45)
    part(view, "retract").nth(1).click()
    wait_board(server, board, "move.extruders[0].position", near(before + 1), 45)
    part(view, "extrude").nth(2).click()
    wait_board(server, board, "move.extruders[0].position", near(before + 11), 45)
    board.board.execute("M568 P1 A0", channel="http")
    part(view, "deselect").click()
    wait_board(server, board, "state.currentTool", -1, 45)
    assert own_errors(page_errors) == []


def test_fans_factors_and_baby_steps(view, server, board, page_errors):
    fan = part(view, "fan").first
    type_number(part(fan, "speed"), 55)
    wait_board(server, board, "fans[0].requestedValue", near(0.55))
    slider = part(fan, "slider")
    assert slider.get_attribute("aria-label")
    slider.fill("80")
    wait_board(server, board, "fans[0].requestedValue", near(0.8))
    expect(part(fan, "speed")).to_have_value("80")
    speed = part(view, "speed-factor")
    type_number(part(speed, "speed-factor-field"), 120)
    wait_board(server, board, "move.speedFactor", near(1.2))
    # clicks that come one after the other add up
    part(speed, "speed-more").dblclick()
    wait_board(server, board, "move.speedFactor", near(1.3))
    wait_text(speed, "130 %")
    part(speed, "speed-less").click()
    wait_board(server, board, "move.speedFactor", near(1.25))
    type_number(part(view, "extrusion-factor").first, 95)
    wait_board(server, board, "move.extruders[0].factor", near(0.95))
    part(view, "extrusion-less").first.click()
    wait_board(server, board, "move.extruders[0].factor", near(0.94))
    expect(part(view, "extruder")).to_have_count(1)
    part(view, "all-extruders").click()
    expect(part(view, "extruder")).to_have_count(4)
    home(server, board)
    part(view, "babystep-by").filter(has_text="+0.05").click()
    wait_board(server, board, "move.axes[2].babystep", near(0.05))
    wait_text(part(view, "babystep"), "0.050 mm")
    part(view, "babystep-clear").click()
    wait_board(server, board, "move.axes[2].babystep", near(0))
    assert own_errors(page_errors) == []


def test_heater_fault_is_reset(page, view, server, board):
    board.board.inject("heater_fault:2")
    row = heat_row(view, 2)
    wait_text(part(row, "alarm"), "fault")
    # the strip tells it too; the firmware's own box about it would be the third to do so
    expect(page.locator("[data-test=box]")).to_be_hidden()
    part(row, "reset-fault").click()
    wait_board(server, board, "heat.heaters[2].state", "off")
    expect(part(row, "alarm")).to_have_count(0)


def test_text_of_the_printer_is_text(view, server, board, page_errors):
    board.board.execute(f'M563 P1 S"{MARKUP}"', channel="http")
    wait_text(heat_row(view, 1, tool=1), MARKUP)
    assert view.locator("img").count() == 0
    board.board.execute('M563 P1 S"Left"', channel="http")
    assert own_errors(page_errors) == []


READERS = {"macros", "macro-filter"}
"""What only changes the page."""


def test_who_may_only_read_can_use_nothing(reader_page):
    view = show_view(reader_page, "machine")
    expect(part(view, "axis-row")).not_to_have_count(0)
    expect(part(view, "heat-row")).not_to_have_count(0)
    expect(part(view, "macro")).not_to_have_count(0)
    controls = view.locator("button:visible, input:visible, select:visible").all()
    assert len(controls) > 20
    enabled = {each.get_attribute("data-test") for each in controls if each.is_enabled()}
    assert enabled <= READERS | {"all-extruders"}


PRINT = """(state) => {
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    const tell = (window.tellAgain = window.tellAgain || core.onDataUpdaterPluginMessage);
    // no news of the machine come in between
    core.onDataUpdaterPluginMessage = state ? () => undefined : window.tellAgain;
    const known = Object.assign({}, core.latest.state, {status: state || "idle"});
    tell("rrfmodel", {type: "model", changed: {state: known}, status: core.status()});
}"""

FORBIDDEN = ("home-all", "calibrate", "mesh-menu", "select", "extrude", "plus", "macro")


def test_what_a_print_forbids_is_greyed_with_its_reason(page, view):
    expect(part(view, "macro")).not_to_have_count(0)
    page.evaluate(PRINT, "processing")
    for name in FORBIDDEN:
        control = part(view, name).first
        expect(control).to_be_disabled()
        titled = control.locator("xpath=ancestor-or-self::*[@title]").last
        assert titled.get_attribute("title") == "Not while a print runs.", name
    for name in ("speed-more", "babystep-by"):
        expect(part(view, name).first).to_be_enabled()
    expect(part(heat_row(view, 1), "active")).to_be_enabled()
    page.evaluate(PRINT, None)
    expect(part(view, "home-all")).to_be_enabled()


def test_of_two_quick_clicks_the_second_waits_for_the_answer_to_the_first(
    page, view, server, board
):
    """Of two requests at once any may be the first to be taken, and an old number the last."""
    speed = part(view, "speed-factor")
    type_number(part(speed, "speed-factor-field"), 100)
    wait_text(speed, "100 %")
    sent = []

    def hold_the_first(route):
        sent.append(route)
        if len(sent) > 1:
            route.continue_()

    page.route("**/api/plugin/rrfmodel", hold_the_first)
    part(speed, "speed-more").dblclick()
    # both were clicked
    expect(part(speed, "speed-factor-field")).to_have_value("110")
    server.wait_for(lambda: page.evaluate("1") and sent, 10, "the first request")
    assert [route.request.post_data_json["percent"] for route in sent] == [105]
    sent[0].continue_()
    wait_text(speed, "110 %")
    wait_board(server, board, "move.speedFactor", near(1.1))
    assert factors(board)[-2:] == ["M220 S105", "M220 S110"]


def factors(board):
    return [line for line in helpers.commands(board) if line.startswith("M220")]


def test_says_why_what_it_shows_is_old(page, view, server):
    state = page.locator("[data-test=strip-state]")
    expect(state).to_have_text("Idle")
    server.commands("G4 S100")
    wait_text(state, "Waiting, ")
    wait_text(state, "Idle")


def test_refusals_are_told(page, view, server, board):
    board.board.execute("M18", channel="http")
    helpers.wait_value(server, "move.axes[0].homed", False, 45)
    # until the model is known to be newer than all that was sent the firmware decides
    helpers.wait_polls(server, 2)
    part(axis(view, "X"), "plus").click()
    # the plugin's words, or the firmware's where it was the one to decide
    expect(page.locator(".ui-pnotify-text").last).to_contain_text(
        re.compile("Home these axes first: X|insufficient axes homed")
    )
