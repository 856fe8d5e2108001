"""The page with a board that knows no M409: its job is told, and nothing that it doesn't tell."""

import re

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN

from .. import helpers
from . import SECONDS, open_view, own_errors, part, show_view

BOARD = {"machine": "cartesian", "firmware": "2.05"}

FILE = "0:/gcodes/square.gcode"


EMPTY = """() => Array.from(document.querySelectorAll("#rrfmodel_machine_parts section")).filter(
    (section) => section.offsetHeight && !section.innerText.replace(
        section.querySelector("h4") ? section.querySelector("h4").innerText : "", "").trim()
).map((section) => section.innerText)"""


@pytest.fixture
def page(own_page, server):
    # the whole model of such a board never comes, which a page that stays open is waited for
    open_view(own_page, server, ADMIN, "machine")
    return own_page


def test_its_own_print_is_shown(page, server, board, page_errors):
    board.board.execute(f'M32 "{FILE}"', channel="http")
    helpers.wait_value(server, "state.status", "processing", SECONDS)
    view = show_view(page, "job")
    expect(part(view, "job-name")).to_have_text("square.gcode")
    expect(part(view, "no-file")).to_be_hidden()
    expect(part(view, "status")).to_have_text(re.compile("Printing from its card|Heating|Homing"))
    board.board.speed = 20
    expect(part(view, "job-percent")).to_have_text(re.compile(r"[1-9]"))
    assert own_errors(page_errors) == []


def test_what_it_does_not_tell_is_not_there(page):
    view = page.locator("#rrfmodel_machine_parts")
    view.locator("visible=true").first.wait_for()
    for name in ("macros", "filaments"):
        expect(part(page.locator("#rrfmodel_machine"), name)).to_be_hidden()
    for head in view.locator("[data-test^=fold-]:visible").all():
        head.click()
    assert page.evaluate(EMPTY) == []
    for offsets in part(view, "probe-offsets").all():
        assert offsets.is_hidden() or re.search(r"\d", offsets.inner_text())
