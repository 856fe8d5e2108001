"""Each warning that the model can show has its sentence, and the page has the same."""

import re

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host import warning_texts
from octoprint_rrfmodel.host.octoprint_settings import NEEDS
from octoprint_rrfmodel.host.warnings import ALL_LEVELS, FIXES, PRINT_PAUSED, warning
from octoprint_rrfmodel.rrf.views.warnings import CONDITIONS
from tests.support.places import ROOT

WORDS = ROOT / "octoprint_rrfmodel" / "static" / "js" / "words.js"

NAMES = ("number", "line", "file", "message", "version", "main", "place", "text", "lines")

VALUES = dict.fromkeys(NAMES, "7")

OF_THE_PROFILE = ("profile_tools", "profile_reconnect", "settings_reconnect")

CODES = sorted(
    {
        *OF_THE_PROFILE,
        *(row.code for row in CONDITIONS),
        *(need.code for need in NEEDS),
        *ALL_LEVELS,
    }
)


@pytest.mark.parametrize("code", [code for code in CODES if code != PRINT_PAUSED])
def test_every_warning_has_a_sentence(code):
    told = warning(code, VALUES)
    # one of them ends with the words of the firmware
    assert told["text"].endswith((".", VALUES["message"]))
    assert "%(" not in told["text"]
    assert told["level"] in ("fault", "warning", "advice")


def test_what_mends_a_warning_is_about_one_that_there_is():
    assert FIXES.keys() <= set(CODES)


BESIDE_A_BUTTON = {"halted", "heater_fault"}
"""Where the page has a button that mends it, and a heater its name, its sentence names no code."""


def test_the_page_says_the_same():
    """The page has those sentences too that it says before the server has told it anything."""
    block = re.search(r"(?ms)^(\t+)warning: \{$(.*?)^\1\}", WORDS.read_text("utf-8")).group(2)
    found = dict(re.findall(r'(\w+): gettext\(\s*"((?:[^"\\]|\\.)*)"\s*\)', block))
    assert found.keys() > BESIDE_A_BUTTON
    own = {code: found.pop(code) for code in BESIDE_A_BUTTON}
    assert found == {code: warning_texts.TEXTS[code] for code in found}
    assert len(found) > 5
    for code, text in own.items():
        theirs = warning_texts.TEXTS[code].replace("%(number)s", "%(heater)s")
        assert text.split(".")[0] == theirs.split(".")[0]
        assert not re.search(r"\b[GM]\d", text)
