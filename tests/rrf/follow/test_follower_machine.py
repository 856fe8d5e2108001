"""A board that changes as it likes on a line that fails; when it calms, all of it is known."""

import copy

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.follow.rows import Rows
from octoprint_rrfmodel.rrf.model.m409 import answer
from octoprint_rrfmodel.rrf.model.merge import paths
from octoprint_rrfmodel.rrf.wire.line import NO_BUFFERS, find_reply
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply
from tests.support.examples import some

from ..board import Board, machine
from ..independent import differing, same
from ..slow_line import AIM, BYTES_A_SECOND
from ..strategies import VALUES, compact, model_reply

REQUESTS_UNTIL_KNOWN = 150
"""Two rounds of all keys with live values between, and the tries of M408 before them."""

REQUESTS_UNTIL_ALL_PARTS = 400


def live(model):
    """Return what changes all the time, as far as parts of it are asked for by their names."""
    return answer(model, "", "d99fin")["result"]


# keys whose values may be anything
FREE_KEYS = st.sampled_from(
    ["global", "network", "directories", "fans", "job", "volumes", "spindles"]
)

EDITS = st.sampled_from(
    [
        ("heat.heaters", []),
        ("heat.heaters", [{"current": 20.5, "max": 285.0, "model": {}}, None]),
        ("heat.heaters", [None, {"current": 1, "active": 2, "model": {"pid": {"p": 1}}}]),
        ("heat.bedHeaters", [-1]),
        ("move.kinematics", {"name": "coreXY", "forwardMatrix": [[1.0]]}),
        ("move.kinematics", {"name": "delta", "towers": [{"xPos": 1.0}]}),
        ("move.speedFactor", 0),
        ("tools", [None, {"number": 1, "active": [5], "retraction": {"length": 1.0}}]),
        ("tools", []),
        ("state.messageBox", {"mode": 2, "seq": 5, "message": "}"}),
        ("state.messageBox", None),
        ("state.displayMessage", 'ok {"key":'),
        ("sensors.analog", [{"lastReading": 5.5, "name": "a"}]),
        ("inputs", [None, {"state": "idle", "lineNumber": 5}]),
        ("boards", [{"mcuTemp": {"current": 1.5, "max": 2.5}, "state": "running"}, None]),
    ]
)

FOREIGN = st.sampled_from(
    [
        model_reply({"x": 1}, key="heat.x", flags=""),
        model_reply([], key="tools", flags="d99", next=7),
        compact({"status": "I", "heaters": [1.0]}),
        "{" + compact({"key": ""})[1:-1],
    ]
)


class BoardOnABadLine(RuleBasedStateMachine):
    @initialize(
        axes=st.integers(7, 12),
        room=st.sampled_from([10240, 900, 700]),
        i=st.booleans(),
        counter=st.sampled_from([0, 65534]),
    )
    def start(self, axes, room, i, counter):
        """Little room makes live values come in parts and keys be split."""
        model = machine(axes)
        for axis in model["move"]["axes"]:
            axis.pop("homed")
        model["seqs"].update(move=counter, fans=counter)
        self.board = Board(model, room=room, ignored="" if i else "i")
        self.board.rooms = {"move.axes": 10240}
        self.now = 1000.0
        # keys whose parts may be others by now: while a print is streamed only parts are asked for
        self.built_otherwise = set()
        self.follower = Follower(Rows(lambda: self.now))
        self.late = None
        self.seen = []

    def take(self, text):
        before = self.follower.store.model
        revision = self.follower.store.revision
        try:
            taken = self.follower.take(text)
        except MalformedReply:
            assert self.follower.store.model is before
            return
        if taken is None or taken.reset:
            return
        told = [path for key in taken.changes for path in paths(taken.changes[key], key)]
        assert bool(told) is (self.follower.store.revision > revision)
        assert bool(told) is (self.follower.store.model is not before)
        tops = {path.partition(".")[0] for path in differing(before, self.follower.store.model)}
        assert {top.partition("[")[0] for top in tops} == set(taken.changes)

    def ask(self):
        if self.follower.is_sparing:
            self.now += self.follower.rows.wait()
        text = self.board.reply(self.follower.next_request())
        if text is None:
            self.follower.not_supported()
        return text

    def time_goes_on(self, seconds=1):
        self.board.model = copy.deepcopy(self.board.model)
        self.board.model["state"]["upTime"] += seconds

    @rule()
    def print_begins_on_a_slow_line(self):
        self.follower.spare(BYTES_A_SECOND, AIM)

    @rule()
    def slow_line_is_free(self):
        self.follower.spare(BYTES_A_SECOND, 0.4, True)

    @rule()
    def print_is_over(self):
        self.follower.spare(0, 1)

    @rule(times=st.integers(1, 12))
    def answer(self, times):
        for _ in range(times):
            text = self.ask()
            if text is not None:
                self.take(find_reply(text).reply)
            self.time_goes_on()

    @rule(key=FREE_KEYS, value=VALUES)
    def change_anything(self, key, value):
        self.built_otherwise.add(key)
        self.board.set(key, value)

    @rule(edit=EDITS)
    def change(self, edit):
        self.built_otherwise.add(edit[0].partition(".")[0])
        self.board.set(*edit)

    @rule(axes=st.integers(0, 12))
    def change_axes(self, axes):
        self.built_otherwise.add("move")
        self.board.set("move.axes", machine(axes)["move"]["axes"])

    @rule(reading=st.floats(0, 300).map(lambda value: round(value, 1)))
    def change_a_live_value_alone(self, reading):
        self.board.model = copy.deepcopy(self.board.model)
        self.board.model["move"]["currentMove"]["requestedSpeed"] = reading

    @rule()
    def card_changes(self):
        self.board.model = copy.deepcopy(self.board.model)
        self.board.model["seqs"]["volChanges"] = [
            count + 1 for count in self.board.model["seqs"]["volChanges"]
        ]

    @rule(times=st.integers(1, 7))
    def no_room(self, times):
        for _ in range(times):
            self.take(NO_BUFFERS)

    @rule(times=st.integers(1, 7))
    def silence(self, times):
        for _ in range(times):
            self.follower.timed_out()

    @rule(share=st.floats(0, 0.999))
    def cut_reply(self, share):
        text = self.ask()
        if text is not None:
            found = find_reply(text[: int(len(text) * share)] + "ok")
            if found is not None:
                self.take(found.reply)

    @rule()
    def reply_comes_late(self):
        self.late = self.ask()
        self.follower.timed_out()

    @rule()
    def late_reply(self):
        if self.late is not None:
            self.take(self.late)
        self.late = None

    @rule()
    def reply_comes_twice(self):
        text = self.ask()
        if text is not None:
            self.take(text)
            self.take(text)

    @rule(text=FOREIGN)
    def foreign_reply(self, text):
        if "status" not in text or "M409" in str(self.follower.protocol):
            self.take(text)

    def time_that_is_known(self):
        return self.follower.store.model.get("state", {}).get("upTime", 0)

    @precondition(lambda self: self.time_that_is_known() >= 1000)
    @rule()
    def reset(self):
        """Only where the time that is known will be seen to fall: nothing else shows it."""
        self.late = None
        self.board.reset()

    @rule()
    def time_passes_and_is_seen(self):
        self.time_goes_on(1000)
        self.answer(times=2)

    @rule(key=st.sampled_from(["", "move", "tools", "nothing"]))
    def refetch(self, key):
        self.follower.refetch(key)

    @rule()
    def new_connection(self):
        self.late = None
        self.follower.forget()

    @rule()
    def keep_snapshot(self):
        model = self.follower.store.model
        self.seen = [*self.seen[-3:], (model, copy.deepcopy(model))]

    @invariant()
    def snapshots_stay(self):
        for model, kept in getattr(self, "seen", ()):
            assert same(model, kept)

    @rule()
    def calm(self):
        self.late = None
        if self.follower.is_sparing:
            self.each_part_has_its_turn()
        self.follower.spare(0, 1)
        for _ in range(REQUESTS_UNTIL_KNOWN):
            text = self.ask()
            if text is not None:
                self.take(text)
            if self.is_known():
                self.built_otherwise.clear()
                return
        assert self.follower.ready
        assert list(differing(self.board.model, self.follower.store.model)) == []
        raise AssertionError("more to fetch, and nothing differs")

    def each_part_has_its_turn(self):
        for _ in range(REQUESTS_UNTIL_ALL_PARTS):
            text = self.ask()
            if text is not None:
                self.take(text)
            if not self.follower.is_sparing:
                return
            if not self.differing_parts():
                return
        assert self.differing_parts() == []

    def differing_parts(self):
        """Return where what changes all the time differs, in keys that are built as they were."""
        known, own = (
            {key: live(model)[key] for key in live(model).keys() - self.built_otherwise}
            for model in (self.follower.store.model, self.board.model)
        )
        return list(differing(own, known))

    def is_known(self):
        follower = self.follower
        return (
            follower.ready and not follower.behind and same(follower.store.model, self.board.model)
        )

    def teardown(self):
        if hasattr(self, "board"):
            self.calm()


TestBoardOnABadLine = BoardOnABadLine.TestCase
TestBoardOnABadLine.settings = settings(
    max_examples=some(60), stateful_step_count=25, suppress_health_check=[HealthCheck.too_slow]
)
