"""The site of docs/: built strictly, whole, and with nothing of others in it."""

import os
import re
import subprocess
from html.parser import HTMLParser
from pathlib import PurePosixPath
from urllib.parse import unquote, urlsplit

import pytest

from tests.support.docs import DOCS
from tests.support.places import ROOT

MKDOCS = ROOT / ".venv" / "docs" / "bin" / "mkdocs"

pytestmark = [
    pytest.mark.skipif(not MKDOCS.exists(), reason="no MkDocs: make environments"),
    # it is built once
    pytest.mark.xdist_group("docs_site"),
]

LOADED = {"script": "src", "img": "src", "link": "href", "iframe": "src", "source": "src"}
"""Elements for which a browser asks by itself, and where it asks."""

RELATIONS = {"stylesheet", "icon", "preload", "preconnect", "dns-prefetch", "modulepreload"}


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The folder of the site; it is built once."""
    folder = tmp_path_factory.mktemp("site")
    done = subprocess.run(
        [MKDOCS, "build", "--strict", "--site-dir", folder],
        cwd=ROOT,
        env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "WARNING" not in done.stderr
    return folder


class Addresses(HTMLParser):
    """What a page loads and where it leads, and the anchors that it has."""

    def __init__(self):
        super().__init__()
        self.loaded, self.led_to, self.anchors = [], [], set()

    def handle_starttag(self, tag, attrs):
        has = {name: value or "" for name, value in attrs}
        self.anchors.add(has.get("id"))
        if tag == "a" and "href" in has:
            self.led_to.append(has["href"])
        elif LOADED.get(tag) in has and (tag != "link" or RELATIONS & set(has["rel"].split())):
            self.loaded.append(has[LOADED[tag]])


@pytest.fixture(scope="module")
def pages(site):
    """What stands in each page, by its path in the site."""
    found = {}
    for path in sorted(site.rglob("*.html")):
        page = Addresses()
        page.feed(path.read_text(encoding="utf-8"))
        found[path.relative_to(site).as_posix()] = page
    return found


def test_each_page_is_there_and_the_changelog(pages):
    sources = {
        path.relative_to(DOCS).with_suffix(".html").as_posix() for path in DOCS.rglob("*.md")
    }
    assert sources | {"changelog.html"} == set(pages) - {"404.html"}


def test_each_picture_is_there_and_shown(site, pages):
    names = {path.name for path in (ROOT / "extras" / "screenshots").glob("*.png")}
    assert {path.name for path in (site / "pictures").iterdir()} == names
    shown = {PurePosixPath(address).name for page in pages.values() for address in page.loaded}
    assert names <= shown


def test_nothing_is_loaded_from_elsewhere(site, pages):
    for page in pages.values():
        assert [each for each in page.loaded if "//" in each] == []
    for path in site.rglob("*.css"):
        text = path.read_text(encoding="utf-8")
        assert not re.search(r"(?:url\(|@import)\s*['\"]?(?:https?:)?//", text), path


def test_what_is_linked_and_loaded_is_there(site, pages):
    # the page for what isn't found has its addresses from the top
    for name, page in pages.items():
        for address in [*page.led_to, *page.loaded] if name != "404.html" else ():
            parts = urlsplit(address)
            if parts.scheme:
                continue
            target = (site / name).parent / unquote(parts.path) if parts.path else site / name
            assert target.exists(), (name, address)
            there = target.resolve().relative_to(site).as_posix()
            if parts.fragment and there in pages:
                assert unquote(parts.fragment) in pages[there].anchors, (name, address)


def test_what_is_beside_the_docs_is_in_the_repository(pages):
    told = [address for address in pages["recipes/fleet.html"].led_to if "/blob/main/" in address]
    assert told
    for address in told:
        assert (ROOT / address.partition("/blob/main/")[2]).exists()
