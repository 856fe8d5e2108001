"""What MkDocs does for the site beyond docs/: the changelog, the pictures, links that leave docs/.

The pages are written to be read where they lie, too. There a link to a file beside docs/ is a
relative one; the site has the changelog and the pictures itself, and the repository for the rest.
"""

from __future__ import annotations

import posixpath
import re
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mkdocs.config.defaults import MkDocsConfig
    from mkdocs.structure.files import Files
    from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parents[2]

CHANGELOG = ("CHANGELOG.md", "changelog.md")
"""Where it lies, and which page it is."""

STYLE = Path(__file__).with_name("site.css")

PICTURES = ("extras/screenshots/", "pictures/")

LEAVES = re.compile(r"(?<=\]\()(?P<path>(?:\.\./)+[^)#\s]+)")
"""The address of a link that goes up, without its anchor."""


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Return the files of the site with the changelog, the pictures and the style among them."""
    from mkdocs.structure.files import File

    source, page = CHANGELOG
    files.append(File.generated(config, page, abs_src_path=str(ROOT / source)))
    files.append(File.generated(config, "site.css", abs_src_path=str(STYLE)))
    folder, place = PICTURES
    for picture in sorted((ROOT / folder).glob("*.png")):
        files.append(File.generated(config, place + picture.name, abs_src_path=str(picture)))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Return a page's text with links to what the site has, or the repository."""
    where, repository = page.file.src_uri, config.extra["repository"]
    return LEAVES.sub(lambda found: site_address(found["path"], where, repository), markdown)


def site_address(link: str, page: str, repository: str) -> str:
    """Return the address that a relative link of a page has on the site.

    ``page`` is the page's path below docs/.

    >>> site_address("../extras/screenshots/job.png", "page.md", "https://example.org/r")
    'pictures/job.png'
    >>> site_address("../../CHANGELOG.md", "guide/tab.md", "https://example.org/r")
    '../changelog.md'
    >>> site_address("../extras/fleet/README.md", "page.md", "https://example.org/r")
    'https://example.org/r/blob/main/extras/fleet/README.md'
    >>> site_address("../api.md", "guide/tab.md", "https://example.org/r")
    '../api.md'
    """
    folder = posixpath.dirname(page)
    target = posixpath.normpath(posixpath.join("docs", folder, link))
    if target.startswith("docs/"):
        return link
    if target == CHANGELOG[0]:
        return posixpath.relpath(CHANGELOG[1], folder or ".")
    if target.startswith(PICTURES[0]):
        return posixpath.relpath(target.replace(*PICTURES, 1), folder or ".")
    return f"{repository}/blob/main/{target}"
