"""Units and meanings over HTTP: in the language of the request, and not sent twice."""

import pytest
from babel.messages.catalog import Catalog
from babel.messages.mofile import write_mo

MEANINGS = "/plugin/rrfmodel/meanings"


@pytest.fixture(scope="module")
def server(module_server_factory):
    """A server that knows one of the sentences in German."""
    made = module_server_factory()
    catalogue = Catalog(locale="de")
    catalogue.add("Temperature now", "Temperatur, gerade gemessen")
    folder = made.basedir / "translations" / "de" / "LC_MESSAGES"
    folder.mkdir(parents=True)
    with (folder / "messages.mo").open("wb") as file:
        write_mo(file, catalogue)
    made.restart()
    return made


def test_each_path_has_unit_and_text(server):
    rows = server.get(MEANINGS).json()
    assert rows["heat.heaters[].current"] == {
        "unit": "°C",
        "text": "Temperature now",
        "live": True,
    }
    assert rows["move.axes[].homed"] == {"unit": "", "text": "Whether it is homed"}
    assert len(rows) > 400


@pytest.mark.parametrize(
    "options",
    [{"headers": {"X-Locale": "de"}}, {"params": {"l10n": "de"}}],
    ids=["header", "query"],
)
def test_texts_are_in_the_language_of_the_request(server, options):
    rows = server.get(MEANINGS, **options).json()
    assert rows["heat.heaters[].current"]["text"] == "Temperatur, gerade gemessen"


def test_what_is_known_already_is_not_sent_again(server):
    first = server.get(MEANINGS)
    known = {"If-None-Match": first.headers["ETag"]}
    again = server.get(MEANINGS, headers=known)
    assert (again.status_code, again.content) == (304, b"")
    german = server.get(MEANINGS, headers={**known, "X-Locale": "de"})
    assert german.status_code == 200
    assert german.headers["ETag"] != first.headers["ETag"]
