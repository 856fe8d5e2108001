"""The sub-view Model in a real browser: the tree, what is found in it, and what it says."""

import pytest
from playwright.sync_api import expect

from . import both_hosts, own_errors, part, show_view, wait_text

MARKUP = "<img src=x onerror=alert(1)>"


BOARD = {"machine": "toolchanger", "speed": 10}


@pytest.fixture
def view(page):
    return shown(page)


def shown(page):
    found = show_view(page, "model")
    row(found, "volumes").wait_for()
    return found


def tree(view):
    return view.get_by_role("tree")


def names(view):
    """Return the names of the rows, as far as they are in sight."""
    return part(view, "name").locator("visible=true").all_inner_texts()


def row(view, name, level=1):
    return view.locator(f"[role=treeitem][aria-level='{level}']").filter(
        has=view.page.locator("[data-test=name]").and_(view.page.get_by_text(name, exact=True))
    )


def find(view, text):
    part(view, "find").fill(text)


def path(view):
    return part(view, "path")


def press(view, *keys):
    for key in keys:
        tree(view).press(key)


def test_top_level_keys_are_there_and_closed(view, page_errors):
    assert names(view)[:4] == ["boards", "directories", "fans", "global"]
    expect(row(view, "heat")).to_have_attribute("aria-expanded", "false")
    expect(row(view, "boards")).to_have_attribute("aria-posinset", "1")
    assert own_errors(page_errors) == []


@both_hosts
def test_keyboard(view):
    tree(view).focus()
    press(view, "Home")
    expect(path(view)).to_have_text("boards")
    press(view, "ArrowRight")
    expect(row(view, "boards")).to_have_attribute("aria-expanded", "true")
    press(view, "ArrowRight")
    expect(path(view)).to_have_text("boards[0]")
    selected = tree(view).get_attribute("aria-activedescendant")
    expect(view.locator(f"#{selected}")).to_have_attribute("aria-selected", "true")
    press(view, "Enter", "ArrowDown")
    wait_text(path(view), "boards[0].")
    press(view, "ArrowUp", "ArrowLeft")
    expect(row(view, "[0]", 2)).to_have_attribute("aria-expanded", "false")
    press(view, "ArrowLeft")
    expect(path(view)).to_have_text("boards")
    press(view, "End")
    expect(path(view)).to_have_text("volumes")
    press(view, "PageUp", "Home", "ArrowUp")
    expect(path(view)).to_have_text("boards")


def test_value_with_unit_and_meaning(view, board):
    find(view, "heaters[1].current")
    found = row(view, "current", 4)
    wait_text(part(found, "value"), "°C")
    wait_text(found, "Temperature now")
    found.click()
    wait_text(part(view, "meaning"), "Temperature now")
    expect(part(view, "detail-value")).to_contain_text("°C")


def test_follows_by_push_and_lights_up(page, view, board):
    find(view, "heaters[1].active")
    found = row(view, "active", 4)
    found.wait_for()
    found.evaluate(
        """row => {
            window.lit = [];
            new MutationObserver(() => row.classList.contains("rrfmodel-lit")
                && window.lit.push(row.textContent)).observe(row, {attributes: true});
        }"""
    )
    board.board.execute("M568 P1 S57 A2", channel="http")
    wait_text(part(found, "value"), "57 °C")
    expect(found).to_have_class("rrfmodel-node")
    # the light is short
    assert any("57 °C" in text for text in page.evaluate("window.lit"))
    board.board.execute("M568 P1 S0 A0", channel="http")


def test_find_by_name_and_by_value(view):
    find(view, "kinematics")
    expect(row(view, "kinematics", 2)).to_have_attribute("aria-expanded", "false")
    assert names(view) == ["move", "kinematics"]
    wait_text(part(view, "count"), "2")
    find(view, '"corexy"')
    expect(row(view, "name", 3)).to_be_visible()
    assert names(view) == ["move", "kinematics", "name"]
    find(view, "there is no such thing")
    wait_text(part(view, "count"), "Nothing found")
    assert names(view) == []
    find(view, "")
    expect(row(view, "volumes")).to_be_visible()


def test_only_changed(view, board):
    part(view, "only-changed").click()
    expect(part(view, "only-changed")).to_have_attribute("aria-pressed", "true")
    board.board.execute('M117 "changed"', channel="http")
    find(view, "displayMessage")
    wait_text(part(row(view, "displayMessage", 2), "value"), '"changed"')
    part(view, "forget").click()
    expect(row(view, "displayMessage", 2)).to_have_count(0)
    find(view, "")
    # the clock goes on
    expect(row(view, "upTime", 2)).to_be_visible()


def test_only_live(view):
    part(view, "only-live").click()
    find(view, "heat.heaters[0]")
    # there are others until it has been searched
    expect(row(view, "current", 4)).to_have_count(1)
    expect(row(view, "current", 4)).to_be_visible()
    assert "max" not in names(view)
    assert "avgPwm" in names(view)


def test_open_and_close_all(view):
    part(view, "open-all").click()
    expect(row(view, "boards")).to_have_attribute("aria-expanded", "true")
    tree(view).focus()
    press(view, "End")
    wait_text(path(view), "volumes[")
    assert view.locator("[role=treeitem]").count() < 60
    part(view, "close-all").click()
    press(view, "End")
    expect(path(view)).to_have_text("volumes")


def test_copies_path_and_command(page, view):
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    find(view, "heaters[0].current")
    row(view, "current", 4).click()
    part(view, "copy-path").click()
    wait_text(part(view, "copied"), "heat.heaters[0].current")
    clipboard = "() => navigator.clipboard.readText()"
    assert page.evaluate(clipboard) == "heat.heaters[0].current"
    part(view, "copy-command").press("Enter")
    wait_text(part(view, "copied"), "M409")
    assert page.evaluate(clipboard) == 'M409 K"heat.heaters[0].current"'
    expect(part(view, "copy-command")).to_be_focused()


def test_text_of_the_printer_is_text(view, board, page_errors):
    board.board.execute(f'M563 P1 S"{MARKUP}"', channel="http")
    find(view, "onerror")
    found = row(view, "name", 3)
    wait_text(part(found, "value"), MARKUP)
    found.click()
    wait_text(part(view, "detail-value"), MARKUP)
    assert view.locator("img").count() == 0
    assert own_errors(page_errors) == []
    board.board.execute('M563 P1 S"E0"', channel="http")


def test_a_selected_value_that_goes_away_is_no_longer_told_of(view, board):
    board.board.execute("global soon = 1", channel="http")
    find(view, "global.soon")
    row(view, "soon", 2).click()
    wait_text(part(view, "detail-value"), "1")
    wait_text(part(view, "meaning"), "macros")
    with board.board.lock:
        del board.board.data["global"]["soon"]
        board.board.bump("global")
    expect(path(view)).to_have_count(0)


def test_hidden_it_does_nothing(page, view, board):
    part(view, "open-all").click()
    page.locator("[data-test=view-machine]").click()
    part(view, "model").wait_for(state="hidden")
    page.evaluate(
        """() => {
            window.changes = 0;
            const observer = new MutationObserver((found) => (window.changes += found.length));
            const all = {attributes: true, childList: true, characterData: true, subtree: true};
            observer.observe(document.querySelector("#rrfmodel_model"), all);
        }"""
    )
    # the page hears of it all the same
    for text in ("once", "again"):
        board.board.execute(f'M117 "{text}"', channel="http")
        wait_text(part(page, "rrfmodel-sidebar"), text)
    assert page.evaluate("window.changes") == 0
    page.locator("[data-test=view-model]").click()
    part(view, "model").wait_for(state="visible")


def test_sub_views_open_where_the_tab_is_in_the_menu_of_those_without_room(page, view):
    page.set_viewport_size({"width": 480, "height": 800})
    for name in ("machine", "model", "machine", "model"):
        page.locator(f"[data-test=view-{name}]").click()
        expect(part(view, "model")).to_be_visible(visible=name == "model")
    page.evaluate("window.location.hash = '#control'")
    part(view, "model").wait_for(state="hidden")
    page.evaluate("window.location.hash = '#tab_plugin_rrfmodel/model'")
    expect(part(view, "model")).to_be_visible()


def test_a_reader_sees_all_of_it(reader_page, page_errors):
    view = shown(reader_page)
    find(view, "heaters[0].current")
    wait_text(part(row(view, "current", 4), "value"), "°C")
    assert own_errors(page_errors) == []
