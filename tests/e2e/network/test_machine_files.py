"""The dialog with the machine's own files: what a user sees and does, and what the board has."""

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import expect

from tests.support.basedir import ADMIN, OPERATOR
from tests.support.browser import SIZE, new_context, new_page

from .. import helpers
from ..page import CONFIRM, open_view, own_errors, part, unfold, wait_text
from . import bench

BOARD = {"machine": "cartesian", "speed": 10}

EVIL = "<img src=x onerror=alert(1)>\n"

ACCELEROMETER = "0:/sys/accelerometer/0_2026-11-29_09.30.00.csv"

CLOSED_LOOP = "0:/sys/closed-loop/50_2026-11-29_09.40.00.csv"


def prepare(board):
    board.card.write("0:/macros/Spare/deep.g", "; deep\r\nG28\r\n")
    board.card.write("0:/macros/evil.g", EVIL)
    board.card.write("0:/sys/other.csv", "a,b\n1,2\n3,4\n")
    samples = "".join(f"{n},{n % 7 / 10:.3f},-0.003,1.001\n" for n in range(1344))
    board.card.write(ACCELEROMETER, f"Sample,X,Y,Z\n{samples}Rate 1344, overflows 0\n")
    samples = "".join(f"{n},{n / 2:.2f},{100 + n},{n / 10:.2f},0.25\n" for n in range(400))
    head = "Sample,Timestamp,Raw Encoder Reading,Measured Motor Steps,Current Error\n"
    board.card.write(CLOSED_LOOP, head + samples)


@pytest.fixture
def errors():
    return []


@pytest.fixture
def opened(browser, server, errors):
    """Function that opens the view Machine as somebody, and the section Card in it."""
    contexts = []

    def show(user, size=SIZE):
        contexts.append(new_context(browser, size))
        page = new_page(contexts[-1], errors)
        open_view(page, server, user, "machine")
        return page, unfold(page.locator("#rrfmodel_machine_parts"), "volumes")

    yield show
    for context in contexts:
        context.close()


def dialog_of(page, card):
    part(card, "files-open").click()
    dialog = page.locator("#rrfmodel_files")
    expect(dialog).to_be_visible()
    expect(part(dialog, "files-entry").first).to_be_visible()
    return dialog


def pick(dialog, *names):
    for name in names:
        part(dialog, "files-entry").get_by_text(name, exact=True).click()


def stored(face, path):
    return face.board.card.read(path).decode()


def serious(page):
    found = Axe().run(page, context={"include": ["#rrfmodel_files"]})
    return [each["id"] for each in found.response["violations"] if each["impact"] != "minor"]


def test_listed_changed_with_a_copy_and_restarted(opened, server, face, errors):
    page, card = opened(ADMIN)
    dialog = dialog_of(page, card)
    assert {"Spare", "evil.g"} <= set(part(dialog, "files-entry").all_inner_texts())
    pick(dialog, "evil.g")
    text = part(dialog, "files-text")
    expect(text).to_have_value(EVIL)
    assert page.locator("#rrfmodel_files img").count() == 0
    assert serious(page) == []
    part(dialog, "files-back").click()
    # ends of lines stay as the file has them
    pick(dialog, "Spare", "deep.g")
    expect(text).to_have_value("; deep\nG28\n")
    text.fill("; deeper\nG28\n")
    part(dialog, "files-save").click()
    wait_text(part(dialog, "files-saved"), "0:/sys/backup/macros/Spare/deep.g")
    assert stored(face, "0:/macros/Spare/deep.g") == "; deeper\r\nG28\r\n"
    assert stored(face, "0:/sys/backup/macros/Spare/deep.g") == "; deep\r\nG28\r\n"
    expect(part(dialog, "files-restart")).to_have_count(0)

    part(dialog, "files-system").click()
    pick(dialog, "config.g")
    before = text.input_value()
    text.fill("; mine\n" + before)
    # nothing that is typed goes with a click
    for away in ("files-close", "files-back", "files-filaments"):
        part(dialog, away).click()
        question = page.locator(".modal.in", has=page.locator(".btn-danger"))
        expect(question).to_contain_text("0:/sys/config.g")
        question.locator(".modal-footer .btn").first.click()
        expect(question).to_have_count(0)
        expect(text).to_have_value("; mine\n" + before)
    part(dialog, "files-save").click()
    expect(part(dialog, "files-restart")).to_be_visible()
    part(dialog, "files-restart").click()
    assert stored(face, "0:/sys/config.g").replace("\r", "") == "; mine\n" + before
    resets = helpers.status(server)["resets"]
    page.locator(CONFIRM).click()
    server.wait_for(
        lambda: helpers.status(server)["resets"] > resets, 40, "the board to be restarted"
    )
    helpers.wait_ready(server, bench.READY_SECONDS)
    page.keyboard.press("Escape")
    expect(dialog).to_be_hidden()
    assert errors == []


def test_changed_by_somebody_else_and_nothing_is_lost(opened, face, errors):
    page, card = opened(ADMIN)
    dialog = dialog_of(page, card)
    part(dialog, "files-system").click()
    pick(dialog, "bed.g")
    text = part(dialog, "files-text")
    text.fill("; mine\n")
    face.board.card.write("0:/sys/bed.g", "; of somebody else\n")
    part(dialog, "files-save").click()
    wait_text(part(dialog, "files-error"), "changed meanwhile")
    expect(text).to_have_value("; mine\n")
    assert stored(face, "0:/sys/bed.g") == "; of somebody else\n"
    part(dialog, "files-again").click()
    expect(part(dialog, "files-theirs")).to_have_value("; of somebody else\n")
    expect(text).to_have_value("; mine\n")
    part(dialog, "files-save").click()
    wait_text(part(dialog, "files-saved"), "0:/sys/backup/sys/bed.g")
    expect(part(dialog, "files-theirs")).to_have_count(0)
    assert stored(face, "0:/sys/bed.g") == "; mine\n"
    assert stored(face, "0:/sys/backup/sys/bed.g") == "; of somebody else\n"
    assert [error for error in errors if "(CONFLICT)" not in error and "409" not in error] == []


def test_records_are_curves_by_keyboard_on_a_narrow_screen(opened, errors):
    page, card = opened(ADMIN, {"width": 480, "height": 800})
    part(card, "files-open").focus()
    page.keyboard.press("Enter")
    dialog = page.locator("#rrfmodel_files")
    expect(dialog).to_be_visible()

    def by_keys(name):
        expect(name).to_be_visible()
        name.focus()
        page.keyboard.press("Enter")

    def entry(name):
        return part(dialog, "files-entry").get_by_text(name, exact=True)

    by_keys(part(dialog, "files-system"))
    by_keys(entry("accelerometer"))
    by_keys(entry(ACCELEROMETER.rpartition("/")[2]))
    expect(part(dialog, "files-plot").locator("canvas").first).to_be_visible()
    expect(part(dialog, "files-name")).to_be_focused()
    title = part(dialog, "files-plot-title")
    wait_text(title, "1344 samples, Rate 1344, overflows 0")
    assert part(dialog, "files-column").count() == 3
    # an axis in time: 1344 samples at 1344 Hz are a second
    expect(part(dialog, "files-plot").get_by_text("800 ms")).to_be_visible()
    part(dialog, "files-column").first.uncheck()
    part(dialog, "files-as-text").click()
    expect(part(dialog, "files-text")).to_be_visible()
    assert serious(page) == []
    box = dialog.bounding_box()
    assert box["x"] >= 0 and box["x"] + box["width"] <= 480
    assert dialog.evaluate("dialog => dialog.scrollWidth <= dialog.clientWidth")

    by_keys(part(dialog, "files-up"))
    by_keys(entry("closed-loop"))
    by_keys(entry(CLOSED_LOOP.rpartition("/")[2]))
    wait_text(title, "400 samples")
    labels = dialog.locator("label:visible").all_inner_texts()
    named = ["Raw Encoder Reading", "Measured Motor Steps", "Current Error"]
    assert [label.strip() for label in labels] == named
    by_keys(part(dialog, "files-system"))
    by_keys(entry("other.csv"))
    expect(part(dialog, "files-text")).to_have_value("a,b\n1,2\n3,4\n")
    expect(part(dialog, "files-plot")).to_have_count(0)
    assert errors == []


def test_only_who_may_change_settings_over_the_network(opened, server, face, board_factory, errors):
    _, card = opened(OPERATOR)
    expect(part(card, "volume").first).to_be_visible()
    expect(part(card, "files-open")).to_have_count(0)
    page, card = opened(ADMIN)
    expect(part(card, "files-open")).to_be_visible()
    # what every page brings has nothing of it
    assert page.evaluate("RRFModel.showFiles") is None
    helpers.disconnect(server)
    helpers.connect(server, board_factory(machine="cartesian"))
    expect(part(card, "volume").first).to_be_visible()
    expect(part(card, "files-open")).to_have_count(0)
    assert own_errors(errors) == []
