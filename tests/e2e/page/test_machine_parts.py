"""The sub-view Machine, below: sensors, boards, files; each control used on the board."""

import pytest
from playwright.sync_api import expect

from tests.support.browser import PATIENCE_MS

from .. import helpers
from . import CONFIRM, both_hosts, home, own_errors, part, show_view, wait_board, wait_text

MARKUP = "<img src=x onerror=alert(1)>"

BOARD = {"machine": "corexy", "speed": 20}


def prepare(board):
    board.card.write("0:/macros/<u>More/Park.g", "M117 parked\n")


def parts(page):
    show_view(page, "machine")
    return page.locator("#rrfmodel_machine_parts")


@pytest.fixture
def view(page):
    return parts(page)


def test_what_there_is_to_see(view, board, page_errors):
    data = board.board.data
    endstops = [found for found in data["sensors"]["endstops"] if found]
    probes = [found for found in data["sensors"]["probes"] if found]
    expect(part(view, "endstop")).to_have_count(len(endstops), timeout=PATIENCE_MS)
    expect(part(view, "probe")).to_have_count(len(probes))
    boards = part(view, "board")
    expect(boards).to_have_count(len(data["boards"]))
    wait_text(boards.first, data["boards"][0]["firmwareVersion"])
    wait_text(boards.first, "V")
    wait_text(part(view, "kinematics"), data["move"]["kinematics"]["name"])
    address = data["network"]["interfaces"][0]["actualIP"]
    expect(part(view, "link")).to_have_attribute("href", f"http://{address}/")
    wait_text(part(view, "volume").first, "free")
    assert own_errors(page_errors) == []


def test_mesh(view, server, board, page_errors):
    home(server, board)
    part(view, "mesh-probe").click()
    wait_board(server, board, "move.compensation.type", "mesh", 60)
    wait_text(part(view, "mesh-type"), "mesh")
    part(view, "mesh-clear").click()
    wait_board(server, board, "move.compensation.type", "none", 45)
    sent_before = len(helpers.commands(board))
    part(view, "calibrate").click()
    server.wait_for(
        lambda: "G32" in helpers.commands(board)[sent_before:], 45, "the bed to be levelled"
    )
    part(view, "mesh-load").click()
    wait_board(server, board, "move.compensation.type", "mesh", 45)
    assert own_errors(page_errors) == []


def sent(server):
    return server.sent()


@both_hosts
def test_macros(page, view, server, board, page_errors):
    part(view, "macros").click()
    macros = part(view, "macro")
    expect(macros).to_have_text(["<u>More", "Ask first", "Say hello"], timeout=PATIENCE_MS)
    # by key: values above change their height, and a click would land beside
    expect(macros.last).to_be_enabled()
    macros.last.press("Enter")
    server.wait_for(
        lambda: 'M98 P"0:/macros/Say hello"' in "\n".join(sent(server)), 45, "the macro to be run"
    )
    assert own_errors(page_errors) == []


def test_macros_in_a_folder(view, server, page_errors):
    part(view, "macros").click()
    expect(part(view, "macro-up")).to_be_hidden()
    part(view, "macro").first.click()
    wait_text(part(view, "macro-path"), "0:/macros/<u>More")
    expect(part(view, "macro")).to_have_count(1)
    part(view, "macro").click()
    run = 'M98 P"0:/macros/<u>More/Park.g"'
    server.wait_for(lambda: run in "\n".join(sent(server)), 45, "the macro to be run")
    part(view, "macro-up").click()
    expect(part(view, "macro")).to_have_count(3)
    assert own_errors(page_errors) == []


def test_a_double_click_on_a_folder_runs_no_macro(view, server):
    part(view, "macros").click()
    expect(part(view, "macro")).to_have_count(3)
    before = len(sent(server))
    # the folder's content is known, so that it comes at once
    part(view, "macro").first.click()
    wait_text(part(view, "macro-path"), "More")
    part(view, "macro-up").click()
    expect(part(view, "macro")).to_have_count(3)
    part(view, "macro").first.dblclick()
    wait_text(part(view, "macro-path"), "More")
    helpers.wait_polls(server, 2)
    assert not [line for line in sent(server)[before:] if "M98" in line]


def test_text_of_the_machine_is_never_markup(view, board, page_errors):
    data = board.board.data
    before = data["boards"][0]["name"], data["network"]["name"]
    try:
        data["boards"][0]["name"] = "<b>board</b>"
        data["network"]["name"] = "<img src=x onerror=alert(1)>"
        board.board.bump("boards")
        board.board.bump("network")
        wait_text(part(view, "board").first, "<b>board</b>")
        wait_text(view, "<img src=x onerror=alert(1)>")
        assert view.locator("b, img").count() == 0
    finally:
        data["boards"][0]["name"], data["network"]["name"] = before
        board.board.bump("boards")
        board.board.bump("network")
    assert own_errors(page_errors) == []


def test_monitor_that_reports_a_fault(view, board):
    monitor = board.board.data["sensors"]["filamentMonitors"][0]
    label = part(view, "monitor").first.locator(".label")
    expect(label).to_have_class("label label-success")
    before = monitor["status"]
    try:
        monitor["status"] = "tooLittleMovement"
        board.board.bump("sensors")
        wait_text(label, "too little movement")
        expect(label).to_have_class("label label-important")
    finally:
        monitor["status"] = before
        board.board.bump("sensors")
    wait_text(label, "ok")


def test_filaments(view, server, board):
    board.board.execute("T0", channel="http")
    helpers.wait_value(server, "state.currentTool", 0, 45)
    part(view, "filaments").click()
    part(view, "load").first.wait_for()
    view.get_by_role("button", name="Load PLA").click()
    wait_board(server, board, "move.extruders[0].filament", "PLA", 45)
    helpers.wait_value(server, "move.extruders[0].filament", "PLA", 45)
    part(view, "unload").click()
    assert wait_board(server, board, "move.extruders[0].filament", "", 30) == ""


def test_power(page, view, server, board):
    board.board.execute('M80 C"pson"', channel="http")
    board.board.execute("M81", channel="http")
    part(view, "power-on").click()
    wait_board(server, board, "state.atxPower", True)
    wait_text(part(view, "power-state"), "on")
    part(view, "power-off").click()
    page.locator(CONFIRM).get_by_text("Switch off").click()
    wait_board(server, board, "state.atxPower", False)
    board.board.data["state"].update(atxPower=None, atxPowerPort=None)
    board.board.bump("state")
    expect(part(view, "power")).to_be_hidden(timeout=PATIENCE_MS)


def test_board_of_another_version(view, board):
    boards = board.board.data["boards"]
    count = len(boards)
    label = part(view, "board").last.get_by_text("differs")

    def add(version):
        with board.board.lock:
            boards[count:] = [{**boards[0], "firmwareVersion": version, "canAddress": 20}]
            board.board.bump("boards")
        expect(part(view, "board")).to_have_count(count + 1, timeout=PATIENCE_MS)
        wait_text(part(view, "board").last, version)

    try:
        # two builds of one version go together
        add(boards[0]["firmwareVersion"] + "+2")
        expect(label).to_be_hidden()
        add("3.4.6")
        expect(label).to_be_visible()
    finally:
        with board.board.lock:
            del boards[count:]
            board.board.bump("boards")
    expect(part(view, "board")).to_have_count(count, timeout=PATIENCE_MS)


def test_how_it_moves_and_what_its_pins_read(view, server, board, page_errors):
    with board.board.lock:
        data = board.board.data
        data["move"]["shaping"].update(type="zvd", frequency=42.5)
        data["move"]["extruders"][0]["pressureAdvance"] = 0.04
        data["sensors"]["gpIn"] = [None, {"value": 1}]
        data["state"]["gpOut"] = [{"freq": 500, "pwm": 0.4}]
        data["sensors"]["analog"][0].update(name=MARKUP, lastReading=31.5)
        for key in ("move", "sensors", "state"):
            board.board.bump(key)
    wait_text(part(view, "motion-shaping"), "zvd 42.5 Hz")
    wait_text(part(view, "motion-pressure"), "0.040 s")
    wait_text(part(view, "motion-workplace"), "G54")
    wait_text(part(view, "motion-running"), "0:")
    expect(part(view, "input")).to_have_text(["Input 11"])
    expect(part(view, "output")).to_have_text(["Output 040 %"])
    wait_text(part(view, "sensor").first, MARKUP)
    board.board.execute("G59.2", channel="http")
    wait_text(part(view, "motion-workplace"), "G59.2")
    board.board.execute("G54", channel="http")
    # a move has a speed while it lasts
    home(server, board)
    board.board.execute("G1 X10 F6000", channel="http")
    board.board.execute("G1 X200 F300", channel="http")
    wait_text(part(view, "motion-requested"), "5.0 mm/s")
    assert own_errors(page_errors) == []


def test_who_may_only_read_can_only_look(reader_page):
    view = parts(reader_page)
    part(view, "filaments").click()
    part(view, "load").first.wait_for()
    part(view, "macros").click()
    part(view, "macro").first.click()
    wait_text(part(view, "macro-path"), "More")
    looking = {"macros", "filaments", "macro-up"}
    controls = view.locator("button:visible, input:visible").all()
    enabled = {control.get_attribute("data-test") for control in controls if control.is_enabled()}
    assert enabled == looking
    assert len(controls) > len(looking) + 4
