"""Words instead of names of the code: in the settings, the wizard and the views; tab and chip."""

import re

import pytest
from playwright.sync_api import expect

from octoprint_rrfmodel.simulator.faults import FAULTS
from octoprint_rrfmodel.simulator.firmware import VERSIONS
from octoprint_rrfmodel.simulator.machines import MACHINES

from .. import helpers
from . import both_hosts, own_errors, part, show_view, wait_text
from .wizard import SHOW

BOARD = {"machine": "corexy"}

HIDE = "OctoPrint.coreui.viewmodels.settingsViewModel.hide()"

IDENTIFIER = re.compile(
    r"""(?<![\w./"])(?:
        [a-z]+(?:_[a-z0-9]+)+            # snake_case
        |[a-z]{2,}[A-Z]\w*               # camelCase
        |\w+(?:\.[a-z]\w+){2,}           # dotted.path.of
    )(?![\w./"])""",
    re.VERBOSE,
)
"""A name of the code; names of files and texts in quotes are none."""


def identifiers(text):
    # a list of G-codes, the MQTT topic and the addresses of hosts are what they are
    return [found for found in IDENTIFIER.findall(text) if not re.match(r"[\d.]+$", found)]


def test_what_is_a_name_of_the_code():
    assert identifiers("jog_mode is plugins.serial_connector.longRunningCommands, coreXY") == [
        "jog_mode",
        "plugins.serial_connector.longRunningCommands",
        "coreXY",
    ]
    assert identifiers("OctoPrint runs config.g of RRF 3.5.3 at 192.0.2.17: CoreXY, mm/s²") == []


@pytest.fixture
def other_board(server):
    """What stands in the file and in no list; set before the dialog is open, or 1.11 asks."""
    group = "plugins.rrfmodel.simulator"
    before = server.get("/api/settings").json()["plugins"]["rrfmodel"]["simulator"]
    server.set_setting(f"{group}.faults", ["lost_ok:50"])
    server.set_setting(f"{group}.firmware", "3.5.4")
    yield
    for name, value in before.items():
        server.set_setting(f"{group}.{name}", value)


@pytest.fixture
def pane(page):
    """The plugin's settings, with all that is folded open."""
    page.evaluate(SHOW)
    found = page.locator("#settings_plugin_rrfmodel")
    part(found, "needed").first.wait_for()
    found.evaluate(
        "(pane) => pane.querySelectorAll('details').forEach((each) => (each.open = true))"
    )
    yield found
    page.evaluate(HIDE)
    expect(page.locator("#settings_dialog")).to_be_hidden()


def test_no_names_of_the_code_in_settings_and_wizard(page, pane):
    assert identifiers(pane.inner_text()) == []
    assert identifiers(page.locator("#rrfmodel_wizard_dialog").text_content()) == []
    # and each switch is told in words
    told = pane.locator("label.checkbox:visible").all_inner_texts()
    assert all(len(text.strip()) > 3 for text in told)


@pytest.mark.parametrize("view", ["machine", "job", "chart"])
def test_no_names_of_the_code_in_the_views(page, server, view):
    region = show_view(page, view)
    helpers.wait_polls(server, 1)
    region.evaluate(
        "(pane) => pane.querySelectorAll('details').forEach((each) => (each.open = true))"
    )
    seen = page.locator("#tab_plugin_rrfmodel").inner_text()
    assert identifiers(seen) == []


def values(locator):
    return locator.evaluate_all("(all) => all.map((each) => each.value)")


@both_hosts
def test_the_simulated_board_is_chosen_from_lists(page, server, other_board, pane, page_errors):
    assert values(part(pane, "simulated-machine").locator("option")) == list(MACHINES)
    assert values(part(pane, "simulated-firmware").locator("option")) == list(VERSIONS)
    assert sorted(values(part(pane, "simulated-fault"))) == sorted(
        name for name in FAULTS if not name.startswith("net_")
    )
    names = part(pane, "simulated-machine").locator("option").all_inner_texts()
    assert not set(names) & set(MACHINES)

    part(pane, "simulated-machine").select_option("delta")
    pane.get_by_label("There is no supply for the motors").check()
    page.evaluate("OctoPrint.coreui.viewmodels.settingsViewModel.saveData()")

    def told():
        return server.get("/api/settings").json()["plugins"]["rrfmodel"]["simulator"]

    server.wait_for(lambda: told()["machine"] == "delta", 45, "the settings to be written")
    # what stands in no list stays
    assert told()["faults"] == ["lost_ok:50", "vin_off"]
    assert told()["firmware"] == "3.5.4"
    assert own_errors(page_errors) == []


TERMS = {
    "kinematics": ["cartesian", "coreXY", "CoreXYU", "delta", "linearDelta", "markForged", "Scara"],
    "network": ["wifi", "ethernet", "lan"],
    "link": ["active", "disabled", "idle", "connecting", "obtainingIP"],
    "monitor": ["simple", "pulsed", "laser", "rotatingMagnet"],
    "monitorStatus": ["noDataReceived", "tooLittleMovement"],
    "compensation": ["none", "mesh"],
    "shaping": ["none", "zvddd", "ei2"],
    "spindle": ["stopped", "unconfigured"],
    "condition": ["tooHigh"],
    "action": [0, 3],
}


def test_terms_of_the_firmware_in_words(page):
    found = page.evaluate(
        """(terms) => _.mapValues(terms,
            (names, kind) => names.map((name) => RRFModel.term(kind, name)))""",
        TERMS,
    )
    for kind, names in TERMS.items():
        for name, word in zip(names, found[kind]):
            assert word, (kind, name)
            assert identifiers(word) == [], (kind, name)
            assert word not in ("none", "active", "FFF", "3"), (kind, name)
    # a newer firmware's is shown as it came, what is not there as nothing
    assert page.evaluate("RRFModel.term('kinematics', 'newOne')") == "newOne"
    assert page.evaluate("RRFModel.term('kinematics', 'constructor')") == "constructor"
    assert (
        page.evaluate("[null, undefined, ''].map((each) => RRFModel.term('link', each))")
        == [""] * 3
    )


@both_hosts
def test_the_tab_has_room_and_the_chip_leads_to_it(page, server, board, page_errors):
    # beside OctoPrint's own, in its page of 940 px
    link = page.locator("#tab_plugin_rrfmodel_link a")
    expect(link).to_have_text("RRF")
    expect(link).to_be_visible()
    chip = part(page, "navbar-chip")
    page.locator("#temp_link a").click()
    wait_text(part(chip, "navbar-state"), "Idle")
    show = "OctoPrint.coreui.viewmodels.rrfModelViewModel.isShown('job')()"
    # the view that was looked at last
    page.evaluate("window.location.hash = '#tab_plugin_rrfmodel/job'")
    page.wait_for_function(show)
    page.locator("#temp_link a").click()
    page.wait_for_function(f"!{show}")
    chip.focus()
    page.keyboard.press("Enter")
    page.wait_for_function(show)
    assert own_errors(page_errors) == []


def test_the_chip_tells_a_fault(page, board):
    chip = part(page, "navbar-chip")
    expect(chip).not_to_have_attribute("data-state", "fault")
    board.board.inject("heater_fault:1")
    try:
        expect(chip).to_have_attribute("data-state", "fault")
        # and which, to who points at it
        expect(chip).to_have_attribute("title", re.compile("fault"))
    finally:
        board.board.clear("heater_fault")
    expect(chip).not_to_have_attribute("data-state", "fault")


def test_without_the_chip(page, server):
    chip = part(page, "navbar-chip")
    expect(chip).to_be_visible()
    server.set_setting("plugins.rrfmodel.navbar", False)
    try:
        page.evaluate("OctoPrint.coreui.viewmodels.settingsViewModel.requestData()")
        expect(chip).to_be_hidden()
    finally:
        server.set_setting("plugins.rrfmodel.navbar", True)
        page.evaluate("OctoPrint.coreui.viewmodels.settingsViewModel.requestData()")
    expect(chip).to_be_visible()
