"""Who is told what, when, and how often it is computed; with a clock of the test's own."""

import json
from concurrent.futures import Future
from functools import partial

import pytest

from octoprint_rrfmodel.rrf import klipper
from octoprint_rrfmodel.rrf.klipper import Accumulated, Host, World
from octoprint_rrfmodel.web.moonraker import subscribers
from octoprint_rrfmodel.web.moonraker.subscribers import Subscribers

HOST = Host(is_connected=True, is_ready=True, has_protocol=True, job=None)


class Loop:
    """As much of Tornado's loop as subscribers use."""

    def __init__(self):
        self.now = 100.0
        self.timers = []

    def time(self):
        return self.now

    def call_at(self, when, function):
        self.timers.append((when, function))
        return object()

    def pass_time(self, seconds):
        self.now += seconds
        due = [function for when, function in self.timers if when <= self.now]
        self.timers = [timer for timer in self.timers if timer[0] > self.now]
        for function in due:
            function()


class Connection:
    def __init__(self):
        self.told = []

    def send(self, text):
        self.told.append(json.loads(text))

    @property
    def differences(self):
        return [message["params"][0] for message in self.told]


class Bench:
    """Subscribers of a machine whose bed target and message can be set."""

    def __init__(self):
        self.loop = Loop()
        self.target = 0
        self.message = ""
        self.held = None
        """What is worked on off the loop, where a test lets that take its time."""
        self.subscribers = Subscribers(self.world, self.loop, self.run)

    def run(self, function, then):
        work = partial(self.do, function, then)
        if self.held is None:
            work()
        else:
            self.held.append(work)

    @staticmethod
    def do(function, then):
        done = Future()
        done.set_result(function())
        then(done)

    def world(self):
        model = {
            "state": {"status": "idle", "upTime": 5, "displayMessage": self.message},
            "heat": {
                "bedHeaters": [0],
                "heaters": [{"state": "active", "active": self.target, "current": 20.5}],
            },
        }
        return World(model, HOST, Accumulated(), self.loop.now)

    def subscribe(self, wanted):
        connection = Connection()
        return connection, self.subscribe_again(connection, wanted)

    def subscribe_again(self, connection, wanted):
        wanted = klipper.wanted_of(wanted)
        status = klipper.status(self.world(), wanted)
        self.subscribers.subscribe(connection, wanted, status)
        return status

    def heat(self, target):
        self.target = target
        self.subscribers.changed()


@pytest.fixture
def bench():
    return Bench()


BED = {"heater_bed": ["target"]}


def test_first_answer_is_complete_and_nothing_follows_without_a_change(bench):
    connection, status = bench.subscribe(BED)
    assert status == {"heater_bed": {"target": 0.0}}
    bench.subscribers.changed()
    bench.loop.pass_time(1)
    assert connection.told == []


def test_change_is_told_at_once_and_then_not_for_a_while(bench):
    connection, _ = bench.subscribe(BED)
    bench.heat(50)
    assert connection.differences == [{"heater_bed": {"target": 50.0}}]
    assert connection.told[0]["method"] == "notify_status_update"
    assert connection.told[0]["params"][1] == 100.0
    bench.loop.pass_time(0.1)
    bench.heat(51)
    bench.heat(52)
    assert len(connection.told) == 1
    bench.loop.pass_time(0.14)
    assert len(connection.told) == 1
    bench.loop.pass_time(0.02)
    assert connection.differences[1:] == [{"heater_bed": {"target": 52.0}}]


def test_what_changes_back_in_the_quiet_time_is_not_told(bench):
    connection, _ = bench.subscribe(BED)
    bench.heat(50)
    bench.heat(51)
    bench.heat(50)
    bench.loop.pass_time(1)
    assert len(connection.told) == 1


def test_one_s_quiet_time_is_not_another_s(bench):
    bed, _ = bench.subscribe(BED)
    message, _ = bench.subscribe({"display_status": ["message"]})
    bench.heat(50)
    bench.loop.pass_time(0.1)
    bench.message = "seen"
    bench.subscribers.changed()
    assert message.differences == [{"display_status": {"message": "seen"}}]
    assert len(bed.told) == 1


def test_new_subscription_replaces_the_old(bench):
    connection, _ = bench.subscribe(BED)
    bench.subscribe_again(connection, {"display_status": ("message",)})
    bench.heat(50)
    assert connection.told == []
    assert len(bench.subscribers) == 1


def test_row_34_nothing_is_kept_of_what_nobody_wants_any_more(bench):
    connection, other = Connection(), Connection()
    for number in range(100):
        bench.subscribe_again(connection, {"heater_bed": (f"field{number}",)})
        bench.subscribe_again(other, {"heater_bed": ("target",)})
        bench.heat(number + 1)
    # the one of each connection
    assert len(bench.subscribers._latest) == 2
    bench.subscribers.unsubscribe(connection)
    assert list(bench.subscribers._latest) == [(("heater_bed", ("target",)),)]
    bench.subscribers.unsubscribe(other)
    assert not bench.subscribers._latest and not bench.subscribers._counts


def test_empty_subscription_and_end_of_connection(bench):
    connection, _ = bench.subscribe(BED)
    assert bench.subscribe_again(connection, {}) == {}
    other, _ = bench.subscribe(BED)
    bench.subscribers.unsubscribe(other)
    bench.heat(50)
    bench.loop.pass_time(1)
    assert connection.told == other.told == []
    assert len(bench.subscribers) == 0
    assert bench.loop.timers == []


def test_same_request_is_computed_once_for_all(bench, monkeypatch):
    counted = {"status": 0, "difference": 0, "text": 0}

    def counting(name, module, attribute):
        original = getattr(module, attribute)

        def count(*arguments):
            counted[name] += 1
            return original(*arguments)

        monkeypatch.setattr(module, attribute, count)

    connections = [bench.subscribe(BED)[0] for _ in range(100)]
    counting("status", klipper.Moment, "status")
    counting("difference", klipper.Moment, "difference")
    counting("text", subscribers.jsonrpc, "notification")
    bench.heat(2)
    assert counted == {"status": 1, "difference": 1, "text": 1}
    assert all(found.differences[-1] == {"heater_bed": {"target": 2.0}} for found in connections)


def test_who_comes_later_gets_every_change_after_its_answer(bench):
    first, _ = bench.subscribe(BED)
    bench.heat(1)
    bench.target = 2
    later, status = bench.subscribe(BED)
    assert status == {"heater_bed": {"target": 2.0}}
    bench.subscribers.changed()
    bench.loop.pass_time(0.3)
    assert first.differences == [{"heater_bed": {"target": 1.0}}, {"heater_bed": {"target": 2.0}}]
    assert later.told == []


def test_who_is_left_in_peace_is_told_when_another_goes(bench):
    first, _ = bench.subscribe(BED)
    bench.heat(1)
    bench.loop.pass_time(0.1)

    class Dropped(Connection):
        def send(self, text):
            bench.subscribers.unsubscribe(self)

    bench.subscribe_again(Dropped(), {"heater_bed": ["target"], "display_status": None})
    bench.message = "seen"
    bench.heat(2)
    bench.loop.pass_time(0.16)
    assert first.differences == [{"heater_bed": {"target": 1.0}}, {"heater_bed": {"target": 2.0}}]


def test_news_while_others_are_worked_out_are_told_behind_them(bench):
    connection, _ = bench.subscribe(BED)
    bench.held = []
    for target in (1, 2, 3):
        bench.heat(target)
    # once, however much comes meanwhile
    (work,) = bench.held
    bench.target = 4
    work()
    assert connection.differences == [{"heater_bed": {"target": 4.0}}]
    bench.heat(5)
    assert len(bench.held) == 1
    bench.loop.pass_time(0.3)
    bench.held[1]()
    assert connection.differences[1:] == [{"heater_bed": {"target": 5.0}}]


def test_what_was_worked_out_for_one_that_is_gone_is_told_nobody(bench):
    gone, _ = bench.subscribe(BED)
    other, _ = bench.subscribe(BED)
    bench.held = []
    bench.heat(1)
    bench.subscribers.unsubscribe(gone)
    bench.subscribe_again(other, {"display_status": ["message"]})
    bench.held[0]()
    assert gone.told == other.told == []
    # and the next change is worked out as ever
    bench.message = "seen"
    bench.subscribers.changed()
    bench.held[-1]()
    assert other.differences == [{"display_status": {"message": "seen"}}]
