"""A message box as the lines of a prompt, and the command that answers it.

``MODES`` is the table: which buttons a box of a mode has (3.5 GCodes2.cpp, M291). A prompt is what
Marlin hosts know as ``// action:prompt_begin``, ``prompt_choice`` for each button, ``prompt_show``
and ``prompt_end``; it has no field for a value, so that boxes which ask for one show their text.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from .machine import array
from .told_box import is_told

Box = Mapping[str, Any]
"""``state.messageBox``."""

Line = tuple[str, str]
"""Name of an action and what stands behind it."""

ANSWERS_BY_NUMBER = (3, 5)
"""From here on M292 has S, the number of the box that is meant, and R, a value."""

END: Line = ("prompt_end", "")

_TAG = re.compile(r"</?[A-Za-z][^<>]*>")
"""HTML that texts carry for Duet Web Control, such as ``<br>``."""


class Button(NamedTuple):
    """One button of a box."""

    word: str
    """``ok``, ``cancel``, ``close``: which word is on it; empty for a choice."""
    answer: str
    """What it adds to M292."""
    text: str = ""
    """What is on it, of a choice."""


OK = Button("ok", "P0")
CANCEL = Button("cancel", "P1")
CLOSE = Button("close", "P0")

CHOICES = 4

MODES: dict[int, tuple[Button, ...]] = {
    0: (),
    1: (CLOSE,),
    2: (OK,),
    3: (OK, CANCEL),
    CHOICES: (),
    5: (),
    6: (),
    7: (),
}
"""Mode → its own buttons; one for each choice and, if the box has one, Cancel come with the box."""

WORDS = {"ok": "OK", "cancel": "Cancel", "close": "Close"}


def buttons(box: Box) -> list[Button]:
    """Return the buttons that a prompt can have for the box, in order."""
    mode = box.get("mode")
    found = list(MODES.get(mode, ())) if isinstance(mode, int) else []
    if mode == CHOICES:
        found += [
            Button("", f"R{{{index}}}", str(text))
            for index, text in enumerate(array(box.get("choices")))
        ]
    if box.get("cancelButton") is True and CANCEL not in found:
        found.append(CANCEL)
    return found


def prompt(box: Box, is_answerable: bool = True, words: Mapping[str, str] = WORDS) -> list[Line]:
    """Return the lines that show the box, without buttons where it can't be answered.

    >>> prompt({"mode": 2, "title": "Tool", "message": "Change it"})
    [('prompt_begin', 'Tool: Change it'), ('prompt_choice', 'OK'), ('prompt_show', '')]
    """
    texts = [_plain(box.get(name)) for name in ("title", "message")]
    shown = buttons(box) if is_answerable else []
    return [
        ("prompt_begin", ": ".join(text for text in texts if text)),
        *(("prompt_choice", words.get(b.word) or _plain(b.text)) for b in shown),
        ("prompt_show", ""),
    ]


def answer(box: Box, index: int, version: tuple[int, ...]) -> str | None:
    """Return the command that presses a button, ``None`` where there is no such button.

    >>> answer({"mode": 4, "seq": 7, "choices": ["PLA", "ABS"]}, 1, (3, 5, 3))
    'M292 R{1} S7'
    >>> answer({"mode": 3, "seq": 7}, 1, (3, 4, 0))
    'M292 P1'
    """
    found = buttons(box)
    if not 0 <= index < len(found):
        return None
    seq = box.get("seq")
    which = (
        f" S{seq}"
        if version >= ANSWERS_BY_NUMBER and isinstance(seq, int) and not is_told(seq)
        else ""
    )
    return f"M292 {found[index].answer}{which}"


def _plain(text: Any) -> str:
    """Return a text on one line, without tags and control characters."""
    without = _TAG.sub(" ", text if isinstance(text, str) else "")
    return " ".join("".join(c if c.isprintable() else " " for c in without).split())
