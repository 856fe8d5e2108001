"""The sub-view Machine, below: sensors, boards, files; each control used on the board."""

import json

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
    unfold,
    wait_board,
    wait_text,
)

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


@pytest.fixture
def above(page):
    """What is used daily, above the sections."""
    return show_view(page, "machine")


def test_what_there_is_to_see(view, board, page_errors):
    data = board.board.data
    sensors = unfold(view, "sensors")
    endstops = [found for found in data["sensors"]["endstops"] if found]
    expect(part(sensors, "endstop")).to_have_count(len(endstops))
    probes = [found for found in data["sensors"]["probes"] if found]
    expect(part(unfold(view, "bed"), "probe")).to_have_count(len(probes))
    # those of the heaters are told in their rows
    names = part(sensors, "sensor").all_inner_texts()
    assert [name.split()[0] for name in names] == ["mcu"]
    assert names[0].endswith("°C")
    boards = part(unfold(view, "boards"), "board")
    expect(boards).to_have_count(len(data["boards"]))
    wait_text(boards.first, data["boards"][0]["firmwareVersion"])
    wait_text(part(boards.first, "supply"), "V")
    wait_text(part(unfold(view, "kinematics"), "kinematics"), "CoreXY")
    address = data["network"]["interfaces"][0]["actualIP"]
    expect(part(unfold(view, "network"), "link")).to_have_attribute("href", f"http://{address}/")
    wait_text(part(unfold(view, "volumes"), "volume").first, "free")
    assert own_errors(page_errors) == []


def test_sections_tell_the_point_and_stay_as_they_were_left(page, view, server):
    """Folded they say what matters in a line; which are open is remembered."""
    expect(part(part(view, "boards"), "summary")).to_contain_text("24.")
    expect(part(part(view, "sensors"), "summary")).to_contain_text("mcu")
    expect(part(view, "board")).to_have_count(0)
    # a section without content is not there
    expect(part(view, "power")).to_be_hidden()
    unfold(view, "boards")
    kept = json.loads(page.evaluate("localStorage['rrfmodel.folds']"))
    assert [name for name, is_open in kept.items() if is_open] == ["boards"]
    page.evaluate("RRFModel.addFolds(window.again = {})")
    assert page.evaluate("window.again.folds.boards.isOpen()") is True
    assert page.evaluate("window.again.folds.bed.isOpen()") is False


def choose(view, menu, name):
    """Pick from a menu once it can be."""
    expect(part(view, menu)).to_be_enabled()
    part(view, menu).click()
    part(view, name).click()


def test_mesh(view, above, server, board, page_errors):
    home(server, board)
    bed = unfold(view, "bed")
    choose(above, "mesh-menu", "mesh-probe")
    wait_board(server, board, "move.compensation.type", "mesh", 60)
    wait_text(part(bed, "mesh-type"), "mesh")
    wait_text(part(bed, "summary"), "mm")
    choose(above, "mesh-menu", "mesh-clear")
    wait_board(server, board, "move.compensation.type", "none", 45)
    sent_before = len(helpers.commands(board))
    part(above, "calibrate").click()
    server.wait_for(
        lambda: "G32" in helpers.commands(board)[sent_before:], 45, "the bed to be levelled"
    )
    choose(above, "mesh-menu", "mesh-load")
    wait_board(server, board, "move.compensation.type", "mesh", 45)
    assert own_errors(page_errors) == []


def sent(server):
    return server.sent()


@both_hosts
def test_macros(above, server, board, page_errors):
    """They are there without a click, and the one that is looked for is found."""
    macros = part(above, "macro")
    expect(macros).to_have_text([" <u>More", " Ask first", " Say hello"])
    part(above, "macro-filter").fill("HELL")
    expect(macros).to_have_text([" Say hello"])
    expect(macros).to_be_enabled()
    macros.click()
    server.wait_for(
        lambda: 'M98 P"0:/macros/Say hello"' in "\n".join(sent(server)), 45, "the macro to be run"
    )
    assert own_errors(page_errors) == []


def test_macros_in_a_folder(above, server, page_errors):
    expect(part(above, "macro")).to_have_count(3)
    expect(part(above, "macro-up")).to_be_hidden()
    part(above, "macro").first.click()
    wait_text(part(above, "macro-path"), "0:/macros/<u>More")
    expect(part(above, "macro")).to_have_count(1)
    part(above, "macro").click()
    run = 'M98 P"0:/macros/<u>More/Park.g"'
    server.wait_for(lambda: run in "\n".join(sent(server)), 45, "the macro to be run")
    part(above, "macro-up").click()
    expect(part(above, "macro")).to_have_count(3)
    assert own_errors(page_errors) == []


def test_a_double_click_on_a_folder_runs_no_macro(above, server):
    expect(part(above, "macro")).to_have_count(3)
    before = len(sent(server))
    # the folder's content is known, so that it comes at once
    part(above, "macro").first.click()
    wait_text(part(above, "macro-path"), "More")
    part(above, "macro-up").click()
    expect(part(above, "macro")).to_have_count(3)
    part(above, "macro").first.dblclick()
    wait_text(part(above, "macro-path"), "More")
    helpers.wait_polls(server, 2)
    assert not [line for line in sent(server)[before:] if "M98" in line]


LISTED = """() => {
    const client = OctoPrint.plugins.rrfmodel;
    const asked = [];
    const ask = client.getFiles;
    client.getFiles = (path) => asked.push(path) && $.Deferred().promise();
    const core = OctoPrint.coreui.viewmodels.rrfModelViewModel;
    const before = core.status();
    const free = {ready: true, doing: null, blocked: null, resets: 1001};
    const tell = (more) => core.fromStatus(Object.assign({}, before, free, more));
    tell({blocked: "streaming"});
    const busy = new Promise((done) => setTimeout(done)).then(() => asked.length);
    const then = busy.then(() => {
        tell({});
        return new Promise((done) => setTimeout(() => done(asked.slice())));
    });
    return Promise.all([busy, then]).then(function (found) {
        client.getFiles = ask;
        core.fromStatus(before);
        return found;
    });
}"""


def test_the_card_is_not_asked_while_the_line_has_something_to_do(page, above):
    expect(part(above, "macro")).to_have_count(3)
    assert page.evaluate(LISTED) == [0, ["0:/macros"]]


def test_text_of_the_machine_is_never_markup(view, board, page_errors):
    data = board.board.data
    before = data["boards"][0]["name"], data["network"]["name"]
    try:
        data["boards"][0]["name"] = "<b>board</b>"
        data["network"]["name"] = "<img src=x onerror=alert(1)>"
        board.board.bump("boards")
        board.board.bump("network")
        wait_text(part(unfold(view, "boards"), "board").first, "<b>board</b>")
        wait_text(unfold(view, "network"), "<img src=x onerror=alert(1)>")
        assert view.locator("b, img").count() == 0
    finally:
        data["boards"][0]["name"], data["network"]["name"] = before
        board.board.bump("boards")
        board.board.bump("network")
    assert own_errors(page_errors) == []


def test_monitor_that_reports_a_fault(view, board):
    monitor = board.board.data["sensors"]["filamentMonitors"][0]
    label = part(unfold(view, "sensors"), "monitor").first.locator(".label")
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


def test_filaments(above, server, board):
    board.board.execute("T0", channel="http")
    helpers.wait_value(server, "state.currentTool", 0, 45)
    expect(part(above, "filaments")).to_be_enabled()
    part(above, "filaments").click()
    above.get_by_role("link", name="Load PLA").click()
    wait_board(server, board, "move.extruders[0].filament", "PLA", 45)
    helpers.wait_value(server, "move.extruders[0].filament", "PLA", 45)
    # its config.g comes behind, and a machine that is busy takes no other
    helpers.wait_value(server, "state.status", "idle", 45)
    wait_text(part(above, "loaded"), "PLA")
    part(above, "unload").click()
    assert wait_board(server, board, "move.extruders[0].filament", "", 30) == ""


def test_power(page, view, server, board):
    board.board.execute('M80 C"pson"', channel="http")
    board.board.execute("M81", channel="http")
    part(unfold(view, "power"), "power-on").click()
    wait_board(server, board, "state.atxPower", True)
    wait_text(part(view, "power-state"), "on")
    part(view, "power-off").click()
    page.locator(CONFIRM).get_by_text("Switch off").click()
    wait_board(server, board, "state.atxPower", False)
    board.board.data["state"].update(atxPower=None, atxPowerPort=None)
    board.board.bump("state")
    expect(part(view, "power")).to_be_hidden()


def test_board_of_another_version(view, board):
    boards = board.board.data["boards"]
    count = len(boards)
    unfold(view, "boards")
    label = part(view, "board").last.get_by_text("differs")

    def add(version):
        with board.board.lock:
            boards[count:] = [{**boards[0], "firmwareVersion": version, "canAddress": 20}]
            board.board.bump("boards")
        expect(part(view, "board")).to_have_count(count + 1)
        wait_text(part(view, "board").last, version)

    try:
        # two builds of one version go together
        add(boards[0]["firmwareVersion"] + "+2")
        expect(label).to_be_hidden()
        expect(part(part(view, "board").last, "can")).to_have_text("CAN address 20")
        add("3.4.6")
        expect(label).to_be_visible()
    finally:
        with board.board.lock:
            del boards[count:]
            board.board.bump("boards")
    expect(part(view, "board")).to_have_count(count)


def test_how_it_moves_and_what_its_pins_read(view, server, board, page_errors):
    with board.board.lock:
        data = board.board.data
        data["move"]["shaping"].update(type="zvd", frequency=42.5)
        data["move"]["extruders"][0]["pressureAdvance"] = 0.04
        data["sensors"]["gpIn"] = [None, {"value": 1}]
        data["state"]["gpOut"] = [{"freq": 500, "pwm": 0.4}]
        data["sensors"]["analog"][4].update(name=MARKUP, lastReading=31.5)
        for key in ("move", "sensors", "state"):
            board.board.bump(key)
    for name in ("kinematics", "sensors", "outputs", "boards"):
        unfold(view, name)
    wait_text(part(view, "motion-shaping"), "ZVD 42.5 Hz")
    wait_text(part(view, "motion-pressure"), "0.040 s")
    wait_text(part(view, "motion-workplace"), "G54")
    wait_text(part(view, "motion-running"), "0:")
    expect(part(view, "input")).to_have_text(["Input 11"])
    expect(part(view, "output")).to_contain_text(["Output 0"])
    wait_text(part(view, "sensor").first, MARKUP)
    board.board.execute("G59.2", channel="http")
    wait_text(part(view, "motion-workplace"), "G59.2")
    board.board.execute("G54", channel="http")
    # a move has a speed while it lasts
    home(server, board)
    board.board.execute("G1 X10 F6000", channel="http")
    board.board.execute("G1 X200 F60", channel="http")
    wait_text(part(view, "motion-requested"), "1.0 mm/s")
    assert own_errors(page_errors) == []


def test_who_may_only_read_can_only_look(reader_page):
    view = show_view(reader_page, "machine")
    expect(part(view, "macro")).to_have_count(3)
    part(view, "macro").first.click()
    wait_text(part(view, "macro-path"), "More")
    looking = {"macros", "macro-up", "macro-filter"}
    section = part(view, "macro-list")
    controls = section.locator("button:visible, input:visible").all()
    enabled = {control.get_attribute("data-test") for control in controls if control.is_enabled()}
    assert enabled == looking
    assert len(controls) == len(looking) + 1
