"""The catalogues are complete, belong to the sources, and are compiled as they stand."""

import re
import subprocess
import sys

import pytest

from tests.support.places import ROOT

pofile = pytest.importorskip("babel.messages.pofile")
mofile = pytest.importorskip("babel.messages.mofile")
# the templates have a tag of OctoPrint's own
pytest.importorskip("octoprint")

SOURCES = ROOT / "translations"
COMPILED = ROOT / "octoprint_rrfmodel" / "translations"
LANGUAGES = ("de", "es", "fr")

PLACEHOLDER = re.compile(r"%(?:\([a-z_]+\))?[sd%]")


def catalogue(path):
    with path.open("rb") as file:
        return pofile.read_po(file)


def texts(catalogue):
    return {message.id: message for message in catalogue if message.id}


@pytest.fixture(scope="module")
def extracted(tmp_path_factory):
    """The words that the sources have now."""
    made = tmp_path_factory.mktemp("words") / "messages.pot"
    extract = ["--quiet", "extract", "--mapping-file=babel.cfg", "--keyword=N_"]
    command = [sys.executable, "-m", "babel.messages.frontend", *extract, f"--output-file={made}"]
    done = subprocess.run([*command, "."], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return set(texts(catalogue(made)))


def test_the_template_has_the_words_of_the_sources(extracted):
    assert set(texts(catalogue(SOURCES / "messages.pot"))) == extracted


@pytest.mark.parametrize("language", LANGUAGES)
def test_everything_is_translated(language, extracted):
    messages = texts(catalogue(SOURCES / language / "LC_MESSAGES" / "messages.po"))
    assert set(messages) == extracted
    assert [text for text, message in messages.items() if not message.string] == []
    assert [text for text, message in messages.items() if message.fuzzy] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_placeholders_are_kept(language):
    messages = texts(catalogue(SOURCES / language / "LC_MESSAGES" / "messages.po"))
    for text, message in messages.items():
        found = sorted(PLACEHOLDER.findall(message.string))
        assert found == sorted(PLACEHOLDER.findall(text)), text


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_octoprint_reads_is_compiled_from_it(language):
    source = SOURCES / language / "LC_MESSAGES" / "messages.po"
    folder = COMPILED / language / "LC_MESSAGES"
    assert (folder / "messages.po").read_bytes() == source.read_bytes()
    with (folder / "messages.mo").open("rb") as file:
        compiled = texts(mofile.read_mo(file))
    words = texts(catalogue(source))
    assert {text: message.string for text, message in compiled.items()} == {
        text: message.string for text, message in words.items()
    }
