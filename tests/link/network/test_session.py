"""Sessions at a board: who logs in when, and that no slot is taken for nothing."""

import json
import threading
from urllib.parse import parse_qs, urlsplit

import pytest

from octoprint_rrfmodel.link.network.login import Busy, Greeting, Refused
from octoprint_rrfmodel.link.network.session import SESSION_SECONDS, Session, SessionLost
from octoprint_rrfmodel.link.network.transport import Answer, Unreachable


class FakeBoard:
    """A board's sessions, without its sockets (3.5 HttpResponder.cpp)."""

    def __init__(self, password="", keys=True):
        self.password = password
        self.has_keys = keys
        self.keys = set()
        self.asked = []
        self.lost_slots = 0
        self.says = None
        self._next = 100

    def get(self, path, headers, *, seconds, most):
        self.asked.append(path)
        parts = urlsplit(path)
        told = parse_qs(parts.query, keep_blank_values=True)
        if self.says is not None:
            return self.says
        key = headers.get("X-Session-Key")
        if parts.path == "/rr_connect":
            return Answer(200, json.dumps(self._connect(told)).encode())
        if self.has_keys and key not in self.keys:
            self.lost_slots += not self.password
            return Answer(401, b"")
        if parts.path == "/rr_disconnect":
            self.keys.discard(key)
        return Answer(200, b'{"err":0}')

    def _connect(self, told):
        if self.password and told["password"] != [self.password]:
            return {"err": 1}
        answer = {"err": 0, "sessionTimeout": 8000, "boardType": "duet3mini", "apiLevel": 1}
        if self.has_keys:
            self._next += 1
            self.keys.add(str(self._next))
            answer.update(apiLevel=2, sessionKey=self._next)
        return answer

    def count(self, name):
        return sum(path.startswith(f"/rr_{name}") for path in self.asked)


class Bench:
    def __init__(self, board=None, password=""):
        self.board = board or FakeBoard()
        self.now = 100.0
        self.session = Session(self.board, lambda: password, lambda: self.now)


def test_login_comes_first_and_once():
    bench = Bench()
    assert bench.session.log_in() == Greeting("duet3mini", 2)
    for _ in range(3):
        bench.session.ask("/rr_model")
    assert bench.board.count("connect") == 1
    told = parse_qs(urlsplit(bench.board.asked[0]).query, keep_blank_values=True)
    assert told["password"] == [""]
    assert told["sessionKey"] == ["yes"]
    assert len(told["time"][0]) == len("2026-11-29T12:00:00")


def test_older_boards_have_no_keys():
    bench = Bench(FakeBoard(keys=False))
    assert bench.session.log_in().api_level == 1
    bench.session.ask("/rr_model")
    assert bench.board.count("connect") == 1


def test_after_a_reset_nothing_is_asked_before_a_login():
    """Each request with a dead key takes a slot: eight of them lock everybody out."""
    bench = Bench()
    bench.session.log_in()
    bench.board.keys.clear()
    with pytest.raises(SessionLost):
        bench.session.ask("/rr_model")
    for _ in range(10):
        bench.session.ask("/rr_model")
    assert bench.board.lost_slots == 1
    assert bench.board.count("connect") == 2
    assert bench.board.count("disconnect") == 0, "the board doesn't know it any more"


def test_after_a_long_silence_a_login_comes_first():
    bench = Bench()
    bench.session.log_in()
    bench.now += SESSION_SECONDS + 1
    bench.board.keys.clear()
    bench.session.ask("/rr_model")
    assert bench.board.lost_slots == 0


def test_many_threads_log_in_once():
    bench = Bench()
    bench.session.log_in()
    bench.board.keys.clear()
    lost, barrier = [], threading.Barrier(6)

    def ask():
        barrier.wait(5)
        try:
            bench.session.ask("/rr_model")
        except SessionLost:
            lost.append(1)

    threads = [threading.Thread(target=ask) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(5)
    bench.session.ask("/rr_model")
    assert lost
    assert bench.board.count("connect") == 2


def test_slot_is_given_back_once():
    bench = Bench()
    bench.session.log_in()
    bench.session.log_out()
    bench.session.log_out()
    assert bench.board.count("disconnect") == 1
    assert not bench.board.keys


def test_no_slot_is_given_back_that_may_be_gone():
    bench = Bench()
    bench.session.log_in()
    bench.now += SESSION_SECONDS + 1
    bench.session.log_out()
    assert bench.board.count("disconnect") == 0


REFUSALS = (
    ('{"err":1}', "wrong_password"),
    ('{"err":2}', "no_slot"),
    ('{"err":0,"sessionTimeout":8000,"boardType":"duetwifi102"}', "too_old"),
    ('{"err":0,"apiLevel":0}', "too_old"),
    ('{"apiLevel":1,"err":0,"isEmulated":true,"sessionTimeout":8000}', "not_rrf"),
    ("<html>INDEX</html>", "not_rrf"),
    ("[]", "not_rrf"),
    ('{"err":"0"}', "not_rrf"),
    ("\xff", "not_rrf"),
)


@pytest.mark.parametrize(("body", "code"), REFUSALS)
def test_what_answers_is_judged_by_its_json(body, code):
    bench = Bench()
    bench.board.says = Answer(200, body.encode("latin-1"))
    with pytest.raises(Refused) as caught:
        bench.session.log_in()
    assert caught.value.code == code


def test_password_goes_along():
    bench = Bench(FakeBoard("open ü"), "open ü")
    bench.session.log_in()
    assert "password=open%20%C3%BC&" in bench.board.asked[0]


def test_no_buffers_is_told_apart():
    bench = Bench()
    bench.session.log_in()
    bench.board.says = Answer(503, b"")
    with pytest.raises(Busy):
        bench.session.ask("/rr_model")


def test_goodbye_raises_nothing():
    bench = Bench()
    bench.session.log_in()

    tried = []

    def get(path, *_, **__):
        tried.append(path)
        raise Unreachable("no answer in time")

    bench.board.get = get
    bench.session.log_out()
    assert len(tried) == 1 and "disconnect" in tried[0]
