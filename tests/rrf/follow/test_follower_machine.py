"""A board that changes as it likes on a line that fails; when it calms, all of it is known."""

import copy

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.model.merge import paths
from octoprint_rrfmodel.rrf.wire.line import NO_BUFFERS, find_reply
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply

from ..board import Board, machine
from ..independent import differing, same
from ..strategies import VALUES, compact, model_reply

REQUESTS_UNTIL_KNOWN = 150
"""Two rounds of all keys with live values between, and the tries of M408 before them."""

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
        self.follower = Follower()
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
        text = self.board.reply(self.follower.next_request())
        if text is None:
            self.follower.not_supported()
        return text

    def time_goes_on(self, seconds=1):
        self.board.model = copy.deepcopy(self.board.model)
        self.board.model["state"]["upTime"] += seconds

    @rule(times=st.integers(1, 12))
    def answer(self, times):
        for _ in range(times):
            text = self.ask()
            if text is not None:
                self.take(find_reply(text).reply)
            self.time_goes_on()

    @rule(key=FREE_KEYS, value=VALUES)
    def change_anything(self, key, value):
        self.board.set(key, value)

    @rule(edit=EDITS)
    def change(self, edit):
        self.board.set(*edit)

    @rule(axes=st.integers(0, 12))
    def change_axes(self, axes):
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
        for _ in range(REQUESTS_UNTIL_KNOWN):
            text = self.ask()
            if text is not None:
                self.take(text)
            if self.is_known():
                return
        assert self.follower.ready
        assert list(differing(self.board.model, self.follower.store.model)) == []
        raise AssertionError("more to fetch, and nothing differs")

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
    max_examples=60, stateful_step_count=25, suppress_health_check=[HealthCheck.too_slow]
)
