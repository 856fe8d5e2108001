"""The poller on a board that answers at once, with a clock that only a test turns."""

import pytest

pytest.importorskip("octoprint")

from octoprint_rrfmodel.link.known import Known
from octoprint_rrfmodel.link.poller import ANSWER_SECONDS, Poller
from octoprint_rrfmodel.rrf.follow.follower import LIVE_ROOT, Follower
from octoprint_rrfmodel.rrf.follow.live import LIVE_KEYS
from octoprint_rrfmodel.rrf.follow.rows import Rows
from octoprint_rrfmodel.rrf.wire.line import find_reply
from octoprint_rrfmodel.simulator.board import Board as SimulatedBoard

from ..rrf.board import Board

MOST_POLLS = 120


class Line:
    """A link that is free, and notes what it is asked."""

    given_up = 0

    expects_refusal = False
    settled_at = target_command_at = 0.0

    def __init__(self):
        self.asked = []
        self.streams = False

    def give_up(self):
        self.given_up += 1

    def ask(self, request):
        self.asked.append(request)

    def blocked(self):
        return None

    def rate(self):
        return 0

    def is_streaming_a_print(self):
        return self.streams


class NoCard:
    """A card that there is nothing to ask about."""

    behind = False

    def next_request(self):
        return None


class Rig:
    """The poller with all that it asks, and the board at the other end of the line."""

    def __init__(self, board=None):
        self.now = 100.0
        self.number = 0
        self.taken = []
        self.board = board or Board()
        self.line, self.follower = Line(), Follower(Rows(lambda: self.now))
        self.known = Known(self.follower, self.line, lambda: self.now)
        self.poller = Poller(
            self.follower,
            NoCard(),
            self.line,
            known=self.known,
            replied=lambda taken, asked_at: self.taken.append(taken),
            clock=lambda: self.now,
        )
        self.poller.identified()

    def send(self):
        """Let time pass until the next poll goes out; return its request."""
        count = len(self.line.asked)
        while len(self.line.asked) == count:
            wait = self.poller.tick()
            if len(self.line.asked) == count:
                self.now += max(wait, 0.01)
        self.number += 1
        self.poller.poll_sent(self.now, self.number)
        return self.line.asked[-1]

    def hear(self, text):
        """Take a line of the board's, as the hook does."""
        found = find_reply(text)
        self.poller.reply(found.reply, found.number)

    def ok(self):
        self.poller.poll_acknowledged()

    def serve(self, polls=1):
        for _ in range(polls):
            request = self.send()
            self.hear(self.board.reply(request))
            self.ok()

    def ready(self):
        for _ in range(MOST_POLLS):
            self.serve()
            if self.follower.ready and not self.follower.behind:
                return self
        raise AssertionError("not ready")


@pytest.fixture
def rig():
    return Rig().ready()


def numbered(text, number):
    return f'{{"line":{number},{text[1:]}'


def test_number_tells_an_answer_to_another_command_from_the_polls(rig):
    request = rig.send()
    assert request == LIVE_ROOT
    revision = rig.follower.store.revision
    rig.board.set("state.status", "busy")
    text = rig.board.reply(request)
    # as of a poll that was given up, or of what somebody typed
    rig.hear(numbered(text, rig.number - 1))
    assert rig.follower.store.revision == revision
    rig.hear(numbered(text, rig.number))
    assert rig.follower.store.model["state"]["status"] == "busy"


def test_answer_without_a_number_is_taken_as_ever(rig):
    rig.board.set("state.status", "busy")
    rig.serve()
    assert rig.follower.store.model["state"]["status"] == "busy"


def test_answer_to_the_poll_is_the_same_wherever_the_number_stands(rig):
    for step, put in enumerate((numbered, lambda text, number: f'{text[:-1]},"line":{number}}}')):
        rig.board.set("state.displayMessage", str(step))
        request = rig.send()
        rig.hear(put(rig.board.reply(request), rig.number))
        rig.ok()
        rig.serve(3)
        assert rig.follower.store.model == rig.board.model


def test_numbers_that_are_not_the_hosts_blind_nobody(rig):
    request = rig.send()
    rig.hear(numbered(rig.board.reply(request), 7777))
    rig.now += ANSWER_SECONDS + 1
    rig.board.set("state.status", "busy")
    for _ in range(4):
        request = rig.send()
        rig.hear(numbered(rig.board.reply(request), 7777))
        rig.ok()
    assert rig.follower.store.model["state"]["status"] == "busy"


def alarm(rig, path, value):
    """Let something be wrong from now on; return the seconds until the model says so."""
    rig.line.streams = True
    rig.serve(2)
    rig.board.set(path, value)
    before = rig.follower.store.model
    request = rig.send()
    since = rig.now
    rig.hear(rig.board.reply(request))
    rig.ok()
    if rig.follower.store.model is before:
        rig.serve()
    return rig.now - since


def test_fault_is_asked_for_again_at_once_also_beside_a_print(rig):
    rig.board.model["heat"]["heaters"][1]["state"] = "active"
    rig.board.bump("heat")
    rig.serve(8)
    count = len(rig.taken)
    assert alarm(rig, "heat.heaters[1].state", "fault") < 0.5
    assert rig.follower.store.model["heat"]["heaters"][1]["state"] == "fault"
    # nobody was told of the first answer: two before it and the one that is believed
    assert len(rig.taken) == count + 3


def test_fault_that_the_firmware_says_itself_needs_no_second_answer(rig):
    rig.board.model["heat"]["heaters"][1]["state"] = "active"
    rig.board.bump("heat")
    rig.serve(8)
    rig.poller.heard("fault")
    assert alarm(rig, "heat.heaters[1].state", "fault") == 0


def short_of_room(rig, streams=False):
    """Let there be no room for the live root from now on."""
    rig.board.rooms = {"": len(rig.board.reply(LIVE_ROOT)) - 20}
    rig.line.streams = streams
    rig.serve(3 + len(LIVE_KEYS))
    return rig


@pytest.mark.parametrize("streams", [False, True])
def test_parts_are_asked_one_behind_the_other(rig, streams):
    short_of_room(rig, streams)
    asked = len(rig.line.asked)
    since = rig.now
    rig.serve(40)
    rounds = sum(request.key == "state" for request in rig.line.asked[asked:])
    assert rounds >= 3
    # as often as whole answers would come
    assert (rig.now - since) / rounds < (2.5 if streams else 1.5)


@pytest.mark.parametrize("streams", [False, True])
def test_fault_among_parts_is_known_as_soon_as_among_whole_answers(rig, streams):
    rig.board.model["heat"]["heaters"][1]["state"] = "active"
    rig.board.bump("heat")
    rig.serve(8)
    short_of_room(rig, streams)
    rig.board.set("heat.heaters[1].state", "fault")
    since = rig.now
    while rig.follower.store.model["heat"]["heaters"][1]["state"] != "fault":
        rig.serve()
    assert rig.now - since < 3


def test_age_is_that_of_the_oldest_part(rig):
    short_of_room(rig)
    assert rig.known.age() < 2
    # one of them is answered no more
    rig.board.rooms["heat"] = 0
    since = rig.now
    while rig.now < since + 30:
        rig.serve()
    assert rig.known.age() > 25
    assert rig.known.asked_at < since + 2
    assert rig.poller.is_stale()
    rig.board.rooms = {}
    rig.serve(30)
    assert rig.known.age() < 2
    assert not rig.poller.is_stale()
    assert rig.line.asked[-1] == LIVE_ROOT


def test_row_28_each_poll_is_counted_once_by_what_became_of_it(rig):
    """However it ends, and whoever asked: the model, the card or a question."""
    for ending in ("reply", "no room", "spoilt", "silence", "gone"):
        for is_question in (False, True):
            if is_question:
                rig.poller.query("heat", "d99vn")
            request = rig.send()
            if ending == "reply":
                rig.hear(rig.board.reply(request))
            elif ending == "no room":
                rig.hear('{"err":-1}')
            elif ending == "spoilt":
                rig.hear(rig.board.reply(request)[:40])
            elif ending == "silence":
                rig.now += ANSWER_SECONDS + 1
                rig.poller.tick()
            if ending == "gone":
                rig.poller.forgotten()
                rig.poller.identified()
            else:
                rig.ok()
    assert sum(rig.follower.counters.values()) == rig.poller.polls


BAUD = 115200


class SlowRig(Rig):
    """The same on a line of 115200 baud; ``factor`` is by how much it is faster than it says."""

    def __init__(self, factor=1.0):
        # its live root is longer than a part may be
        super().__init__(Board(SimulatedBoard("idex").data))
        self.factor = factor
        self.line.rate = lambda: BAUD
        self.poller.identified()

    def serve(self, polls=1):
        for _ in range(polls):
            text = self.board.reply(self.send())
            self.now += len(text) * 10 / BAUD / self.factor
            self.hear(text)
            self.ok()


def test_on_a_slow_line_parts_are_asked_for_alone():
    rig = SlowRig().ready()
    rig.line.streams = True
    rig.serve(1)
    asked = len(rig.line.asked)
    rig.serve(40)
    assert LIVE_ROOT not in rig.line.asked[asked:]
    assert {"state", "heat.heaters[].state"} <= {each.key for each in rig.line.asked[asked:]}
    assert rig.line.polls_alone
    assert not rig.poller.is_stale()
    rig.line.streams = False
    rig.serve(3)
    assert LIVE_ROOT in rig.line.asked[-3:]


def test_a_line_that_is_faster_than_it_says_is_asked_for_all():
    rig = SlowRig(factor=10).ready()
    rig.line.streams = True
    rig.serve(1)
    asked = len(rig.line.asked)
    rig.serve(10)
    assert set(rig.line.asked[asked:]) == {LIVE_ROOT}
    assert not rig.line.polls_alone


def test_what_the_firmware_says_in_words_brings_the_guards_parts_at_once():
    rig = SlowRig().ready()
    rig.line.streams = True
    rig.serve(20)
    rig.poller.heard("fault")
    began_at, asked = rig.now, len(rig.line.asked)
    rig.serve(2)
    assert {each.key for each in rig.line.asked[asked:]} == {"state", "heat.heaters[].state"}
    assert rig.now - began_at < 0.3
