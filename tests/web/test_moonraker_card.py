"""The board's card as a root: what is asked of the board, and for how long."""

import asyncio
import threading
from types import SimpleNamespace

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.host.answers import RequestRefused
from octoprint_rrfmodel.rrf.card.listing import CardFile
from octoprint_rrfmodel.rrf.card.thumbnail import print_file
from octoprint_rrfmodel.web.moonraker import card_files
from octoprint_rrfmodel.web.moonraker.card_files import CardFiles
from octoprint_rrfmodel.web.moonraker.file_news import FileNews

PATH = "0:/gcodes/a.gcode"


@pytest.fixture
def loop():
    """A loop that runs on a thread of its own, as Tornado's does."""
    made = asyncio.new_event_loop()
    thread = threading.Thread(target=made.run_forever)
    thread.start()
    yield SimpleNamespace(asyncio_loop=made)
    made.call_soon_threadsafe(made.stop)
    thread.join()
    made.close()


class Board:
    """Answers about a file with what it is given, or not at all."""

    def __init__(self, answer=None, refused=None):
        self._answer, self._refused = answer, refused
        self.asked = []

    async def facts(self, path):
        self.asked.append(path)
        if self._refused:
            raise self._refused
        if self._answer is None:
            await asyncio.Event().wait()
        return print_file(self._answer)


def root(loop, board, model=None, facts=None):
    card = SimpleNamespace(
        listed=lambda: (CardFile(PATH, 10),), folders=(), facts_of=lambda path: facts
    )
    link = SimpleNamespace(kind="serial", is_operational=True, is_rrf=True, card=card)
    made = CardFiles(link, lambda: model or {}, None)
    made.attach(board, loop)
    return made


def known(made, **options):
    return made.facts(made.find("A.gcode"), **options)


TOLD = {"fileName": PATH, "height": 3.0, "err": 0}


def test_the_board_is_asked(loop):
    board = Board(TOLD)
    assert known(root(loop, board)) == {"object_height": 3.0}
    assert board.asked == [PATH]


@pytest.mark.parametrize(
    "options, given",
    [
        ({}, {"facts": TOLD}),
        ({}, {"model": {"job": {"file": TOLD}}}),
        ({"is_asked": False}, {}),
    ],
    ids=["known", "printed", "in a list"],
)
def test_it_is_not_asked_without_need(loop, options, given):
    board = Board(TOLD)
    wanted = {"object_height": 3.0} if given else {}
    assert known(root(loop, board, **given), **options) == wanted
    assert board.asked == []


def test_nobody_waits_for_ever(loop, monkeypatch):
    monkeypatch.setattr(card_files, "ANSWER_SECONDS", 0.01)
    assert known(root(loop, Board())) == {}


@pytest.mark.parametrize("status, is_told", [(409, False), (404, True), (504, False)])
def test_only_that_there_is_no_file_is_an_answer(loop, status, is_told):
    made = root(loop, Board(refused=RequestRefused(status, "Why.")))
    if is_told:
        with pytest.raises(RequestRefused):
            known(made)
    else:
        assert known(made) == {}


NEWS = [
    ("FileAdded", {"storage": "local", "path": "a.gcode"}, "create_file", "gcodes"),
    ("FileRemoved", {"storage": "local", "path": "x/a.gcode"}, "delete_file", "gcodes"),
    ("FolderAdded", {"storage": "printer", "path": "x"}, "create_dir", "printer"),
    ("FileAdded", {"storage": "local", "path": "a.gcode", "operation": "move"}, None, None),
    ("FileAdded", {"storage": "local", "path": "../a.gcode"}, None, None),
]


@pytest.mark.parametrize("event, payload, action, at", NEWS)
def test_news_of_files(event, payload, action, at):
    told = []
    news = FileNews(lambda place: place._asdict(), lambda *each: told.append(each), lambda: 1)
    news.on_event(event, payload)
    if action is None:
        assert told == []
    else:
        item = {"root": at, "path": payload["path"]}
        params = [{"action": action, "item": item}]
        assert told == [("notify_filelist_changed", params, "FILES_LIST")]


def test_news_of_a_move_have_both_names():
    told = []
    news = FileNews(lambda place: place._asdict(), lambda *each: told.append(each), lambda: 1)
    payload = {"storage": "local", "source_path": "a.gcode", "destination_path": "x/a.gcode"}
    news.on_event("FileMoved", payload)
    ((_, (params,), _),) = told
    assert params == {
        "action": "move_file",
        "item": {"root": "gcodes", "path": "x/a.gcode"},
        "source_item": {"root": "gcodes", "path": "a.gcode"},
    }


def test_nobody_is_told_where_nobody_listens():
    done = []
    news = FileNews(done.append, lambda *told: done.append(told), lambda: 0)
    news.on_event("FileAdded", {"storage": "local", "path": "a.gcode"})
    assert done == []
