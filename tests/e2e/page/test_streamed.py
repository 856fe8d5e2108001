"""What the page says of a print that OctoPrint sends: name, progress, buttons."""

import re

import pytest
from playwright.sync_api import expect

from .. import helpers
from . import CONFIRM, SECONDS, own_errors, part, show_view

BOARD = {"machine": "cartesian"}

NAME = "sent_by_octoprint.gcode"

LAYERS = 30

MOVES = "".join(
    f";LAYER_CHANGE\n;Z:{0.2 * (number + 1):.1f}\n" + f"G4 P{400 + number % 2}\n" * 10
    for number in range(LAYERS)
)

CARD = "0:/gcodes/on_the_card.gcode"


@pytest.fixture
def view(page, server, board):
    # one of the card's own was printed before
    board.board.card.write(CARD, "G4 S1\n")
    board.board.execute(f'M32 "{CARD}"', channel="http")
    helpers.wait_value(server, "job.lastFileName", CARD, SECONDS)
    server.upload(NAME, MOVES)
    server.select_and_print(NAME)
    server.wait_state("Printing")
    yield show_view(page, "job")
    if server.get("/api/printer").json()["state"]["flags"]["operational"]:
        server.post("/api/job", json={"command": "cancel"})
    server.wait_state("Operational")


def test_the_job_is_octoprints(page, view, server, board, page_errors):
    expect(part(view, "job-name")).to_have_text(NAME)
    expect(part(view, "no-file")).to_be_hidden()
    state = "Printing, sent by OctoPrint"
    for place in (
        part(view, "status"),
        page.locator("[data-test=strip-state]"),
        page.locator("#sidebar_plugin_rrfmodel [data-test=status]"),
    ):
        expect(place).to_have_text(state)
    percent = part(view, "job-percent")
    expect(percent).to_have_text(re.compile(r"[1-9]"))
    # nothing of the card's last print, and nothing to begin
    for name in ("last", "card", "past"):
        expect(part(view, name)).to_have_count(0)
    for name in ("start", "simulate"):
        expect(part(view, name)).to_be_hidden()
    # layers by the file and by what was sent, which the board can't tell
    expect(part(view, "layer")).to_have_text(re.compile(rf"^[2-9] / {LAYERS}$"))
    expect(part(view, "layers")).to_be_visible()
    expect(part(view, "job-ends")).to_contain_text(re.compile("left|not known yet"))
    part(view, "pause").click()
    server.wait_state("Paused")
    expect(part(view, "status")).to_have_text("Paused")
    expect(part(view, "pause")).to_be_disabled()
    part(view, "resume").click()
    server.wait_state("Printing")
    expect(part(view, "cancel")).to_be_enabled()
    part(view, "cancel").click()
    page.locator(CONFIRM).click()
    server.wait_state("Operational")
    expect(part(view, "pause")).to_be_hidden()
    expect(part(view, "last-file")).to_have_text("on_the_card.gcode")
    expect(part(view, "past-name").first).to_have_text(NAME)
    expect(part(view, "past-outcome").first).to_have_text("cancelled")
    # the card was left alone as long as the print lasted
    lines = helpers.commands(board)
    sent = lines[
        lines.index("G4 P400") : max(n for n, line in enumerate(lines) if "G4 P40" in line)
    ]
    assert not [line for line in sent if line.startswith(("M20", "M36"))]
    # the card's list may have been asked for just as the print began, which the browser notes
    errors = [error for error in own_errors(page_errors) if "/rrfmodel/files?" not in error]
    assert errors == []
