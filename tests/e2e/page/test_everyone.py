"""The page for everyone: assistive technology, keyboard, dark themes, narrow screens, addresses."""

import json
import re

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import expect

from octoprint_rrfmodel.simulator.device.sample import SAMPLE_FILES, SAMPLE_FOLDERS
from tests.support.basedir import ADMIN, READER
from tests.support.browser import open_octoprint
from tests.support.places import ROOT

from .. import helpers
from . import SECONDS, both_hosts, heat_row, open_view, own_errors, part, show_view, styled

VIEWS = ("machine", "job", "chart", "console", "model")

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

TOO_WIDE = """region => {
    const right = document.querySelector("#tab_plugin_rrfmodel").getBoundingClientRect().right;
    return Array.from(region.querySelectorAll("*"))
        .filter(element => element.getBoundingClientRect().right > right + 1
            && !element.closest(".rrfmodel-scroll, .rrfmodel-hidden"))
        .map(element => element.outerHTML.slice(0, 200));
}"""
"""What sticks out of the tab; what has a scroll bar of its own may be wider."""

BOARD = {"machine": "corexy"}


OF_COLOURS = ("color-contrast", "link-in-text-block")
"""The rules that a theme can break."""


def serious(page, *rules):
    """Return what axe finds in the plugin's parts that shuts somebody out."""
    options = {"resultTypes": ["violations"], **({"runOnly": rules} if rules else {})}
    found = Axe().run(page, context={"include": OWN}, options=options)
    return [
        (violation["id"], [node["html"][:200] for node in violation["nodes"]])
        for violation in found.response["violations"]
        if violation["impact"] in SERIOUS
    ]


def show_filled(page, view):
    """Return the sub-view once the whole model is in the page."""
    region = show_view(page, view)
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
def test_axe_finds_nothing_serious(at_rest, view, user, page_errors):
    page = at_rest(user)
    show_filled(page, view)
    assert serious(page) == []
    assert own_errors(page_errors) == []


@pytest.mark.parametrize("view", VIEWS)
def test_dark_themes_keep_their_contrast(page, view):
    show_filled(page, view)
    with styled(page, DARK):
        assert serious(page, *OF_COLOURS) == []


@pytest.mark.parametrize("view", VIEWS)
def test_480_pixels_are_enough(page, server, view):
    page.set_viewport_size({"width": 480, "height": 900})
    region = show_filled(page, view)
    # OctoPrint's own page never gets narrower than 940 pixels; its themes for telephones do
    with styled(page, "#tab_plugin_rrfmodel { width: 440px; }"):
        # charts are drawn anew a little later
        server.wait_for(
            lambda: not region.evaluate(TOO_WIDE), 45, "what is too wide to be narrower"
        )
        # who touches needs room for a finger
        heights = region.locator("button:visible").evaluate_all(
            "buttons => buttons.map(button => button.getBoundingClientRect().height)"
        )
        assert min(heights, default=24) >= 24


@both_hosts
def test_each_sub_view_has_its_address(own_page, server, page_errors):
    page = own_page
    open_view(page, server, ADMIN, "job")
    for name in ("model", "chart", "machine", "job"):
        part(page, f"view-{name}").click()
        page.locator(f"#rrfmodel_{name}").locator("visible=true").first.wait_for()
        assert page.url.endswith(f"#tab_plugin_rrfmodel/{name}")
        expect(part(page, f"view-{name}")).to_have_attribute("aria-current", "page")
    page.go_back()
    page.locator("#rrfmodel_machine").locator("visible=true").first.wait_for()
    page.reload()
    page.locator("#rrfmodel_machine").locator("visible=true").first.wait_for()
    assert own_errors(page_errors) == []


@both_hosts
def test_other_tabs_work_as_before(page, page_errors):
    show_view(page, "job")
    open_tab(page, "#term")
    expect(page.locator("#tab_plugin_rrfmodel")).to_be_hidden()
    open_tab(page, "#tab_plugin_rrfmodel/job")
    expect(page.locator("#term")).to_be_hidden()
    page.go_back()
    expect(page.locator("#term")).to_be_visible()
    assert own_errors(page_errors) == []


def test_everything_can_be_reached_by_keyboard(page):
    region = show_filled(page, "machine")
    part(region, "home-all").focus()
    seen = set()
    for _ in range(60):
        page.keyboard.press("Tab")
        seen.add(page.evaluate("document.activeElement.getAttribute('data-test')"))
    assert {"home", "jog", "plus", "minus", "go", "extrude", "slider"} <= seen


def test_a_hidden_tab_costs_nothing(page, server, board):
    # what was asked for while it was seen has come
    macros = part(show_filled(page, "machine"), "macro")
    expect(macros.first).to_be_enabled()
    open_tab(page, "#term")
    page.evaluate("""() => {
        window.changes = [];
        const note = ({target}) =>
            window.changes.push((target.outerHTML || target.data).slice(0, 150));
        new MutationObserver((found) => found.forEach(note)).observe(
            document.querySelector('#tab_plugin_rrfmodel'),
            {subtree: true, childList: true, attributes: true, characterData: true});
    }""")
    board.board.execute("M568 P0 S77 A2", channel="http")
    helpers.wait_value(server, "heat.heaters[1].active", 77, 45)
    helpers.wait_polls(server, 4)
    assert page.evaluate("window.changes") == []
    # and is up to date when it is shown again
    open_tab(page, "#tab_plugin_rrfmodel/machine")
    active = part(heat_row(page.locator("#rrfmodel_machine"), 1, tool=0), "active")
    expect(active).to_have_value("77")
    board.board.execute("M568 P0 S0 A0", channel="http")


@pytest.fixture
def no_machine(server, board):
    helpers.disconnect(server)
    yield
    helpers.connect(server, board, SECONDS)


@both_hosts
def test_nothing_is_shown_without_a_machine(own_page, server, no_machine, page_errors):
    open_octoprint(own_page, server, ADMIN, "/#tab_plugin_rrfmodel/machine")
    expect(part(own_page, "no-machine")).to_be_visible()
    assert own_page.locator("#tab_plugin_rrfmodel fieldset:visible").count() == 0
    assert page_errors == []


LANGUAGES = {
    "de": ("Maschine", "Alle referenzieren", "Ein Heizer meldet einen Fehler"),
    "fr": ("Machine", "Prise d'origine générale", "Un élément chauffant signale un défaut"),
    "es": ("Máquina", "Referenciar todo", "Un calentador avisa de un fallo"),
}
"""A word of the scripts, one of the tab's template, one of the settings' template."""


@pytest.mark.parametrize("language", [pytest.param("de", marks=both_hosts), "fr", "es"])
def test_the_page_speaks_the_language(own_page, server, language, page_errors):
    page = own_page
    script, tab, settings = LANGUAGES[language]
    open_octoprint(page, server, ADMIN, f"/?l10n={language}#tab_plugin_rrfmodel/machine")
    expect(part(page, "view-machine")).to_have_text(script)
    expect(part(page, "home-all")).to_contain_text(tab)
    assert settings in page.content()
    assert own_errors(page_errors) == []


WORD = re.compile(r"[^\W\d_]{3,}")

SAID = """(regions) => regions.flatMap(function (selector) {
    const region = document.querySelector(selector);
    region.querySelectorAll("details").forEach((each) => (each.open = true));
    const said = [region.innerText];
    region.querySelectorAll("*").forEach(function (each) {
        for (const name of ["title", "aria-label", "placeholder"])
            if (each.getAttribute(name)) said.push(each.getAttribute(name));
    });
    return said;
}).join(" ")"""
"""All that somebody may read or be read to."""

OF_THE_MACHINE = ".rrfmodel-console { display: none; }"
"""What machine and people have said."""

CROSSED = """(region) => Array.from(
        region.querySelectorAll(".rrfmodel-heat, .rrfmodel-axis-row, .rrfmodel-fan")
    ).filter((each) => each.offsetHeight > 40).map((each) => each.outerHTML.slice(0, 200))"""
"""Rows of Machine that had no room for their words in a line."""


def words(text):
    return set(WORD.findall(text.lower()))


def english_alone(language):
    """Return the words of the page that its other language has not."""
    pofile = pytest.importorskip("babel.messages.pofile")
    path = ROOT / "octoprint_rrfmodel" / "translations" / language / "LC_MESSAGES" / "messages.po"
    with path.open("rb") as file:
        messages = [message for message in pofile.read_po(file) if message.id]
    known = words(" ".join(message.string for message in messages))
    return words(" ".join(message.id for message in messages)) - known


def test_no_english_word_is_among_the_german(own_page, server, board):
    page = own_page
    open_octoprint(page, server, ADMIN, "/?l10n=de#tab_plugin_rrfmodel/machine")
    # what a machine and its files are called, OctoPrint's too, and G-code, are no words of the page
    with board.board.lock:
        names = words(json.dumps(board.board.data))
    jobs = server.get("/plugin/rrfmodel/jobs").json()["jobs"]
    names |= words(" ".join([*SAMPLE_FOLDERS, *SAMPLE_FILES, *(job["name"] for job in jobs)]))
    english = english_alone("de") - names - {"octoprint", "echo"}
    assert {"home", "files"} <= english
    parts = page.locator("#rrfmodel_machine_parts")
    expect(part(parts, "fold-boards")).to_be_visible()
    for head in parts.locator("[data-test^=fold-]:visible").all():
        head.click()
    found = {}
    for view in ("machine", "job", "chart", "console"):
        region = show_view(page, view)
        if view == "machine":
            expect(part(region, "macro")).not_to_have_count(0)
            assert region.evaluate(CROSSED) == []
        with styled(page, OF_THE_MACHINE):
            found[view] = words(page.evaluate(SAID, OWN)) & english
    assert found == {view: set() for view in found}


def test_values_are_explained_in_the_language(server):
    answer = server.get("/plugin/rrfmodel/meanings", headers={"Accept-Language": "de"})
    assert answer.json()["heat.heaters[].current"]["text"] == "Temperatur jetzt"
