"""What a page loads of the plugin: all of it is there, and it isn't much."""

import re

import pytest

from octoprint_rrfmodel.web.assets import ASSETS, ON_DEMAND
from tests.support.places import ROOT

STATIC = ROOT / "octoprint_rrfmodel" / "static"

TEMPLATES = STATIC.parent / "templates"

MOST_BYTES = 260_000

MOST_ON_DEMAND = {".js": 12_000, ".css": 1_000}
"""Of what comes when somebody first wants it."""

SAID = re.compile(r"""(?:\b_|gettext)\((["'])(?P<text>.+?)\1\)""")
"""What a script or a template says to people."""

STILTED = {
    "Put the tool down": "Deselect",
    "Leave out": "Cancel object",
    "Feed": "Extrude",
    "Do": "Set",
    "Place in mm": "Move to a position in mm",
    "Speed asked for": "Requested speed",
    "Put aside": "Later",
    "Level or calibrate": "Bed levelling (G32)",
    "Load the mesh": "Load height map",
}
"""Words that nobody knew, and what Duet Web Control and OctoPrint call it."""


def sizes_of(names):
    return {name: (STATIC / name).stat().st_size for name in names}


def loaded():
    return {name for names in ASSETS.values() for name in names}


def test_every_file_is_loaded_and_none_is_missing():
    there = {path.relative_to(STATIC).as_posix() for path in STATIC.rglob("*") if path.is_file()}
    assert loaded() | set(ON_DEMAND) == there
    assert not loaded() & set(ON_DEMAND)


def test_the_page_stays_small():
    sizes = sizes_of(loaded())
    assert sum(sizes.values()) < MOST_BYTES, sizes


@pytest.mark.parametrize("ending", MOST_ON_DEMAND)
def test_what_comes_on_demand_stays_small_and_somebody_asks_for_it(ending):
    names = [name for name in ON_DEMAND if name.endswith(ending)]
    sizes = sizes_of(names)
    assert sum(sizes.values()) < MOST_ON_DEMAND[ending], sizes
    scripts = [path.read_text(encoding="utf-8") for path in STATIC.rglob("*.js")]
    for name in names:
        assert any(f"plugin/rrfmodel/static/{name}" in script for script in scripts), name


@pytest.fixture(scope="module")
def said():
    files = [*TEMPLATES.rglob("*.jinja2"), *STATIC.rglob("*.js")]
    found = {
        found["text"] for path in files for found in SAID.finditer(path.read_text(encoding="utf-8"))
    }
    assert {"Deselect", "Requested speed", "Bed levelling (G32)"} <= found
    return found


@pytest.mark.parametrize("words", STILTED)
def test_stilted_words_are_gone(words, said):
    assert words not in said
