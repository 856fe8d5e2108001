"""The Console: replies and commands with their time, an input with history, by permission."""

import re

import pytest
from playwright.sync_api import expect

from tests.support.basedir import User
from tests.support.browser import open_octoprint

from .. import helpers
from . import TOLD, both_hosts, own_errors, part, show_view

BOARD = {"machine": "cartesian"}

LINES = "[data-test=console-line]"


def said(page, text):
    """Return the lines of the console that are just that."""
    return page.locator(f"{LINES} [data-test=console-text]").get_by_text(text, exact=True)


def ask(page, code):
    field = part(page, "console-input")
    field.fill(code)
    field.press("Enter")


@both_hosts
def test_expressions_work_and_replies_have_their_time(page, server, page_errors):
    show_view(page, "console")
    ask(page, "echo {move.axes[0].machinePosition + 1000}")
    expect(said(page, "echo {move.axes[0].machinePosition + 1000}")).to_have_count(1)
    answer = page.locator(LINES).filter(
        has=page.locator("[data-test=console-text]").filter(has_text=re.compile(r"^1\d\d\d\.0+$"))
    )
    expect(answer.first).to_have_text(re.compile(r"\d+:\d\d:\d\d"))
    # which is no notification beside it
    assert page.locator(TOLD).count() == 0
    assert own_errors(page_errors) == []


def test_errors_are_red_and_the_filter_finds_them(page):
    show_view(page, "console")
    ask(page, 'M98 P"gone.g"')
    warned = page.locator(LINES + ".rrfmodel-warned").filter(has_text="gone.g not found")
    expect(warned).to_have_count(1)
    part(page, "console-filter").fill("gone.g not")
    expect(page.locator(LINES)).to_have_count(1)
    part(page, "console-filter").fill("")
    expect(said(page, 'M98 P"gone.g"')).to_have_count(1)


def test_the_input_remembers(page):
    show_view(page, "console")
    field = part(page, "console-input")
    for code in ('echo "one"', 'echo "two"'):
        ask(page, code)
        expect(said(page, code).first).to_be_visible()
    field.fill("half")
    field.press("ArrowUp")
    expect(field).to_have_value('echo "two"')
    field.press("ArrowUp")
    expect(field).to_have_value('echo "one"')
    field.press("ArrowDown")
    field.press("ArrowDown")
    expect(field).to_have_value("half")
    field.fill("")


def test_what_was_said_while_it_was_hidden_is_there(page, server):
    show_view(page, "console")
    expect(part(page, "console-input")).to_be_enabled()
    show_view(page, "chart")
    page.evaluate(
        """() => { window.changes = 0;
        new MutationObserver((found) => (window.changes += found.length)).observe(
            document.querySelector("#rrfmodel_console"), {subtree: true, childList: true}); }"""
    )
    server.commands('M118 P0 S"while it was hidden"')
    helpers.wait_polls(server, 3)
    assert page.evaluate("window.changes") == 0
    show_view(page, "console")
    expect(said(page, "while it was hidden").first).to_be_visible()


def test_a_reader_sees_and_does_not_send(reader_page, server):
    show_view(reader_page, "console")
    server.commands('M118 P0 S"for all to see"')
    expect(said(reader_page, "for all to see").first).to_be_visible()
    expect(part(reader_page, "console-input")).to_be_disabled()
    expect(part(reader_page, "console-send")).to_be_disabled()


@pytest.fixture
def onlooker(server):
    """Somebody who may read the model, and not watch the terminal."""
    permissions = ["STATUS", "SETTINGS_READ", "PLUGIN_RRFMODEL_READ"]
    group = {"key": "onlookers", "name": "Onlookers", "permissions": permissions}
    added = server.post("/api/access/groups", json={"description": "", "subgroups": [], **group})
    assert added.status_code == 200, added.text
    user = User("onlooker", "onlookers", "onlooker-password", "D0" * 16)
    account = {"name": user.name, "password": user.password, "active": True}
    added = server.post("/api/access/users", json={"groups": ["onlookers"], **account})
    assert added.status_code == 200, added.text
    yield user
    for path in ("users/onlooker", "groups/onlookers"):
        assert server.delete(f"/api/access/{path}").ok


@both_hosts
def test_who_may_not_watch_the_terminal_is_sent_nothing(fresh_page, server, onlooker):
    page = fresh_page
    frames = []
    page.on(
        "websocket", lambda socket: socket.on("framereceived", lambda frame: frames.append(frame))
    )
    open_octoprint(page, server, onlooker, "/#tab_plugin_rrfmodel/console")
    expect(page.locator("#rrfmodel_console")).to_contain_text("may not watch")
    server.commands('M118 P0 S"not for everybody"')
    helpers.wait_polls(server, 3)
    assert page.locator(LINES).count() == 0
    # what the line waits for is anybody's who may read the state
    assert not [frame for frame in frames if '"type":"console"' in str(frame)]
    answer = page.evaluate(
        """() => fetch("/plugin/rrfmodel/console").then((response) => response.status)"""
    )
    assert answer == 403
