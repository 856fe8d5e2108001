"""The pages of docs/reference are what the code's tables make."""

import pytest

from tests.support.docs import DOCS

# the plugin's sentences are its own
pytest.importorskip("flask_babel")

from extras.site import reference  # noqa: E402
from octoprint_rrfmodel.host.plugin_settings import DEFAULTS  # noqa: E402

PAGES = reference.pages()


@pytest.mark.parametrize("name", PAGES)
def test_page_is_what_the_tables_make(name):
    text = (DOCS / "reference" / name).read_text(encoding="utf-8")
    assert text == PAGES[name], "run: make reference"


def test_no_page_is_left_over():
    assert {path.name for path in (DOCS / "reference").glob("*.md")} == {"index.md", *PAGES}


def test_each_setting_has_words_and_no_other():
    paths = {path for path, _ in reference.paths_of(DEFAULTS)}
    assert set(reference.words_of_settings()) == paths


def test_each_setting_is_on_the_page_with_its_default():
    page = PAGES["settings.md"]
    assert '| `mqtt.topic` | `"octoPrint/plugin/rrfmodel"` |' in page
    assert "| `prompts` | off |" in page
    assert "| `network.hosts` | none |" in page
    for path, _ in reference.paths_of(DEFAULTS):
        assert f"| `{path}` |" in page


def test_sentences_have_no_placeholders():
    for name in ("guard.md", "warnings.md"):
        assert "%(" not in PAGES[name]


def test_cells_are_as_many_in_each_row():
    for name, text in PAGES.items():
        for table in text.split("\n\n"):
            rows = [line for line in table.splitlines() if line.startswith("|")]
            counts = {line.replace("\\|", "").count("|") for line in rows}
            assert len(counts) <= 1, name
