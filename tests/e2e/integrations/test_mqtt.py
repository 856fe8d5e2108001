"""A real OctoPrint tells a real broker what the machine is like, and whether that still holds."""

from pathlib import Path

import pytest

from tests.support import broker as mqtt
from tests.support import plugins
from tests.support.basedir import READER
from tests.support.docs import json_examples

from .. import helpers

PLUGIN = Path(plugins.__file__).with_name("mqtt.py")
TOPIC = "octoPrint/plugin/rrfmodel"


@pytest.fixture
def server(server_factory, broker):
    return server_factory(
        plugin_files=(PLUGIN,), plugins_config={"mqtt": {"broker": {"port": broker.port}}}
    )


def told(broker, topic=TOPIC, count=1):
    """Return what the broker has kept below a topic, by the rest of each message's."""
    found = mqtt.retained(broker, f"{topic}/#", count)
    return {name[len(topic) + 1 :]: value for name, value in found.items()}


def wait_told(server, broker, name, fits, topic=TOPIC):
    """Return once the broker has kept a value that fits."""

    def is_told():
        value = told(broker, topic).get(name)
        return value is not None and fits(value)

    server.wait_for(is_told, 20, f"the broker to know of {name}")


@pytest.mark.both_hosts("each hands helpers to plugins")
def test_model_is_published_and_followed(server, broker, board_factory):
    wait_told(server, broker, "status", lambda state: not state["connected"])
    board = board_factory()
    helpers.connect(server, board)
    wait_told(server, broker, "status", lambda state: state["ready"] and not state["stale"])
    known = told(broker)
    status = known.pop("status")
    assert status["firmware"]["version"] == board.board.firmware.version
    (documented,) = (e for e in json_examples("integrations.md") if "ready" in e)
    assert set(status) == set(documented)
    assert set(status["firmware"]) == set(documented["firmware"])
    assert set(known) == set(board.board.model)
    assert (
        list(
            difference
            for key in known
            if key not in ("seqs", "state")
            for difference in helpers.differences(known[key], helpers.own_value(board, key), key)
        )
        == []
    )

    board.board.execute("M140 S45")
    wait_told(server, broker, "heat", lambda heat: heat["heaters"][0]["active"] == 45)

    # values stay, and the state says that they no longer hold
    helpers.disconnect(server)
    wait_told(server, broker, "status", lambda state: not state["ready"])
    assert set(told(broker)) == {*known, "status"}


def test_topic_is_a_setting(server, broker, board_factory):
    helpers.connect(server, board_factory())
    wait_told(server, broker, "status", lambda state: state["ready"])
    server.set_setting("plugins.rrfmodel.mqtt.topic", "shop/left/rrfmodel/")
    wait_told(server, broker, "status", bool, "shop/left/rrfmodel")
    wait_told(server, broker, "heat", bool, "shop/left/rrfmodel")
    with mqtt.Subscriber(broker, f"{TOPIC}/#") as subscriber:
        assert subscriber.retained == {}

    server.set_setting("plugins.rrfmodel.mqtt.topic", "shop/+/rrfmodel")
    codes = [warning["code"] for warning in helpers.status(server)["warnings"]]
    assert "mqtt_topic" in codes
    server.set_setting("plugins.rrfmodel.mqtt.enabled", False)
    codes = [warning["code"] for warning in helpers.status(server)["warnings"]]
    assert "mqtt_topic" not in codes

    def is_withdrawn():
        with mqtt.Subscriber(broker, "shop/#") as subscriber:
            return subscriber.retained == {}

    server.wait_for(is_withdrawn, 10, "the broker to forget")


def test_nothing_waits_for_the_broker(server, broker, board_factory):
    board = board_factory()
    helpers.connect(server, board)
    wait_told(server, broker, "status", lambda state: state["ready"])
    broker.stop()
    helpers.wait_polls(server, 5)
    board.board.execute("M140 S45")
    helpers.wait_value(server, "heat.heaters[0].active", 45, 5)
    broker.start()
    wait_told(server, broker, "heat", lambda heat: heat["heaters"][0]["active"] == 45)
    wait_told(server, broker, "boards", bool)
    complaints = [line for line in server.log().splitlines() if "rrfmodel.mqtt" in line]
    # one for the time before the first connection, one for the time without the broker
    assert 1 <= len(complaints) <= 2


@pytest.mark.both_hosts("each tells by its own code who somebody is")
def test_prometheus_may_send_the_key_as_a_bearer_token(server):
    """As extras/fleet/prometheus.yml does."""
    with server.client() as nobody:
        path = "/plugin/rrfmodel/status"
        key = {"Authorization": f"Bearer {READER.api_key}"}
        assert nobody.get(path).status_code == 403
        assert nobody.get(path, headers=key).status_code == 200
