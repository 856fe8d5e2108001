"""The buttons of the page: what they do, and that only those see them who may press them."""

import pytest
from playwright.sync_api import expect

from octoprint_rrfmodel.host.plugin_settings import DEFAULTS
from tests.support.basedir import ADMIN, OPERATOR
from tests.support.browser import open_octoprint

from .. import helpers

pytestmark = [
    pytest.mark.both_hosts("settings of the serial line lie in different places"),
]


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory()


@pytest.fixture
def board(server, board_factory):
    board = board_factory()
    helpers.connect(server, board)
    yield board
    helpers.disconnect(server)


def warnings(server):
    return [found["code"] for found in helpers.status(server)["warnings"]]


SWITCHES = ("operations", "replies", "guard")
"""Groups of settings of which each row of a table has one."""


@pytest.mark.parametrize("group", SWITCHES)
def test_each_row_has_a_switch_that_is_on(server, group):
    rows = DEFAULTS[group]
    settings = server.get("/api/settings").json()["plugins"]["rrfmodel"]
    assert settings[group] == dict.fromkeys(rows, True)
    with server.session(ADMIN) as session:
        page = session.get("/").text
    for row in rows:
        assert f'"checked: settings.plugins.rrfmodel.{group}.{row}"' in page, row


def test_settings(server, board, page, page_errors):
    open_octoprint(page, server, ADMIN)
    page.locator("[data-test=advice]").first.wait_for()
    expect(page.locator("[data-test=advice]")).to_have_count(len(warnings(server)))
    # advice pops up nowhere
    assert page.locator(".ui-pnotify-text", has_text="upper case").count() == 0
    page.locator("[data-test=fix]").click()
    # what OctoPrint reads when it connects is left
    reconnect = page.locator("[data-test=advice]", has_text="takes effect at the next connection")
    reconnect.wait_for()
    expect(page.locator("[data-test=advice]")).to_have_count(1)
    assert warnings(server) == ["settings_reconnect"]
    assert page_errors == []
    server.post("/api/plugin/rrfmodel", json={"command": "restore_settings"})


def test_only_for_those_who_may(server, board, page):
    open_octoprint(page, server, OPERATOR)
    page.locator("[data-test=advice]").first.wait_for()
    assert page.locator("[data-test=fix]").count() == 0


@pytest.mark.parametrize("button", ["[data-test=fix]", ".ui-pnotify .btn-primary"])
def test_restart(server, board, page, button):
    open_octoprint(page, server, OPERATOR)
    server.post("/api/printer/command", json={"command": "M112"})
    server.wait_disconnected()
    page.locator(button).click()
    server.wait_for(lambda: not board.board.is_halted, 20, "the restart")
    server.wait_state("Operational", 30)
    expect(page.locator("[data-test=warning]")).to_have_count(0)
