"""The talk with a board: its order, gaps and resets, and that no command goes out twice."""

import collections
import json
import queue
import time

import pytest

from octoprint_rrfmodel.link.network import exchange as module
from octoprint_rrfmodel.link.network.exchange import Exchange
from octoprint_rrfmodel.link.network.login import Busy, Greeting, Refused
from octoprint_rrfmodel.link.network.news import TOLD, News
from octoprint_rrfmodel.link.network.numbers_told import replies_in
from octoprint_rrfmodel.link.network.ration import Ration
from octoprint_rrfmodel.link.network.session import SessionLost
from octoprint_rrfmodel.link.network.transport import Unreachable
from octoprint_rrfmodel.rrf.follow.follower import LIVE_ROOT
from octoprint_rrfmodel.rrf.wire.line import NO_BUFFERS
from octoprint_rrfmodel.rrf.wire.request import ModelRequest, StatusRequest
from tests.support.waiting import wait_for

STATE = ModelRequest("state", "d99vno")


class FakeSession:
    """Answers what it is told to, in turn; what is left is answered as by a board."""

    def __init__(self):
        self.asked = []
        self.turns = collections.defaultdict(list)
        self.free = 255
        self.is_out = False

    def log_in(self):
        self.asked.append("login")
        self._fail("login")
        return Greeting("duet3mini", 2)

    def log_out(self):
        self.is_out = True

    def ask(self, path, **_):
        self.asked.append(path)
        name = path.partition("?")[0][len("/rr_") :]
        self._fail(name)
        if name == "gcode":
            return json.dumps({"buff": self.free}).encode()
        return b"said\n" if name == "reply" else b'{"key":"state"}'

    def _fail(self, name):
        turns = self.turns[name]
        turn = turns.pop(0) if turns else None
        if turn is not None:
            raise turn

    def count(self, text):
        return sum(text in each for each in self.asked)


@pytest.fixture(autouse=True)
def short_pauses(monkeypatch):
    for name in ("FIRST_PAUSE", "SLOT_SECONDS", "ERRAND_SECONDS"):
        monkeypatch.setattr(module, name, 0.02)


class Bench:
    def __init__(self, patience=60.0, at_once=1000):
        self.session = FakeSession()
        self.told = queue.Queue()
        self.now = 0.0
        news = News(
            **{name: lambda *given, name=name: self.told.put((name, *given)) for name in TOLD}
        )
        self.exchange = Exchange(
            self.session,
            news,
            time.monotonic,
            patience=lambda: patience,
            ration=Ration(time.monotonic, at_once, a_second=0.01),
        )

    def next(self):
        return self.told.get(timeout=5)


@pytest.fixture
def bench():
    made = Bench()
    yield made
    made.exchange.close()


@pytest.fixture
def greeted(bench):
    bench.exchange.start()
    assert bench.next() == ("greeted", Greeting("duet3mini", 2))
    return bench


def test_question_is_answered(greeted):
    greeted.exchange.ask(STATE)
    name, request, _, text = greeted.next()
    assert (name, request, text) == ("polled", STATE, '{"key":"state"}')


def test_what_can_not_be_asked_says_so(greeted):
    greeted.exchange.ask(StatusRequest(2))
    assert greeted.next()[3] is None
    assert greeted.session.asked == ["login"]


def test_questions_wait_where_the_board_was_asked_enough_and_commands_do_not():
    bench = Bench(at_once=1)
    try:
        bench.exchange.start()
        assert bench.next()[0] == "greeted"
        bench.exchange.ask(STATE)
        assert bench.next()[0] == "polled"
        bench.exchange.ask(STATE)
        bench.exchange.send("G28")
        bench.exchange.send("G29")
        assert [bench.next()[:2] for _ in range(2)] == [("sent", "G28"), ("sent", "G29")]
        assert bench.told.empty()
        assert bench.session.count("state") == 1
    finally:
        bench.exchange.close()


def test_commands_come_before_questions(greeted):
    exchange = greeted.exchange
    with exchange._changed:
        exchange.ask(STATE)
        exchange.send("G28")
    assert [greeted.next()[0] for _ in range(2)] == ["sent", "polled"]


LIVE = '{"key":"","flags":"d99fin","result":{"seqs":{"boards":1,"reply":COUNT}}}'


def live(count):
    return LIVE.replace("COUNT", str(count)).encode()


def test_what_the_board_has_said_comes_once_and_before_what_came_of_it(greeted):
    counts = iter((0, 0, 1, 1, 3, 3, 0, 1))
    ask = greeted.session.ask
    greeted.session.ask = lambda path, **_: live(next(counts)) if "model" in path else ask(path)
    told = []
    for _ in range(8):
        greeted.exchange.ask(LIVE_ROOT)
        while not told or told[-1] != "polled" or told.count("polled") < _ + 1:
            told.append(greeted.next()[0])
    polled, said = "polled", "said"
    assert told == [polled, polled, said, polled, polled, said, polled, polled, *[said, polled] * 2]
    assert greeted.session.count("/rr_reply") == 4


def test_other_answers_say_nothing_of_replies():
    assert replies_in(LIVE_ROOT, live(7).decode()) == 7
    assert (
        replies_in(ModelRequest("seqs", "d99vno"), '{"key":"seqs","flags":"","result":{"reply":8}}')
        == 8
    )
    text = '{"key":"global","flags":"","result":{"reply":9}}'
    assert replies_in(ModelRequest("global", "d99vno"), text) is None
    assert replies_in(LIVE_ROOT, '{"key":"","result":{"state":{}}}') is None


def test_one_command_waits_at_most(greeted):
    greeted.session.free = 250
    for line in ("G28", "M114"):
        greeted.exchange.send(line)
    assert greeted.next() == ("sent", "G28")
    wait_for(lambda: greeted.session.count("/rr_gcode") > 2, 5, "looks whether it was taken")
    assert greeted.session.count("M114") == 0
    assert greeted.exchange.waiting() == ["M114"]
    greeted.session.free = 255
    assert greeted.next() == ("sent", "M114")


def test_refused_command_is_tried_again(greeted):
    answers = [b'{"err":1}', b'{"buff":255}', b'{"buff":250}']
    greeted.session.ask = lambda path, **_: answers.pop(0)
    greeted.exchange.send("G28")
    assert greeted.next() == ("sent", "G28")
    assert answers == []


def test_command_without_an_answer_is_not_repeated(greeted):
    greeted.session.turns["gcode"] = [Unreachable("no answer in time")]
    greeted.exchange.send("G1 X5")
    assert greeted.next() == ("unsent", "G1 X5", "doubtful")
    assert greeted.next() == ("away", "no answer in time")
    assert greeted.next()[0] == "back"
    greeted.exchange.ask(STATE)
    assert greeted.next()[0] == "polled"
    assert greeted.session.count("G1") == 1


def test_question_is_asked_again_when_the_board_is_back(greeted):
    greeted.session.turns["model"] = [Unreachable("no answer in time")] * 2
    greeted.exchange.ask(STATE)
    assert [greeted.next()[0] for _ in range(3)] == ["away", "back", "polled"]
    # the second try came behind a login, and failed as well
    assert greeted.session.count("login") == 3


def test_nothing_is_sent_that_would_come_late(greeted):
    greeted.session.turns["model"] = [Unreachable("gone")]
    greeted.session.turns["login"] = [Unreachable("gone")] * 50
    greeted.exchange.ask(STATE)
    assert greeted.next() == ("away", "gone")
    greeted.exchange.send("G1 X5")
    assert greeted.next() == ("unsent", "G1 X5", "away")


def test_reset_drops_commands_and_logs_in_by_the_next_question(greeted):
    greeted.session.free = 250
    for line in ("G28", "M114"):
        greeted.exchange.send(line)
    assert greeted.next() == ("sent", "G28")
    greeted.session.turns["gcode"] = [SessionLost()]
    assert greeted.next() == ("unsent", "M114", "reset")
    assert greeted.next() == ("lost",)
    assert not greeted.exchange.is_away


def test_no_buffers_is_what_the_poller_knows_and_fetches_a_reply_once(greeted):
    greeted.session.turns["model"] = [Busy(), Busy()]
    texts = []
    while len(texts) < 3:
        greeted.exchange.ask(STATE)
        name = ""
        while name != "polled":
            name, *told = greeted.next()
        texts.append(told[2])
    assert texts[:2] == [NO_BUFFERS] * 2
    assert greeted.session.count("/rr_reply") == 1


@pytest.mark.parametrize("code", ["wrong_password", "too_old", "sbc_down", "not_rrf"])
def test_refusal_at_first_is_the_end(bench, code):
    bench.session.turns["login"] = [Refused(code)]
    bench.exchange.start()
    assert bench.next() == ("ended", code, "")


def test_board_that_is_not_there_at_first_is_the_end(bench):
    bench.session.turns["login"] = [Unreachable("it refuses connections")]
    bench.exchange.start()
    assert bench.next() == ("ended", "unreachable", "it refuses connections")


def test_taken_slots_are_waited_for(bench):
    bench.session.turns["login"] = [Refused("no_slot")] * 3
    bench.exchange.start()
    assert bench.next()[0] == "greeted"


def test_foreign_answers_are_a_gap_to_who_was_greeted(greeted):
    """A router's page, for example, while the board is away."""
    greeted.session.turns["model"] = [Unreachable("gone")]
    greeted.session.turns["login"] = [Refused("not_rrf")] * 2
    greeted.exchange.ask(STATE)
    assert greeted.next() == ("away", "gone")
    assert greeted.next()[0] == "back"


def test_board_that_stays_away_is_the_end():
    bench = Bench(patience=0.1)
    bench.exchange.start()
    bench.next()
    bench.session.turns["model"] = [Unreachable("gone")]
    bench.session.turns["login"] = [Unreachable("gone")] * 1000
    bench.exchange.ask(STATE)
    assert bench.next() == ("away", "gone")
    assert bench.next() == ("ended", "gone", "gone")


def test_closed_exchange_tells_nothing_and_gives_its_slot_back(greeted):
    greeted.exchange.close()
    greeted.exchange.ask(STATE)
    wait_for(lambda: greeted.session.is_out, 5, "the goodbye")
    assert greeted.told.empty()


def test_errands_wait_for_everything_else(greeted):
    done = []
    exchange = greeted.exchange
    with exchange._changed:
        exchange.run(lambda session: done.append(greeted.session.count("/rr_model")))
        exchange.ask(STATE)
    assert greeted.next()[0] == "polled"
    wait_for(lambda: done, 5, "the errand")
    assert done == [1]
