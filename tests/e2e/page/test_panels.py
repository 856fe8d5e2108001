"""Panels of what is set up and tuned: each control used, and what the board has then."""

import pytest
from playwright.sync_api import expect

from .. import helpers
from . import (
    CONFIRM,
    both_hosts,
    home,
    own_errors,
    part,
    show_view,
    type_number,
    unfold,
    wait_board,
    wait_text,
)

BOARD = {"machine": "cartesian", "speed": 20}


def prepare(board):
    with board.lock:
        board.data["boards"].append(
            {**board.data["boards"][0], "canAddress": 20, "drivers": [{"status": 2}]}
        )


@pytest.fixture
def view(page):
    show_view(page, "machine")
    return page.locator("#rrfmodel_machine_parts")


def row(panel, name, attribute, value):
    return panel.locator(f"[data-test={name}][data-{attribute}='{value}']")


def confirm(page):
    page.locator(CONFIRM).last.click()


def sent(server, board, line):
    server.wait_for(lambda: line in helpers.commands(board), 45, line)


@both_hosts
def test_motors_and_shaping(page, view, server, board, page_errors):
    tuning = unfold(view, "tuning")
    type_number(part(row(tuning, "drive", "drive", 0), "advance"), 0.07)
    wait_board(server, board, "move.extruders[0].pressureAdvance", 0.07)
    # what a restart forgets is told
    wait_text(part(tuning, "changes"), "Extruder 0, Pressure advance: 0.07 s")
    type_number(part(row(tuning, "drive", "drive", "X"), "current"), 1350)
    wait_board(server, board, "move.axes[0].current", 1350)
    type_number(part(row(tuning, "drive", "drive", 0), "current"), 900)
    wait_board(server, board, "move.extruders[0].current", 900)
    part(tuning, "shaper").select_option(label="EI2")
    wait_board(server, board, "move.shaping.type", "ei2")
    type_number(part(tuning, "shaper-frequency"), 51.5)
    wait_board(server, board, "move.shaping.frequency", 51.5)
    wait_text(part(tuning, "changes"), "Input shaping: EI2 51.5 Hz")
    board.board.card.write("0:/sys/config.g", "M501\n")
    part(tuning, "save-parameters").click()
    server.wait_for(lambda: board.board.card.lines("0:/sys/config-override.g"), 45, "what is saved")
    assert own_errors(page_errors) == []


def test_heaters(page, view, server, board, page_errors):
    heaters = unfold(view, "heaters")
    hotend = row(heaters, "heater-of", "heater", 1)
    monitor = part(hotend, "heater-monitor").nth(1)
    part(monitor, "condition").select_option(label="too hot")
    wait_board(server, board, "heat.heaters[1].monitors[1].condition", "tooHigh")
    expect(part(monitor, "limit")).to_have_value("290")
    type_number(part(monitor, "limit"), 280)
    wait_board(server, board, "heat.heaters[1].monitors[1].limit", 280)
    part(monitor, "action").select_option(index=2)
    wait_board(server, board, "heat.heaters[1].monitors[1].action", 2)
    part(monitor, "condition").select_option(label="off")
    wait_board(server, board, "heat.heaters[1].monitors[1].condition", "disabled")

    before = part(hotend, "heater-model").inner_text()
    type_number(part(hotend, "tune"), 200)
    wait_text(page.locator(".modal.in"), "E0, 200 °C")
    confirm(page)
    expect(part(hotend, "is-tuning")).to_be_visible()
    wait_text(part(view, "heaters"), "E0 tuning")
    wait_text(part(heaters, "tuning-said"), "starting phase")
    wait_text(part(heaters, "tuning-said"), "completed")
    expect(part(hotend, "is-tuning")).to_be_hidden()
    expect(part(hotend, "heater-model")).not_to_have_text(before)
    assert own_errors(page_errors) == []


def test_outputs_variables_and_probe(page, view, server, board, page_errors):
    outputs = unfold(view, "outputs")
    type_number(part(outputs, "output-value"), 40)
    wait_board(server, board, "state.gpOut[0].pwm", 0.4)
    part(outputs, "output-off").click()
    wait_board(server, board, "state.gpOut[0].pwm", 0)
    part(outputs, "colour").fill("#ff8000")
    part(outputs, "light").click()
    sent(server, board, "M150 E0 R255 U128 B0 P255 S60 F0")

    variables = unfold(view, "variables")
    for name, text, value in (
        ("material", 'it\'s "PETG"', 'it\'s "PETG"'),
        ("retries", "5", 5),
        ("lightsOn", "false", False),
    ):
        form = row(variables, "variable", "name", name)
        part(form, "variable-value").fill(text)
        part(form, "variable-value").press("Enter")
        wait_board(server, board, f"global.{name}", value)
        expect(part(form, "variable-value")).to_have_value(text)

    bed = unfold(view, "bed")
    type_number(part(bed, "probe-height"), 1.2)
    wait_board(server, board, "sensors.probes[0].triggerHeight", 1.2)
    part(bed, "probe-measure").click()
    sent(server, board, "G30 S-1")
    wait_text(page.locator(".ui-pnotify:visible").last, "Stopped at height")
    part(bed, "probe-set").click()
    sent(server, board, "G30")
    assert own_errors(page_errors) == []


def test_positions_that_are_kept(page, view, server, board, page_errors):
    home(server, board)
    board.board.execute("G1 X30 Y40 Z5 F6000", channel="http")
    places = unfold(view, "places")
    helpers.wait_value(server, "move.axes[0].machinePosition", 30, 45)
    place = row(places, "place", "place", 3)
    part(place, "keep").click()
    wait_board(server, board, "state.restorePoints[3].coords", [30, 40, 5])
    wait_text(part(place, "coordinates"), "X 30.00 Y 40.00 Z 5.00 mm")
    board.board.execute("G1 X100 F6000", channel="http")
    helpers.wait_value(server, "move.axes[0].machinePosition", 100, 45)
    part(place, "return").click()
    wait_board(server, board, "move.axes[0].machinePosition", 30)
    board.board.card.write("0:/sys/resurrect.g", "M117 on again\n")
    part(places, "resume-print").click()
    confirm(page)
    wait_board(server, board, "state.displayMessage", "on again")
    assert own_errors(page_errors) == []


BEEPS = """() => {
    window.beeps = [];
    window.AudioContext = class {
        constructor() { this.currentTime = 0; this.destination = {}; }
        resume() {}
        createGain() { return {gain: {}, connect: (to) => to}; }
        createOscillator() {
            const tone = {frequency: {}, connect: (to) => to, start: () => undefined};
            tone.stop = (at) => window.beeps.push([tone.frequency.value, at]);
            return tone;
        }
    };
}"""


@both_hosts
def test_drivers_and_beeps(page, view, server, board, page_errors):
    boards = unfold(view, "boards")
    wait_text(row(boards, "driver", "driver", "0.2"), "0.2 Z ok")
    bad = row(boards, "driver", "driver", "20.0")
    expect(bad).to_have_class("label label-important")
    wait_text(bad, "too hot")
    page.evaluate(BEEPS)
    board.board.execute("M300 S900 P400", channel="http")
    helpers.wait_polls(server, 2)
    assert page.evaluate("beeps") == []
    part(boards, "sound").click()
    board.board.execute("M300 S880 P30000", channel="http")
    page.wait_for_function("beeps.length === 1")
    assert page.evaluate("beeps") == [[880, 5]]
    part(boards, "sound").click()
    assert own_errors(page_errors) == []


def test_a_print_greys_what_it_forbids(page, view, board, server):
    for name in ("tuning", "heaters", "outputs", "places", "bed", "boards"):
        unfold(view, name)
    expect(part(view, "tune").first).to_be_enabled()
    # a macro may have just ended
    page.wait_for_function(
        "OctoPrint.coreui.viewmodels.rrfModelViewModel.latest.state.status === 'idle'",
    )
    page.evaluate(
        """() => {
            const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
            const state = Object.assign({}, core.latest.state, {status: "processing"});
            const message = {type: "model", changed: {state: state}, status: core.status()};
            core.onDataUpdaterPluginMessage("rrfmodel", message);
            const tests = ["current", "shaper", "save-parameters", "tune", "condition", "keep",
                "probe-measure", "probe-height", "update", "resume-print"];
            const found = (test) =>
                document.querySelector(`#rrfmodel_machine_parts [data-test=${test}]`);
            window.open = tests.filter((test) => !found(test).matches(":disabled"));
            window.goes = ["advance", "output-on", "light"].filter((test) =>
                found(test).matches(":disabled"));
        }"""
    )
    assert page.evaluate("window.open") == []
    assert page.evaluate("window.goes") == []


def test_firmware_is_updated_after_two_questions(page, view, server, board, page_errors):
    boards = unfold(view, "boards")
    part(part(boards, "board").last, "update").click()
    wait_text(page.locator(".modal.in"), "lies on the card")
    confirm(page)
    expect(page.locator(".modal.in")).to_contain_text("Really")
    assert "M997 B20" not in helpers.commands(board)
    confirm(page)
    sent(server, board, "M997 B20")
    assert own_errors(page_errors) == []
