"""The poller on any link: one request at a time whatever becomes of it, all known in the end.

The link is a stand-in that keeps to the abstract class and to nothing else: it says what it is
asked, and a test says what becomes of that. What is asked is the poller's own affair.
"""

from collections import deque

import pytest

pytest.importorskip("octoprint")

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from octoprint_rrfmodel.link.known import Known
from octoprint_rrfmodel.link.link import Link
from octoprint_rrfmodel.link.poll_slot import TooManyQueries
from octoprint_rrfmodel.link.poller import ANSWER_SECONDS, QUEUED_SECONDS, Poller
from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.follow.pace import LONGEST_SECONDS
from octoprint_rrfmodel.rrf.wire.line import NO_BUFFERS, find_reply
from tests.rrf.board import Board, machine
from tests.rrf.follow.test_follower_machine import EDITS, FREE_KEYS
from tests.rrf.independent import differing, same
from tests.rrf.strategies import VALUES

from .test_poller import NoCard

CALM_POLLS = 400

LONGEST_PAUSE = QUEUED_SECONDS + LONGEST_SECONDS + 5
"""A poll that is given up, and the pause after failures."""


BECOMES = st.sampled_from([*["whole"] * 6, "lost", "cut", "twice", "no room"])

OK = st.sampled_from([*[True] * 6, False])


class Request:
    """A request from its asking to its end."""

    def __init__(self, request, at):
        self.request = request
        self.asked_at = at
        self.sent_at = None
        self.is_answered = self.is_acknowledged = False

    def is_over(self, now):
        """Return whether another may be asked."""
        if self.sent_at is None:
            return now - self.asked_at > QUEUED_SECONDS
        is_done = self.is_answered and self.is_acknowledged
        return is_done or now - self.sent_at > ANSWER_SECONDS


class StandIn(Link):
    """A link that sends nothing by itself; ``asked`` are requests that haven't left."""

    kind = "stand-in"
    is_operational = can_restart = True
    connection = "a connection"

    def __init__(self, clock):
        self._clock = clock
        self.last = None
        self.asked = deque()
        self.reason = None
        self.streams = False

    def ask(self, request):
        now = self._clock()
        assert self.reason is None, "a request while none may go out"
        assert self.last is None or self.last.is_over(now), "a second request"
        self.last = Request(request, now)
        self.asked.append(self.last)

    def give_up(self):
        self.last = None

    def forget(self):
        self.last = None
        self.asked.clear()

    def blocked(self):
        return self.reason

    def is_streaming_a_print(self):
        return self.streams

    has_a_print = is_printing = is_streaming_a_print

    def rate(self):
        return 115200

    def doing(self):
        return None

    def carried(self, lines, machine):
        return lines

    def no(self, *arguments, **more):
        return False

    has_polled = has_polled_at_all = is_paused = control_card_job = has_card = no
    end_job = profile = send = send_later = stop_now = restart = reconnect = no


class PollerOnAnyLink(RuleBasedStateMachine):
    @initialize(axes=st.integers(3, 11), room=st.sampled_from([10240, 900]), numbers=st.booleans())
    def start(self, axes, room, numbers):
        self.now = 100.0
        self.number = 0
        self.has_numbers = numbers
        model = machine(axes)
        for axis in model["move"]["axes"]:
            axis.pop("homed")
        self.board = Board(model, room=room)
        self.board.rooms = {"move.axes": 10240}
        self.wire = deque()
        self.questions = []
        self.link = StandIn(lambda: self.now)
        self.follower = Follower()
        self.known = Known(self.follower, self.link, lambda: self.now)
        self.poller = Poller(
            self.follower,
            NoCard(),
            self.link,
            known=self.known,
            replied=lambda taken, asked_at: None,
            clock=lambda: self.now,
        )
        self.poller.identified()

    ##~~ time

    @rule(seconds=st.sampled_from([0.0, 0.1, 0.6, 1.1, 3.0, 10.5, 31.0]))
    def time_passes(self, seconds):
        self.now += seconds
        if seconds >= 1:
            self.board.model["state"]["upTime"] += int(seconds)
        self.poller.tick()

    ##~~ the request's way; the line keeps its order

    @precondition(lambda self: self.link.asked and not self.wire)
    @rule()
    def leaves(self):
        request = self.link.asked.popleft()
        self.number += 1
        if request is not self.link.last:
            # it was given up, and goes out as what the link has it be
            return
        request.sent_at = self.now
        self.poller.poll_sent(self.now, self.number)
        self.wire.append((request, self.number))

    @precondition(lambda self: self.wire)
    @rule(becomes=BECOMES, ok=OK)
    def answered(self, becomes, ok):
        request, number = self.wire.popleft()
        text = NO_BUFFERS if becomes == "no room" else self.board.reply(request.request)
        if text is None:
            # tried while nothing was answered, and not known to this board
            becomes, text = "lost", ""
        elif self.has_numbers and text != NO_BUFFERS:
            text = f'{{"line":{number},{text[1:]}'
        if becomes == "cut":
            text = text[: len(text) * 2 // 3]
        for _ in range({"lost": 0, "twice": 2}.get(becomes, 1)):
            found = find_reply(text)
            if found is not None:
                self.poller.reply(found.reply, found.number)
                request.is_answered = True
        if ok:
            request.is_acknowledged = True
            self.poller.poll_acknowledged()

    @rule(rounds=st.lists(st.tuples(BECOMES, OK, st.sampled_from([0.1, 2.0])), max_size=15))
    def polls_go_on(self, rounds):
        for becomes, ok, seconds in rounds:
            self.time_passes(seconds)
            if self.link.asked and not self.wire:
                self.leaves()
            self.time_passes(seconds)
            if self.wire:
                self.answered(becomes, ok)

    @precondition(lambda self: self.wire)
    @rule()
    def is_dropped_by_the_queue(self):
        self.wire.clear()

    ##~~ the board

    @rule(key=FREE_KEYS, value=VALUES)
    def change_anything(self, key, value):
        self.board.set(key, value)

    @rule(edit=EDITS)
    def change(self, edit):
        self.board.set(*edit)

    @precondition(lambda self: self.follower.store.model.get("state", {}).get("upTime", 0) > 200)
    @rule()
    def reset(self):
        self.board.reset()

    @rule()
    def long_time_passes(self):
        self.board.model["state"]["upTime"] += 1000

    ##~~ the link and its users

    @rule(reason=st.sampled_from([None, None, "heating", "long_command", "streaming"]))
    def line_is_blocked(self, reason):
        self.link.reason = reason

    @rule(streams=st.booleans())
    def print_goes_on(self, streams):
        self.link.streams = streams

    @rule()
    def connection_ends_and_another_begins(self):
        self.wire.clear()
        self.link.forget()
        self.poller.forgotten()
        self.poller.tick()
        assert self.link.last is None
        self.poller.identified()

    @rule(what=st.sampled_from(["fault", "reset", "box"]))
    def firmware_says_something(self, what):
        self.poller.heard(what)

    @rule(key=st.sampled_from([None, "", "heat", "nothing"]))
    def somebody_looks(self, key):
        self.poller.look(key)

    @rule(key=st.sampled_from(["", "move.axes", "nothing"]))
    def somebody_asks(self, key):
        try:
            self.questions.append(self.poller.query(key, "d99vn"))
        except TooManyQueries:
            assert sum(not question.done() for question in self.questions) >= 4

    @invariant()
    def age_is_no_lie(self):
        if hasattr(self, "known") and self.known.age() is not None:
            assert self.known.age() >= 0
            assert self.known.asked_at <= self.now

    ##~~ the end

    def calm(self):
        self.link.reason = None
        self.link.streams = False
        self.board.model["state"]["upTime"] += 100
        if self.wire:
            self.answered("whole", True)
        for _ in range(CALM_POLLS):
            before = self.link.last
            until = self.now + LONGEST_PAUSE
            while self.link.last is before and self.now < until:
                self.now += max(0.01, min(1.0, self.poller.tick()))
            assert self.link.last is not before, "nothing is asked any more"
            while self.link.asked:
                self.leaves()
            if self.wire:
                self.answered("whole", True)
            if self.is_known() and all(question.done() for question in self.questions):
                return
        assert [question for question in self.questions if not question.done()] == []
        assert list(differing(self.board.model, self.follower.store.model)) == []
        raise AssertionError("more to fetch, and nothing differs")

    def is_known(self):
        follower = self.follower
        return (
            follower.ready
            and not follower.behind
            and not self.poller.is_stale()
            and same(follower.store.model, self.board.model)
        )

    def teardown(self):
        if hasattr(self, "board"):
            self.calm()


TestPollerOnAnyLink = PollerOnAnyLink.TestCase
TestPollerOnAnyLink.settings = settings(
    max_examples=80,
    stateful_step_count=30,
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
)
