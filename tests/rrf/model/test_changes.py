"""Subscriptions: who is told what, whatever callbacks do."""

import threading

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.model.changes import Subscriptions
from octoprint_rrfmodel.rrf.model.keys import Key
from octoprint_rrfmodel.rrf.model.store import ModelStore
from tests.support.examples import some

from ..independent import same
from ..strategies import NAMES, OBJECTS


class Listener:
    """A store, subscriptions to it, and what they were told."""

    def __init__(self, **model):
        self.store = ModelStore()
        self.store.patch(model)
        self.failures = []
        self.subscriptions = Subscriptions(self.failures.append)
        self.calls = []

    def on(self, path):
        return self.subscriptions.subscribe(path, lambda *call: self.calls.append(call))

    def patch(self, **members):
        return self.tell(self.store.patch, members)

    def tell(self, change, *arguments):
        before = self.store.model
        changes = change(*arguments)
        self.subscriptions.tell(before, self.store.model, True if changes is None else changes)
        calls, self.calls = self.calls, []
        return calls


HEAT = {"heaters": [{"current": 20.5, "state": "off"}, {"current": 21.0, "state": "off"}]}


def heat(*currents):
    return {"heaters": [{"current": current} for current in currents]}


TOLD = [
    ("heat.heaters[0].current", heat(25.5, 21.0), [(25.5, 20.5)]),
    ("heat.heaters[0].current", heat(20.5, 30.0), []),
    ("heat.heaters[0].state", heat(25.5, 30.0), []),
    ("heat.heaters[].current", heat(20.5, 30.0), [([20.5, 30.0], [20.5, 21.0])]),
    ("heat.heaters[].state", heat(20.5, 30.0), []),
    ("heat.heaters[].current", heat(20.5), [([20.5], [20.5, 21.0])]),
    ("#heat.heaters", heat(20.5, 30.0), []),
    ("#heat.heaters", heat(20.5), [(1, 2)]),
    ("heat.heaters[2].current", heat(20.5, 21.0, 5.0), [(5.0, None)]),
    ("heat.heaters[1].current", heat(20.5), [(None, 21.0)]),
    ("nosuch", heat(25.5), []),
]


@pytest.mark.parametrize(("path", "patch", "calls"), TOLD)
def test_told(path, patch, calls):
    listener = Listener(heat=HEAT, state={"status": "idle"})
    listener.on(path)
    assert listener.patch(heat=patch) == [(path, *call) for call in calls]
    assert listener.patch(heat=patch) == [], "the same again is no change"


def test_values_are_the_snapshots_own():
    listener = Listener(heat=HEAT)
    listener.on("heat.heaters[0]")
    listener.on("")
    before = listener.store.model
    (_, new, old), (_, whole, was) = listener.patch(heat=heat(25.5, 21.0))
    assert new is listener.store.model["heat"]["heaters"][0]
    assert old is before["heat"]["heaters"][0]
    assert whole is listener.store.model
    assert was is before


@pytest.mark.parametrize(
    ("old", "new", "is_change"),
    [(0, 0.0, False), (0, False, True), (None, 0, True), (1, True, True), ([], {}, True)],
)
def test_what_is_another_value(old, new, is_change):
    listener = Listener(a={"b": old})
    listener.on("a.b")
    assert bool(listener.patch(a={"b": new})) is is_change


def test_null_and_absent_are_both_none():
    listener = Listener(a={"b": None})
    listener.on("a.b")
    assert listener.tell(listener.store.replace, "a", {}) == []


def test_forgotten_and_known_again():
    listener = Listener(state={"status": "idle", "box": None})
    listener.on("state.status")
    listener.on("state.box")
    listener.on("nosuch")
    assert listener.tell(listener.store.forget) == [("state.status", None, "idle")]
    assert listener.patch(state={"status": "busy"}) == [("state.status", "busy", None)]


@pytest.mark.parametrize("changes", [None, {}])
def test_nobody_is_told_of_nothing(changes):
    listener = Listener(a=1)
    listener.on("")
    listener.subscriptions.tell({"a": 1}, {"a": 2}, changes)
    assert listener.calls == []


def test_in_the_order_of_subscribing():
    listener = Listener(a=1, b=1)
    for path in ("b", "a", "", "b"):
        listener.on(path)
    assert [path for path, *_ in listener.patch(a=2, b=2)] == ["b", "a", "", "b"]


def test_malformed_path():
    with pytest.raises(ValueError, match="is no key: "):
        Listener().on("heat[")


def test_unsubscribed():
    listener = Listener(a=1)
    ends = [listener.on("a") for _ in range(3)]
    ends[1]()
    assert len(listener.patch(a=2)) == 2
    ends[1]()
    assert len(listener.patch(a=3)) == 2
    ends[0]()
    ends[2]()
    assert listener.patch(a=4) == []


def test_callback_that_raises_is_reported_and_the_others_go_on():
    listener = Listener(a=1)
    error = RuntimeError("as a plugin does")

    def fail(*call):
        raise error

    listener.on("a")
    listener.subscriptions.subscribe("a", fail)
    listener.on("a")
    assert len(listener.patch(a=2)) == 2
    assert listener.failures == [error]
    assert len(listener.patch(a=3)) == 2
    assert listener.failures == [error, error]


def test_callback_ends_itself_and_another():
    listener = Listener(a=1)
    ends = []

    def end(*call):
        listener.calls.append("end")
        for unsubscribe in ends:
            unsubscribe()

    ends.append(listener.subscriptions.subscribe("a", end))
    ends.append(listener.on("a"))
    assert listener.patch(a=2) == ["end"]
    assert listener.patch(a=3) == []


def test_callback_subscribes():
    listener = Listener(a=1)

    def subscribe(*call):
        listener.on("a")

    unsubscribe = listener.subscriptions.subscribe("a", subscribe)
    assert listener.patch(a=2) == [], "what was subscribed meanwhile begins with the next change"
    unsubscribe()
    assert listener.patch(a=3) == [("a", 3, 2)]


def test_threads_subscribe_and_end_while_others_are_told():
    listener = Listener(a=0)
    steady = []
    listener.subscriptions.subscribe("a", lambda path, new, old: steady.append(new))
    rounds = 300
    begin = threading.Barrier(5)

    def come_and_go():
        begin.wait()
        for _ in range(rounds):
            unsubscribe = listener.subscriptions.subscribe("a", lambda *call: None)
            unsubscribe()

    threads = [threading.Thread(target=come_and_go) for _ in range(4)]
    for thread in threads:
        thread.start()
    begin.wait()
    for number in range(1, rounds + 1):
        listener.patch(a=number)
    for thread in threads:
        thread.join()
    assert steady == list(range(1, rounds + 1))
    assert listener.failures == []
    steady.clear()
    last = []
    listener.subscriptions.subscribe("a", lambda path, new, old: last.append(new))
    listener.patch(a=-1)
    assert (steady, last) == ([-1], [-1])


PATHS = st.builds(
    lambda first, rest: first + "".join(rest),
    NAMES,
    st.lists(
        st.one_of(NAMES.map(lambda name: f".{name}"), st.sampled_from(["[]", "[0]"])), max_size=3
    ),
)


@settings(max_examples=some(200))
@given(OBJECTS, st.lists(st.tuples(st.booleans(), NAMES, OBJECTS), max_size=4), PATHS)
def test_told_exactly_when_the_value_is_another(model, replies, path):
    listener = Listener(**model)
    listener.on(path)
    for is_patch, name, value in replies:
        before = Key(path).value(listener.store.model)
        if is_patch:
            calls = listener.tell(listener.store.patch, value)
        else:
            calls = listener.tell(listener.store.replace, name, value)
        after = Key(path).value(listener.store.model)
        assert bool(calls) is not same(before, after)
        for call in calls:
            assert call == (path, after, before)
    assert listener.failures == []
