"""Settings, printer profile and the first-run wizard: looked at, written, and set back."""

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN, OPERATOR
from tests.support.browser import open_octoprint

from .. import helpers
from . import SECONDS, both_hosts, own_errors, part, wait_text
from .wizard import PROFILE, SHOW, command, setup

BOARD = {"machine": "corexy"}


@pytest.fixture
def server(unasked_server):
    return unasked_server


@both_hosts
def test_wizard_sets_both_and_is_seen_once(own_page, server, page_errors):
    before = server.get(PROFILE).json()
    assert helpers.status(server)["first_run"] is True
    open_octoprint(own_page, server, ADMIN)
    wizard = own_page.locator("#rrfmodel_wizard_dialog")
    expect(wizard).to_be_visible()
    expect(part(wizard, "needed")).to_have_count(4)
    differences = {row["field"]: row["wanted"] for row in setup(server)["profile"]}
    assert differences != {}
    expect(part(wizard, "difference")).to_have_count(len(differences))
    # what it does is folded below it, and it is the only one that looks like the next step
    expect(part(wizard, "needed").first).to_be_hidden()
    expect(wizard.locator(".btn-primary")).to_have_count(1)
    wizard.locator(".btn-primary").click()
    expect(part(wizard, "wizard-is-set")).to_be_visible()
    expect(wizard.locator(".btn-primary")).to_be_hidden()
    assert {row["fulfilled"] for row in setup(server)["settings"]} == {True}
    assert setup(server)["profile"] == []
    after = server.get(PROFILE).json()
    assert after["heatedChamber"] is True
    assert after["volume"]["width"] == differences["volume.width"]
    # OctoPrint goes by it from the next connection on
    part(wizard, "reconnect").click()
    expect(part(wizard, "needs-reconnect")).to_be_hidden()
    server.wait_for(lambda: helpers.status(server)["ready"], SECONDS, "the machine")
    codes = {warning["code"] for warning in helpers.status(server)["warnings"]}
    assert not codes & {"settings_reconnect", "profile_reconnect"}
    part(wizard, "wizard-done").click()
    expect(wizard).to_be_hidden()
    server.wait_for(lambda: not helpers.status(server)["first_run"], 45, "the end of the first run")
    assert own_errors(page_errors) == []
    # and all of it is taken back with the plugin
    assert command(server, command="restore_settings").status_code == 204
    restored = server.get(PROFILE).json()
    assert restored["volume"] == before["volume"]
    assert restored["axes"] == before["axes"]
    assert restored["heatedChamber"] == before["heatedChamber"]


def test_only_what_is_chosen_is_written(server):
    wanted = {row["field"]: row["wanted"] for row in setup(server)["profile"]}
    height = server.get(PROFILE).json()["volume"]["height"]
    assert command(server, command="fix_profile", fields=["volume.width"]).status_code == 204
    volume = server.get(PROFILE).json()["volume"]
    assert volume["width"] == wanted["volume.width"]
    assert volume["height"] == height


def test_what_a_person_changed_in_between_is_what_comes_back(server):
    def width():
        return server.get(PROFILE).json()["volume"]["width"]

    write = {"command": "fix_profile", "fields": ["volume.width"]}
    server.post("/api/plugin/rrfmodel", json=write)
    wanted = width()
    server.patch(PROFILE, json={"profile": {"volume": {"width": 210}}})
    server.post("/api/plugin/rrfmodel", json=write)
    assert width() == wanted
    command(server, command="restore_settings")
    assert width() == 210


@pytest.mark.parametrize("fields", ["volume.width", [1], ["volume.colour"]])
def test_bad_fields_are_refused(server, fields):
    before = server.get(PROFILE).json()
    refused = command(server, command="fix_profile", fields=fields)
    assert refused.status_code == 400
    assert refused.json()["error"]
    assert server.get(PROFILE).json() == before


def test_the_wizard_is_for_those_who_may_change_settings(fresh_page, server):
    open_octoprint(fresh_page, server, OPERATOR)
    fresh_page.locator("[data-test=status]").first.wait_for()
    helpers.wait_polls(server, 2)
    expect(fresh_page.locator("#rrfmodel_wizard_dialog")).to_be_hidden()


@both_hosts
def test_settings_page(own_page, server, page_errors):
    assert command(server, command="wizard_done").status_code == 204
    open_octoprint(own_page, server, ADMIN)
    own_page.evaluate(SHOW)
    pane = own_page.locator("#rrfmodel_setup")
    part(pane, "needed").first.wait_for()
    part(pane, "set-needed").click()
    wait_text(part(pane, "needed-state").first, "as needed")
    expect(part(pane, "difference")).to_have_count(len(setup(server)["profile"]))
    assert own_errors(page_errors) == []


def test_what_was_unticked_stays_so(own_page, server):
    assert command(server, command="wizard_done").status_code == 204
    assert command(server, command="restore_settings").status_code == 204
    open_octoprint(own_page, server, ADMIN)
    own_page.evaluate(SHOW)
    pane = own_page.locator("#rrfmodel_setup")
    ticks = pane.locator("[data-test=difference] input")
    ticks.first.wait_for()
    ticks.first.uncheck()
    part(pane, "set-needed").click()
    wait_text(part(pane, "needed-state").first, "as needed")
    expect(ticks.first).not_to_be_checked()
    expect(ticks.nth(1)).to_be_checked()


def test_settings_page_that_is_open_when_the_machine_comes(own_page, server, board, page_errors):
    assert command(server, command="wizard_done").status_code == 204
    helpers.disconnect(server)
    open_octoprint(own_page, server, ADMIN)
    own_page.evaluate(SHOW)
    pane = own_page.locator("#rrfmodel_setup")
    part(pane, "needed").first.wait_for()
    expect(part(pane, "difference")).to_have_count(0)
    helpers.connect(server, board, SECONDS)
    expect(part(pane, "difference")).not_to_have_count(0)
    helpers.disconnect(server)
    expect(part(pane, "difference")).to_have_count(0)
    assert own_errors(page_errors) == []


@pytest.fixture
def without_axes(server):
    server.set_setting("plugins.rrfmodel.sidebar.axes", False)
    yield
    server.set_setting("plugins.rrfmodel.sidebar.axes", True)


@both_hosts
def test_rows_of_the_sidebar_fold_away(own_page, server, without_axes):
    assert command(server, command="wizard_done").status_code == 204
    open_octoprint(own_page, server, ADMIN)
    sidebar = own_page.locator("[data-test=rrfmodel-sidebar]")
    part(sidebar, "heater").first.wait_for()
    # the whole model is there
    expect(part(sidebar, "sidebar-fan")).not_to_have_count(0)
    expect(part(sidebar, "axis")).to_have_count(0)
