"""The examples of the documentation, so that a test can hold them to the truth."""

from __future__ import annotations

import json
import re
from typing import Any

from tests.support.places import ROOT

DOCS = ROOT / "docs"

_BLOCK = re.compile(r"^```json\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
"""A fenced example; group ``text`` is what stands in it."""


def json_examples(page: str) -> list[Any]:
    """Return the values of all examples in JSON on a page of ``docs/``, in order."""
    text = (DOCS / page).read_text(encoding="utf-8")
    return [json.loads(block["text"]) for block in _BLOCK.finditer(text)]
