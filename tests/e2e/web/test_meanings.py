"""Units and meanings over HTTP: in the language of the request, and not sent twice."""

import pytest

MEANINGS = "/plugin/rrfmodel/meanings"


def test_each_path_has_unit_and_text(server):
    rows = server.get(MEANINGS).json()
    assert rows["heat.heaters[].current"] == {
        "unit": "°C",
        "text": "Temperature now",
        "live": True,
    }
    assert rows["move.axes[].homed"] == {"unit": "", "text": "Whether it is homed"}
    assert len(rows) > 400


@pytest.mark.both_hosts("each finds out the language by itself")
@pytest.mark.parametrize(
    "options",
    [{"headers": {"X-Locale": "de"}}, {"params": {"l10n": "de"}}],
    ids=["header", "query"],
)
def test_texts_are_in_the_language_of_the_request(server, options):
    rows = server.get(MEANINGS, **options).json()
    assert rows["heat.heaters[].current"]["text"] == "Temperatur jetzt"


def test_what_is_known_already_is_not_sent_again(server):
    first = server.get(MEANINGS)
    known = {"If-None-Match": first.headers["ETag"]}
    again = server.get(MEANINGS, headers=known)
    assert (again.status_code, again.content) == (304, b"")
    german = server.get(MEANINGS, headers={**known, "X-Locale": "de"})
    assert german.status_code == 200
    assert german.headers["ETag"] != first.headers["ETag"]
