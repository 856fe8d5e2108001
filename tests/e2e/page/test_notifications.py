"""What is told once when it begins, and taken back when it is over."""

import re

import pytest
from playwright.sync_api import expect

from tests.support.basedir import ADMIN
from tests.support.browser import open_octoprint

from .. import helpers
from . import SECONDS, TOLD, both_hosts, own_errors, part, show_terminal

BOARD = {"machine": "cartesian"}

STREAMED = "G92 X20 Y20 Z1\n" + "G1 X21 F600\nG1 X20 F600\n" * 1000


@pytest.fixture
def told(page):
    """The texts of the notifications that are seen."""
    return page.locator(TOLD)


@both_hosts
def test_why_a_print_is_paused_is_told_once(page, told, server, board, page_errors):
    show_terminal(page)
    server.upload("streamed.gcode", STREAMED)
    server.select_and_print("streamed.gcode")
    server.wait_state("Printing")
    board.board.inject("heater_fault:1")
    server.wait_state("Paused", 40)
    about = told.filter(has_text="Heater E0 reports a fault")
    # one that is replaced by the next is seen for a moment more
    expect(about).to_have_text([re.compile("The print was paused.")])
    helpers.wait_polls(server, 3)
    expect(about).to_have_count(1)
    # without a print it is the heater's fault alone
    server.post("/api/job", json={"command": "cancel"})
    server.wait_state("Operational", 60)
    expect(told.filter(has_text="paused")).to_have_count(0)
    expect(about).to_have_count(1)
    board.board.clear("heater_fault")
    board.board.execute("M562 P1", channel="http")
    expect(about).to_have_count(0)
    assert own_errors(page_errors) == []


def test_row_26_display_text_is_in_the_sidebar_and_no_notification(page, told, server, board):
    shown = page.locator("#sidebar_plugin_rrfmodel [data-test=message]")
    kept = page.evaluate("PNotify.notices.length")
    # as layers of a print are told, also by DisplayLayerProgress
    for layer in range(1, 5):
        board.board.execute(f'M117 "Layer {layer} <b>"', channel="http")
        expect(shown).to_have_text(f"Layer {layer} <b>")
        expect(told.filter(has_text="Layer")).to_have_count(0)
    board.board.execute('M117 ""', channel="http")
    expect(shown).to_have_count(0)
    page.wait_for_function("(kept) => PNotify.notices.length <= kept", arg=kept)


@both_hosts
def test_a_refusal_comes_in_the_language_of_the_page(own_page, server):
    page = own_page
    open_octoprint(page, server, ADMIN, "/?l10n=de")
    part(page, "status").first.wait_for()
    response = server.post("/api/printer/printhead", json={"command": "jog", "x": 5})
    assert response.status_code == 204
    told = page.locator(TOLD)
    expect(told.filter(has_text="Nichts wurde bewegt")).to_have_count(1)


@pytest.fixture
def with_macro(server, board, board_factory):
    """Another board in the module's place, with a macro that asks something."""
    other = board_factory(firmware="3.5.3")
    other.board.card.write("0:/macros/ask.g", 'M291 P"Go on?" S2\n')
    helpers.connect(server, other, SECONDS)
    yield
    helpers.connect(server, board, SECONDS)


def test_a_box_that_nobody_can_answer_is_told(page, told, server, with_macro):
    show_terminal(page)
    server.commands('M98 P"0:/macros/ask.g"')
    about = told.filter(has_text="does not take over USB")
    expect(about).to_have_count(1)
    helpers.disconnect(server)
    expect(about).to_have_count(0)
