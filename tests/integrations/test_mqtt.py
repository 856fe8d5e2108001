"""What a real broker is told: topics, payloads, how often, and when broker or printer fail."""

import logging

import pytest

from octoprint_rrfmodel.integrations.mqtt import (
    SHORTEST_SECONDS,
    MqttPublisher,
    mqtt_publish,
    topic_of,
)
from tests.support.broker import Subscriber
from tests.support.broker import retained as broker_retained
from tests.support.plugins.mqtt import Connection
from tests.support.waiting import wait_for

TOPIC = "octoPrint/plugin/rrfmodel"
STATE = {"ready": True, "stale": False, "age": 0.3, "revision": 7, "counters": {}, "warnings": []}


class Rig:
    """A publisher with a clock, a model and settings that the test turns."""

    def __init__(self, helper):
        self.helper = helper
        self.now = 100.0
        self.topic = TOPIC
        self.model = {"state": {"status": "idle"}, "heat": {"heaters": [{"current": 21.5}]}}
        self.status = dict(STATE)
        self.publisher = MqttPublisher(
            lambda: self.helper,
            lambda: self.topic,
            lambda: self.model,
            status=lambda: self.status,
            clock=lambda: self.now,
        )

    def tick(self, seconds=SHORTEST_SECONDS):
        self.now += seconds
        return self.publisher.tick()

    def change(self, **keys):
        self.model = {**self.model, **keys}
        self.publisher.changed(keys)


class Recorder:
    """A helper that keeps what it was called with."""

    def __init__(self, works=True):
        self.calls = []
        self.works = works

    def __call__(self, topic, payload, retained=None, **others):
        self.calls.append((topic, payload, retained))
        return self.works

    def take(self):
        calls, self.calls = self.calls, []
        return [(topic, payload) for topic, payload, _ in calls]


@pytest.fixture
def connection(broker):
    connection = Connection()
    connection.open(broker.port)
    wait_for(lambda: connection.is_open, 10, "the connection to the broker")
    yield connection
    connection.close()


def retained(broker, count=3, base=TOPIC):
    """Return what the broker has kept, by the last part of the topic."""
    found = broker_retained(broker, f"{base}/#", count)
    return {topic[len(base) + 1 :]: value for topic, value in found.items()}


# the broker's view


def test_model_and_state_are_retained(broker, connection):
    rig = Rig(connection.mqtt_publish)
    rig.tick()
    told = retained(broker)
    status = told.pop("status")
    assert told == rig.model
    assert status == {"ready": True, "stale": False, "warnings": []}


def test_only_what_changed_goes_out(broker, connection):
    rig = Rig(connection.mqtt_publish)
    rig.tick()
    with Subscriber(broker, f"{TOPIC}/#") as subscriber:
        subscriber.wait_for(f"{TOPIC}/status", bool)
        before = len(subscriber.messages)
        rig.change(heat={"heaters": [{"current": 22.0}]})
        rig.tick()
        subscriber.wait_for(f"{TOPIC}/heat", lambda body: b"22.0" in body)
        assert [topic for topic, _ in subscriber.messages[before:]] == [f"{TOPIC}/heat"]


def test_broker_that_forgets_is_told_everything(broker, connection):
    rig = Rig(connection.mqtt_publish)
    rig.tick()
    retained(broker)
    broker.stop()
    wait_for(lambda: not connection.is_open, 10, "the end of the connection")
    rig.change(state={"status": "busy"})
    rig.tick()
    broker.start()
    wait_for(lambda: connection.is_open, 10, "the connection to come back")
    rig.tick()
    told = retained(broker)
    assert told["state"] == {"status": "busy"}
    assert told["heat"] == rig.model["heat"]


def test_other_topic_takes_the_old_one_back(broker, connection):
    rig = Rig(connection.mqtt_publish)
    rig.tick()
    retained(broker)
    rig.topic = "shop/left/rrfmodel"
    rig.tick()
    assert retained(broker, base="shop/left/rrfmodel")["heat"] == rig.model["heat"]
    with Subscriber(broker, "octoPrint/#") as subscriber:
        assert subscriber.retained == {}


# how often, and what with a failing broker or printer


def test_at_most_once_a_second():
    helper = Recorder()
    rig = Rig(helper)
    rig.tick()
    helper.take()
    for number in range(8):
        rig.change(state={"status": f"word {number}"})
        rig.tick(0.25)
    assert helper.take() == [
        (f"{TOPIC}/state", '{"status":"word 3"}'),
        (f"{TOPIC}/state", '{"status":"word 7"}'),
    ]
    assert 0 < rig.tick(0.4) <= SHORTEST_SECONDS


def test_everything_is_retained():
    helper = Recorder()
    Rig(helper).tick()
    assert {kept for _, _, kept in helper.calls} == {True}


def test_state_comes_first_when_the_values_no_longer_hold():
    helper = Recorder()
    rig = Rig(helper)
    rig.tick()
    assert [topic.rpartition("/")[2] for topic, _ in helper.take()] == ["heat", "state", "status"]
    # a reset: the model is empty, then the first key of the new one is there
    rig.change(state={"status": "off"})
    rig.publisher.forgotten()
    rig.model = {}
    rig.status = {**STATE, "ready": False}
    rig.tick()
    assert helper.take() == [(f"{TOPIC}/status", '{"ready":false,"stale":false,"warnings":[]}')]
    rig.change(boards=[])
    rig.status = {**STATE, "ready": False, "stale": True}
    rig.tick()
    assert [topic.rpartition("/")[2] for topic, _ in helper.take()] == ["status", "boards"]


def test_what_changes_all_the_time_is_no_news():
    helper = Recorder()
    rig = Rig(helper)
    rig.tick()
    helper.take()
    rig.status = {**STATE, "age": 1.7, "revision": 8, "counters": {"polls": 9}}
    rig.tick()
    assert helper.take() == []


def test_a_name_that_is_none_gets_no_topic():
    helper = Recorder()
    rig = Rig(helper)
    rig.model = {"state": {}, "he/at": {}, "+": 1, "": 2}
    rig.tick()
    assert [topic for topic, _ in helper.take()] == [f"{TOPIC}/state", f"{TOPIC}/status"]


def _raises(*arguments, **others):
    raise ValueError("broker on fire")


@pytest.mark.parametrize(
    "helper, said",
    [(Recorder(works=False), "no connection"), (_raises, "broker on fire")],
    ids=["not connected", "raises"],
)
def test_failing_broker_is_logged_once(helper, said, caplog):
    rig = Rig(helper)
    with caplog.at_level(logging.INFO):
        for _ in range(5):
            rig.change(state={"status": "busy"})
            assert rig.tick() == SHORTEST_SECONDS
        assert [said in record.getMessage() for record in caplog.records] == [True]
        works = rig.helper = Recorder()
        rig.tick()
        assert (f"{TOPIC}/state", '{"status":"busy"}') in works.take()
        rig.change(state={"status": "idle"})
        rig.helper = helper
        rig.tick()
    assert len(caplog.records) == 2


def test_plugin_that_comes_later_is_told_everything():
    rig = Rig(None)
    rig.change(state={"status": "busy"})
    rig.tick()
    rig.helper = Recorder()
    rig.tick()
    assert len(rig.helper.take()) == 3


# the topic


@pytest.mark.parametrize(
    "text, topic",
    [
        (TOPIC, TOPIC),
        ("a/b/", "a/b"),
        (" a/b// ", "a/b"),
        ("/a", "/a"),
        ("Werkstatt/Prüfer", "Werkstatt/Prüfer"),
        (7, "7"),
        ("", None),
        (None, None),
        ("///", None),
        ("a/+/b", None),
        ("a/#", None),
        ("a\0b", None),
        ("a\nb", None),
        ("a\ud800", None),
        ("a" * 2000, None),
    ],
    ids=repr,
)
def test_topic(text, topic):
    assert topic_of(text) == topic


@pytest.mark.parametrize("setting, code", [(TOPIC, None), (None, None), ("a/#", "mqtt_topic")])
def test_bad_topic_is_a_problem_and_off_is_none(setting, code):
    helper = Recorder()
    rig = Rig(helper)
    rig.topic = setting
    rig.tick()
    assert rig.publisher.problem() == code
    assert (helper.take() == []) is (setting != TOPIC)
    rig.helper = None
    assert rig.publisher.problem() is None


@pytest.mark.parametrize("setting", [None, "a/#"], ids=["off", "bad"])
def test_without_a_topic_what_was_published_is_taken_back(setting):
    helper = Recorder()
    rig = Rig(helper)
    rig.tick()
    sent = helper.take()
    rig.topic = setting
    rig.tick()
    assert sorted(helper.take()) == sorted((topic, "") for topic, _ in sent)
    rig.change(state={})
    rig.tick()
    assert helper.take() == []


class Plugins:
    """OctoPrint's answers to who asks for a plugin's helpers."""

    def __init__(self, helpers):
        self._helpers = helpers

    def get_helpers(self, name, *names):
        assert name == "mqtt"
        return self._helpers


@pytest.mark.parametrize(
    "helpers, found", [(None, None), ({}, None), ({"mqtt_publish": print}, print)], ids=repr
)
def test_helper_is_looked_up(helpers, found):
    assert mqtt_publish(Plugins(helpers)) is found
