"""Links of README, docs/ and extras/ lead somewhere, and the README's from anywhere."""

import re

import pytest

from tests.support.docs import DOCS
from tests.support.markdown import anchors_of, links_of
from tests.support.places import ROOT

README = ROOT / "README.md"

PAGES = [
    README,
    ROOT / "CHANGELOG.md",
    *sorted(DOCS.rglob("*.md")),
    *sorted((ROOT / "extras").rglob("*.md")),
]

REPOSITORY = re.search(
    r"^  repository: (\S+)$", (ROOT / "mkdocs.yml").read_text(encoding="utf-8"), re.M
)[1]

FILES = (
    f"{REPOSITORY}/blob/main/",
    REPOSITORY.replace("github.com", "raw.githubusercontent.com") + "/main/",
)
"""Before the path of a file of this repository, to read and to show."""

MENTION = re.compile(r"\bdocs/(?P<path>(?:(?:guide|how|recipes|reference)/)?[\w-]+\.md)\b")
"""A page as texts name it; those of others have folders of their own."""


def name_of(page):
    return page.relative_to(ROOT).as_posix()


def target_of(link, page):
    """Return the file of this repository that a link leads to, ``None`` for others."""
    for begins in FILES:
        if link.path.startswith(begins):
            return ROOT / link.path[len(begins) :]
    if link.is_absolute:
        return None
    return (page.parent / link.path).resolve() if link.path else page


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_links_lead_somewhere(page):
    for link in links_of(page):
        target = target_of(link, page)
        if target is None:
            assert re.match(r"https?://[\w.-]+\.\w+(/|$)", link.path), link
            continue
        assert target.is_file(), link
        assert not link.anchor or link.anchor in anchors_of(target), link


def test_the_readme_reads_elsewhere():
    links = list(links_of(README))
    assert links
    # a package index shows it without its repository
    assert [link for link in links if not link.is_absolute] == []


def test_the_repository_has_one_address():
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    for text in (project, *(page.read_text(encoding="utf-8") for page in PAGES)):
        own = re.findall(r"https://github\.com/[\w-]+/OctoPrint-RRFModel\b", text)
        assert set(own) <= {REPOSITORY}
    assert f'Homepage = "{REPOSITORY}"' in project


def test_pages_that_texts_name_are_there():
    places = ["octoprint_rrfmodel", "tests", "extras"]
    texts = [*PAGES, *(path for place in places for path in sorted((ROOT / place).rglob("*.py")))]
    named = {
        found["path"]
        for path in texts
        for found in MENTION.finditer(path.read_text(encoding="utf-8"))
    }
    assert "network.md" in named
    assert [path for path in sorted(named) if not (DOCS / path).is_file()] == []
