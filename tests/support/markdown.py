"""Links and headings of a page in Markdown, as GitHub and the site read them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

_CODE = re.compile(r"^(?P<fence>`{3,})[^\n]*\n.*?^(?P=fence)$|^(?: {4}|\t)[^\n]*$", re.M | re.S)
"""A block of code, fenced or indented."""

_SPAN = re.compile(r"(?P<ticks>`+)(?!`).*?(?<!`)(?P=ticks)(?!`)")

_LINK = re.compile(r"\]\((?P<address>[^()\s]+(?:\([^()]*\))?)\)")
"""The address of a link or a picture."""

_HEADING = re.compile(r"^#{1,6} (?P<text>.+?)\s*$", re.M)

_NO_WORD = re.compile(r"[^\w\- ]")
"""What an anchor leaves out of its heading."""


class Link(NamedTuple):
    """Where a link leads: to a page, or within the same one where ``path`` is empty."""

    path: str
    anchor: str

    @property
    def is_absolute(self) -> bool:
        """Whether it is an address of the world."""
        return "://" in self.path


def links_of(page: Path) -> Iterator[Link]:
    """Yield the links and pictures of a page that stand in no code."""
    text = _CODE.sub("", page.read_text(encoding="utf-8"))
    for found in _LINK.finditer(_SPAN.sub("", text)):
        path, _, anchor = found["address"].partition("#")
        yield Link(path, anchor)


def anchors_of(page: Path) -> set[str]:
    """Return the anchors of a page's headings; of two alike only the first has one.

    The second one's is another on GitHub than on the site.
    """
    text = _CODE.sub("", page.read_text(encoding="utf-8"))
    headings = (re.sub(r"\]\([^)]*\)", "]", found["text"]) for found in _HEADING.finditer(text))
    return {_NO_WORD.sub("", heading.lower()).replace(" ", "-") for heading in headings}
