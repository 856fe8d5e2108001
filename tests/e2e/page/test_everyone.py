"""The page for everyone: assistive technology, keyboard, dark themes, narrow screens, addresses."""

import json

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import expect

from tests.support.basedir import ADMIN, READER
from tests.support.browser import open_octoprint

from .. import helpers
from . import open_view, own_errors, part

pytestmark = pytest.mark.timeout(240)

VIEWS = ("machine", "job", "chart", "model")

SERIOUS = ("serious", "critical")

OWN = ["#tab_plugin_rrfmodel", "#sidebar_plugin_rrfmodel"]

DARK = """
body, .tab-content, .accordion-group, .accordion-inner, .modal, .modal-body, .tabbable {
    background: #1e1e1e !important; color: #e4e4e4 !important; }
input, select, textarea, .add-on { background: #2b2b2b !important; color: #e4e4e4 !important; }
.btn { background: #3a3a3a !important; color: #f0f0f0 !important; text-shadow: none !important; }
.alert { background: #3a3014 !important; color: #ffe9a8 !important; text-shadow: none !important; }
.table tbody tr > td, .table tbody tr > th { background: transparent !important; }
legend { color: inherit !important; }
"""
"""What dark themes do: grounds and letters are others, for OctoPrint's own elements."""


BOARD = {"machine": "corexy"}


def serious(page):
    """Return what axe finds in the plugin's parts that shuts somebody out."""
    found = Axe().run(page, context={"include": OWN})
    return [
        (violation["id"], [node["html"][:200] for node in violation["nodes"]])
        for violation in found.response["violations"]
        if violation["impact"] in SERIOUS
    ]


def open_filled(page, server, user, view):
    """Return the sub-view once the whole model is in the page."""
    region = open_view(page, server, user, view)
    expect(part(page, "status").first).to_have_text("Idle")
    if view == "machine":
        expect(part(region, "axis-row")).not_to_have_count(0)
    return region


def open_tab(page, address):
    """Pick a tab as somebody does who clicks on it, one in the menu of those without room too."""
    page.locator(f'#tabs a[href="{address}"]').evaluate("link => link.click()")
    expect(page.locator(address.partition("/")[0])).to_be_visible()


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("user", [ADMIN, READER], ids=["admin", "reader"])
def test_axe_finds_nothing_serious(page, server, view, user, page_errors):
    open_filled(page, server, user, view)
    assert serious(page) == []
    assert own_errors(page_errors) == []


@pytest.mark.parametrize("view", VIEWS)
def test_dark_themes_keep_their_contrast(page, server, view):
    open_filled(page, server, ADMIN, view)
    page.add_style_tag(content=DARK)
    assert serious(page) == []


@pytest.mark.parametrize("view", VIEWS)
def test_480_pixels_are_enough(page, server, view):
    page.set_viewport_size({"width": 480, "height": 900})
    region = open_filled(page, server, ADMIN, view)
    # OctoPrint's own page never gets narrower than 940 pixels; its themes for telephones do
    page.add_style_tag(content="#tab_plugin_rrfmodel { width: 440px; }")
    # what has a scroll bar of its own may be wider
    too_wide = """region => {
        const right = document.querySelector("#tab_plugin_rrfmodel").getBoundingClientRect().right;
        return Array.from(region.querySelectorAll("*"))
            .filter(element => element.getBoundingClientRect().right > right + 1
                && !element.closest(".rrfmodel-scroll, .rrfmodel-hidden"))
            .map(element => element.outerHTML.slice(0, 200));
    }"""
    # charts are drawn anew a little later
    server.wait_for(lambda: not region.evaluate(too_wide), 15, "what is too wide to be narrower")
    # who touches needs room for a finger
    heights = region.locator("button:visible").evaluate_all(
        "buttons => buttons.map(button => button.getBoundingClientRect().height)"
    )
    assert min(heights, default=24) >= 24


def test_each_sub_view_has_its_address(page, server, page_errors):
    open_view(page, server, ADMIN, "job")
    for name in ("model", "chart", "machine", "job"):
        part(page, f"view-{name}").click()
        page.locator(f"#rrfmodel_{name}").locator("visible=true").first.wait_for()
        assert page.url.endswith(f"#tab_plugin_rrfmodel/{name}")
        expect(part(page, f"view-{name}")).to_have_attribute("aria-current", "page")
    page.go_back()
    page.locator("#rrfmodel_machine").locator("visible=true").first.wait_for()
    page.reload()
    page.locator("#rrfmodel_machine").locator("visible=true").first.wait_for(timeout=60_000)
    assert own_errors(page_errors) == []


def test_other_tabs_work_as_before(page, server, page_errors):
    open_view(page, server, ADMIN, "job")
    open_tab(page, "#term")
    expect(page.locator("#tab_plugin_rrfmodel")).to_be_hidden()
    open_tab(page, "#tab_plugin_rrfmodel/job")
    expect(page.locator("#term")).to_be_hidden()
    page.go_back()
    expect(page.locator("#term")).to_be_visible()
    assert own_errors(page_errors) == []


def test_everything_can_be_reached_by_keyboard(page, server):
    region = open_filled(page, server, ADMIN, "machine")
    part(region, "home-all").focus()
    seen = set()
    for _ in range(40):
        page.keyboard.press("Tab")
        seen.add(page.evaluate("document.activeElement.getAttribute('data-test')"))
    assert {"step", "home", "plus", "minus", "go"} <= seen


def test_a_hidden_tab_costs_nothing(page, server, board):
    open_filled(page, server, ADMIN, "machine")
    open_tab(page, "#term")
    page.evaluate("""() => {
        window.changes = 0;
        new MutationObserver(found => window.changes += found.length).observe(
            document.querySelector('#tab_plugin_rrfmodel'),
            {subtree: true, childList: true, attributes: true, characterData: true});
    }""")
    board.board.execute("M568 P0 S77 A2", channel="http")
    helpers.wait_value(server, "heat.heaters[1].active", 77, 15)
    helpers.wait_polls(server, 4)
    assert page.evaluate("window.changes") == 0
    # and is up to date when it is shown again
    open_tab(page, "#tab_plugin_rrfmodel/machine")
    active = part(part(page.locator("#rrfmodel_machine"), "tool").first, "active")
    expect(active).to_have_value("77")
    board.board.execute("M568 P0 S0 A0", channel="http")


def test_nothing_is_shown_without_a_machine(page, module_server_factory, page_errors):
    server = module_server_factory()
    open_octoprint(page, server, ADMIN, "/#tab_plugin_rrfmodel/machine")
    expect(part(page, "no-machine")).to_be_visible()
    assert page.locator("#tab_plugin_rrfmodel fieldset:visible").count() == 0
    assert json.dumps(page_errors) == "[]"


LANGUAGES = {
    "de": ("Maschine", "Alle referenzieren", "Ein Heizer meldet einen Fehler"),
    "fr": ("Machine", "Prise d'origine générale", "Un élément chauffant signale un défaut"),
    "es": ("Máquina", "Referenciar todo", "Un calentador avisa de un fallo"),
}
"""A word of the scripts, one of the tab's template, one of the settings' template."""


@pytest.mark.parametrize("language", LANGUAGES)
def test_the_page_speaks_the_language(page, server, language, page_errors):
    script, tab, settings = LANGUAGES[language]
    open_octoprint(page, server, ADMIN, f"/?l10n={language}#tab_plugin_rrfmodel/machine")
    expect(part(page, "view-machine")).to_have_text(script)
    expect(part(page, "home-all")).to_contain_text(tab)
    assert settings in page.content()
    assert own_errors(page_errors) == []


def test_values_are_explained_in_the_language(server):
    answer = server.get("/plugin/rrfmodel/meanings", headers={"Accept-Language": "de"})
    assert answer.json()["heat.heaters[].current"]["text"] == "Temperatur jetzt"
