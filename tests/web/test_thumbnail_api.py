"""Pictures that come broken, where no board spoils what it sends."""

import base64

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.answers import RequestRefused
from octoprint_rrfmodel.rrf.card.thumbnail import Piece, PrintFile, Thumbnail
from octoprint_rrfmodel.rrf.wire.request import FileRequest
from octoprint_rrfmodel.web.thumbnail_api import ATTEMPTS, Thumbnails
from tests.support.coroutines import run

PATH = "0:/gcodes/a.gcode"
JPEG = b"\xff\xd8\xff\xe0 what is between \xff\xd9"
LETTERS = base64.b64encode(JPEG).decode()


class Card:
    """Answers questions about one file, each time with the next of ``texts``, in pieces of 8."""

    def __init__(self, *texts):
        self._texts = list(texts)
        self.fetched = 0

    def refusal_of_the_card(self):
        return None

    def connections(self):
        return 1

    def changes_of_the_card(self):
        return 1

    async def ask_about_the_card(self, request):
        if isinstance(request, FileRequest):
            return PrintFile(500, "", (Thumbnail("jpeg", 8, 8, 100, len(LETTERS)),))
        at = request.offset - 100
        if at == 0:
            self.fetched += 1
        text = self._texts[min(self.fetched, len(self._texts)) - 1]
        is_last = at + 8 >= len(text)
        return Piece(PATH, request.offset, text[at : at + 8], 0 if is_last else 108 + at, 0)


def fetch(*texts, times=1):
    card = Card(*texts)

    async def ask():
        thumbnails = Thumbnails(card, dict)
        for _ in range(times):
            found = await thumbnails.of(PATH)
        return found.data

    return run(ask()), card.fetched


@pytest.mark.parametrize("broken", [LETTERS[:16], "!" + LETTERS[1:], ""])
def test_a_picture_that_came_broken_is_fetched_again(broken):
    assert fetch(broken, LETTERS, times=3) == (JPEG, 2)


def test_a_whole_picture_is_fetched_once():
    assert fetch(LETTERS, times=3) == (JPEG, 1)


def test_a_picture_that_stays_broken_is_none():
    card = Card(LETTERS[:16])

    async def ask():
        thumbnails = Thumbnails(card, dict)
        for _ in range(3):
            with pytest.raises(RequestRefused):
                await thumbnails.of(PATH)

    run(ask())
    assert card.fetched == ATTEMPTS
