"""The sidebar in a real browser, fed by push."""

import re

import pytest
from playwright.sync_api import expect

from tests.support.basedir import User
from tests.support.browser import open_octoprint

from .. import helpers
from . import both_hosts, own_errors, part, show_terminal, wait_text

MARKUP = "<img src=x onerror=alert(1)>"


BOARD = {"machine": "cartesian"}


@pytest.fixture(autouse=True)
def _at_rest(board):
    yield
    board.board.speed = 1
    board.board.clear("heater_fault")
    board.board.execute('M562 P1\nM568 P0 S0 R0 A0\nT-1 P0\nM563 P0 S"E0"', channel="http")


@pytest.fixture
def sidebar(page):
    return shown(page)


def shown(page):
    found = part(page, "rrfmodel-sidebar")
    found.wait_for(state="visible")
    return found


@both_hosts
def test_shows_the_machine(sidebar, page_errors):
    wait_text(part(sidebar, "status"), "Idle")
    wait_text(part(sidebar, "tool"), "none")
    heaters = part(sidebar, "heater")
    expect(heaters).to_have_count(2)
    wait_text(heaters.nth(1), "Bed")
    expect(part(sidebar, "axis")).to_have_text([re.compile(rf"^\s*{axis}\b") for axis in "XYZ"])
    wait_text(part(sidebar, "age"), "s ago")
    assert own_errors(page_errors) == []


def test_follows_by_push_alone(page, sidebar, board):
    wait_text(part(sidebar, "status"), "Idle")
    requests = []
    page.on("request", lambda request: requests.append(request.url))
    board.board.execute("M568 P0 S55 R33 A2", channel="http")
    wait_text(part(sidebar, "heater").nth(0), "55")
    wait_text(part(sidebar, "heater").nth(0), "33")
    wait_text(part(sidebar, "heater").nth(0), "active")
    board.board.execute("G28", channel="http")
    page.wait_for_selector("[data-test=axis].label-success")
    board.board.execute("T0", channel="http")
    wait_text(part(sidebar, "tool"), "0")
    # the curves of the Machine view have a clock of their own, and so has what tells who looks
    others = [url for url in requests if not re.search(r"/history\?|/status\?view=", url)]
    assert [url for url in others if "/plugin/rrfmodel/" in url] == []


def test_text_of_the_printer_is_text(page, sidebar, board, page_errors):
    board.board.execute(f'M563 P0 S"{MARKUP}"', channel="http")
    wait_text(part(sidebar, "heater").nth(0), MARKUP)
    assert sidebar.locator("img").count() == 0
    assert own_errors(page_errors) == []


def test_says_what_takes_so_long(sidebar, server, board):
    wait_text(part(sidebar, "status"), "Idle")
    server.commands("G4 S900")
    wait_text(part(sidebar, "status"), "Waiting, ")
    # it has been long enough
    board.board.speed = 300
    server.wait_for(lambda: helpers.status(server)["blocked"] is None, 40, "the command to end")
    assert "Waiting" not in wait_text(part(sidebar, "status"), "Idle")


def test_heater_fault_is_told_and_taken_back(page, sidebar, board, page_errors):
    wait_text(part(sidebar, "status"), "Idle")
    show_terminal(page)
    board.board.inject("heater_fault:1")
    wait_text(part(sidebar, "warning"), "Heater E0 reports a fault")
    wait_text(page.locator(".ui-pnotify-text").last, "Heater E0 reports a fault")
    board.board.clear("heater_fault")
    board.board.execute("M562 P1", channel="http")
    part(sidebar, "warning").wait_for(state="detached")
    assert own_errors(page_errors) == []


def test_a_reader_sees_it_too(reader_page, page_errors):
    wait_text(part(shown(reader_page), "status"), "Idle")
    assert own_errors(page_errors) == []


@both_hosts
def test_nobody_without_the_permission_sees_it(fresh_page, server):
    page = fresh_page
    group = {"key": "onlookers", "name": "Onlookers", "permissions": ["STATUS", "SETTINGS_READ"]}
    added = server.post("/api/access/groups", json={"description": "", "subgroups": [], **group})
    assert added.status_code == 200, added.text
    onlooker = User("onlooker", "onlookers", "onlooker-password", "D0" * 16)
    account = {"name": onlooker.name, "password": onlooker.password, "active": True}
    added = server.post("/api/access/users", json={"groups": ["onlookers"], **account})
    assert added.status_code == 200, added.text
    open_octoprint(page, server, onlooker)
    helpers.wait_polls(server, 3)
    assert page.locator("[data-test=rrfmodel-sidebar]").is_hidden()
    assert "Idle" not in page.locator("#sidebar_plugin_rrfmodel").inner_text()
    for path in ("users/onlooker", "groups/onlookers"):
        assert server.delete(f"/api/access/{path}").ok


def test_a_warning_that_stays_is_not_made_anew(page, server, sidebar, board):
    show_terminal(page)
    board.board.inject("heater_fault:1")
    wait_text(sidebar, "Heater E0 reports a fault")
    polls = helpers.status(server)["counters"]["polls"]
    page.evaluate(
        """() => {
            window.alerts = 0;
            const isAlert = (node) => node.nodeType === 1 && node.matches("[role=alert]");
            const observer = new MutationObserver((found) => {
                for (const change of found) {
                    window.alerts += [...change.addedNodes].filter(isAlert).length;
                }
            });
            const sidebar = document.querySelector("#sidebar_plugin_rrfmodel");
            observer.observe(sidebar, {childList: true, subtree: true});
        }"""
    )
    server.wait_for(
        lambda: helpers.status(server)["counters"]["polls"] > polls + 3, 45, "more polls"
    )
    assert page.evaluate("window.alerts") == 0
