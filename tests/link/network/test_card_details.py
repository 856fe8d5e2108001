"""Slicers' data and pictures: fetched one after the other, kept while the file is the same."""

import base64
import json
import time
from types import SimpleNamespace
from urllib.parse import parse_qs, urlsplit

import pytest

from octoprint_rrfmodel.link.network.card_details import CardDetails
from octoprint_rrfmodel.link.network.standalone import Standalone
from octoprint_rrfmodel.link.network.transport import Unreachable
from octoprint_rrfmodel.rrf.card.listing import CardFile

JPEG = b"\xff\xd8\xff" + b"x" * 50 + b"\xff\xd9"
LETTERS = base64.b64encode(JPEG).decode()


class Board:
    def __init__(self):
        self.asked = []
        self.errands = []
        self.fails = False
        self.exchange = self

    def run(self, errand):
        self.errands.append(errand)

    def work(self):
        while self.errands:
            self.errands.pop(0)(Standalone(self, time.monotonic, None))

    def ask(self, path, **_):
        if self.fails:
            raise Unreachable("gone")
        parts = urlsplit(path)
        told = {name: value[0] for name, value in parse_qs(parts.query).items()}
        self.asked.append((parts.path, *told.values()))
        if parts.path == "/rr_fileinfo":
            answer = {"err": 0, "fileName": told["name"], "size": 5, "printTime": 60}
            if "picture" in told["name"]:
                answer["thumbnails"] = [
                    {"width": 32, "height": 24, "format": "jpeg", "offset": 100, "size": 76}
                ]
            return json.dumps(answer).encode()
        start = int(told["offset"]) - 100
        following = 140 if start == 0 else 0
        data = LETTERS[start : start + 40] if following else LETTERS[start:]
        piece = {"fileName": told["name"], "offset": start + 100, "data": data}
        return json.dumps({**piece, "next": following, "err": 0}).encode()


@pytest.fixture
def bench():
    board, news = Board(), []
    details = CardDetails(SimpleNamespace(exchange=board), lambda: news.append(1))
    return SimpleNamespace(board=board, details=details, news=news)


def file(name, date="2026-01-01T00:00:00", size=5):
    return CardFile(f"0:/gcodes/{name}", size, date)


def test_data_and_pictures_come_newest_first(bench):
    bench.details.look([file("a.g"), file("picture.g", "2026-02-01T00:00:00")])
    assert len(bench.board.errands) == 1, "one request at a time"
    bench.board.work()
    known = bench.details.known
    assert known["0:/gcodes/a.g"].members["printTime"] == 60
    assert known["0:/gcodes/a.g"].picture is None
    shown = known["0:/gcodes/picture.g"]
    assert (shown.picture.data, shown.sides) == (JPEG, "32x24")
    assert [asked[0] for asked in bench.board.asked] == [
        *("/rr_fileinfo", "/rr_thumbnail", "/rr_thumbnail", "/rr_fileinfo"),
    ]
    assert len(bench.news) == 2


def test_same_file_is_asked_for_once_and_another_one_again(bench):
    for each in (file("a.g"), file("a.g"), file("a.g", size=6)):
        bench.details.look([each])
        bench.board.work()
    assert len(bench.board.asked) == 2
    bench.details.look([])
    assert bench.details.known == {}


def test_gap_leaves_the_rest_for_the_next_list(bench):
    bench.details.look([file("a.g"), file("b.g")])
    bench.board.fails = True
    with pytest.raises(Unreachable):
        bench.board.work()
    bench.board.fails = False
    bench.details.look([file("a.g"), file("b.g")])
    bench.board.work()
    assert len(bench.details.known) == 2


def test_end_of_the_connection_leaves_the_rest_for_the_next_one():
    board = Board()
    link = SimpleNamespace(exchange=board)
    details = CardDetails(link, list)
    details.look([file("picture.g")])
    link.exchange = None
    board.work()
    assert len(board.asked) == 1, "it was under way already"
    link.exchange = board
    details.look([file("picture.g")])
    board.work()
    assert details.known["0:/gcodes/picture.g"].picture.data == JPEG


def test_nonsense_is_left_out(bench):
    bench.board.ask = lambda path, **_: b"<html>"
    bench.details.look([file("a.g"), file("b.g")])
    bench.board.work()
    assert bench.details.known == {}
