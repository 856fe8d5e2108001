"""The settings page in its parts, and when the first-run wizard comes and stays away."""

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN
from tests.support.browser import open_octoprint

from .. import helpers
from . import SECONDS, both_hosts, own_errors, part, wait_text
from .wizard import PROFILE, SHOW, command, setup

BOARD = {"machine": "corexy"}


@pytest.fixture
def server(unasked_server):
    return unasked_server


def wizard_of(page):
    return page.locator("#rrfmodel_wizard_dialog")


def open_settings(page, server):
    open_octoprint(page, server, ADMIN)
    page.evaluate(SHOW)
    pane = page.locator("#rrfmodel_setup")
    part(pane, "needed").first.wait_for()
    return pane


def test_all_that_differs_is_written_at_once(server):
    before = server.get(PROFILE).json()
    assert command(server, command="fix_profile", all=True).status_code == 204
    assert setup(server)["profile"] == []
    after = server.get(PROFILE).json()
    kept = ("id", "name", "model", "color")
    assert [after[name] for name in kept] == [before[name] for name in kept]
    assert after["extruder"]["nozzleDiameter"] == before["extruder"]["nozzleDiameter"]
    assert command(server, command="restore_settings").status_code == 204
    assert server.get(PROFILE).json() == before


@pytest.mark.parametrize("wrong", ["yes", 1, []])
def test_all_is_true_or_false(server, wrong):
    before = server.get(PROFILE).json()
    refused = command(server, command="fix_profile", all=wrong)
    assert refused.status_code == 400
    assert "all" in refused.json()["error"]
    assert server.get(PROFILE).json() == before


def test_the_wizard_by_keyboard(own_page, server, page_errors):
    open_octoprint(own_page, server, ADMIN)
    wizard = wizard_of(own_page)
    expect(wizard).to_be_visible()
    expect(wizard.locator("h4")).to_be_focused()
    own_page.keyboard.press("Tab")
    expect(part(wizard, "wizard-setup")).to_be_focused()
    own_page.keyboard.press("Escape")
    expect(wizard).to_be_hidden()
    assert helpers.status(server)["first_run"] is True
    assert own_errors(page_errors) == []


def test_who_wants_it_later_is_asked_again(own_page, server, page_errors):
    open_octoprint(own_page, server, ADMIN)
    wizard = wizard_of(own_page)
    expect(wizard).to_be_visible()
    part(wizard, "wizard-later").click()
    expect(wizard).to_be_hidden()
    helpers.wait_polls(server, 2)
    expect(wizard).to_be_hidden()
    assert helpers.status(server)["first_run"] is True
    open_octoprint(own_page, server, ADMIN)
    expect(wizard_of(own_page)).to_be_visible()
    assert own_errors(page_errors) == []


def test_who_declines_is_not_asked_again(own_page, server, page_errors):
    open_octoprint(own_page, server, ADMIN)
    wizard = wizard_of(own_page)
    expect(wizard).to_be_visible()
    part(wizard, "wizard-never").click()
    expect(wizard).to_be_hidden()
    server.wait_for(lambda: not helpers.status(server)["first_run"], 45, "the end of the first run")
    # nothing was written
    assert not all(row["fulfilled"] for row in setup(server)["settings"])
    assert setup(server)["profile"]
    assert own_errors(page_errors) == []


def test_the_wizard_comes_with_the_first_machine(own_page, server, board):
    helpers.disconnect(server)
    open_octoprint(own_page, server, ADMIN)
    expect(wizard_of(own_page)).to_be_hidden()
    helpers.connect(server, board, SECONDS)
    expect(wizard_of(own_page)).to_be_visible()


@both_hosts
def test_the_wizard_waits_for_another_dialog(own_page, server, board):
    helpers.disconnect(server)
    pane = open_settings(own_page, server)
    helpers.connect(server, board, SECONDS)
    own_page.wait_for_function("OctoPrint.coreui.viewmodels.rrfModelViewModel.status().first_run")
    expect(pane).to_be_visible()
    expect(wizard_of(own_page)).to_be_hidden()
    own_page.evaluate("OctoPrint.coreui.viewmodels.settingsViewModel.hide()")
    expect(wizard_of(own_page)).to_be_visible()


def test_the_wizard_stays_away_where_nothing_is_to_do(own_page, server):
    command(server, command="fix_settings")
    command(server, command="fix_profile", all=True)
    helpers.wait_polls(server, 2)
    assert helpers.status(server)["first_run"] is True
    with own_page.expect_response(lambda response: response.url.endswith("/rrfmodel/setup")):
        open_octoprint(own_page, server, ADMIN)
    expect(part(own_page.locator("#rrfmodel_setup"), "profile-fits")).to_have_count(1)
    assert own_page.evaluate("$('.modal:visible').length") == 0


@both_hosts
def test_settings_are_set_and_taken_back(own_page, server, page_errors):
    command(server, command="wizard_done")
    before = server.get(PROFILE).json()
    pane = open_settings(own_page, server)
    part(pane, "set-needed").click()
    wait_text(part(pane, "needed-state").last, "as needed")
    # and that it isn't in effect yet is said there and in the sidebar
    expect(part(pane, "needs-reconnect")).to_be_visible()
    told = [warning["code"] for warning in helpers.status(server)["warnings"]]
    assert "settings_reconnect" in told
    part(pane, "write-profile").click()
    expect(part(pane, "profile-fits")).to_be_visible()
    assert server.get(PROFILE).json() != before
    # OctoPrint doesn't ask whose settings are to stay
    expect(own_page.locator("#settings_dialog_update_detected")).to_be_hidden()
    part(pane, "restore").click()
    wait_text(part(pane, "needed-state").last, "to be set")
    expect(part(pane, "difference").first).to_be_visible()
    assert server.get(PROFILE).json() == before
    assert own_errors(page_errors) == []


@both_hosts
def test_every_part_of_the_settings_is_there(own_page, server, page_errors):
    command(server, command="wizard_done")
    open_settings(own_page, server)
    dialog = own_page.locator("#settings_plugin_rrfmodel")
    headings = [text.strip() for text in dialog.locator("h4").all_inner_texts()]
    assert headings == [
        "Pause a print that OctoPrint streams when",
        "Connection",
        "Terminal",
        "When a print of OctoPrint is cancelled",
        "Bar at the top of the page",
        "Rows of the sidebar",
        "What RepRapFirmware needs of OctoPrint",
        "Printer profile",
        "Other plugins",
        "Clients of Moonraker's",
        "Simulated printer",
        "Support bundle",
    ]
    # each control has a name, and follows the setting
    unnamed = dialog.evaluate(
        """pane => Array.from(pane.querySelectorAll("input")).filter(
            input => !input.labels.length && !input.ariaLabel).length"""
    )
    assert unnamed == 0
    box = dialog.get_by_label("A heater reports a fault")
    assert box.is_checked()
    assert own_errors(page_errors) == []
