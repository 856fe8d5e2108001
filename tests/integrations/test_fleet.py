"""The example of a fleet: two printers at a real broker are two lines, and its files are sound."""

import os
import subprocess
import sys

import pytest
import yaml

from octoprint_rrfmodel.integrations.mqtt import MqttPublisher
from tests.support.places import ROOT
from tests.support.plugins.mqtt import Connection
from tests.support.waiting import wait_for

FLEET = ROOT / "extras" / "fleet"

STATE = {"connected": True, "ready": True, "stale": False}


def model(status, current, **job):
    """Return as much of a model as a line tells of."""
    heaters = [
        {"current": 60.2, "active": 60.0, "standby": 0.0, "state": "active"},
        {"current": current, "active": 210.0, "standby": 150.0, "state": "standby"},
        {"current": 21.0, "active": 0.0, "standby": 0.0, "state": "off"},
    ]
    return {
        "state": {"status": status},
        "heat": {"heaters": heaters, "bedHeaters": [0, -1]},
        "tools": [{"number": 0, "heaters": [1]}, None, {"number": 2, "heaters": [2]}],
        "job": job,
    }


class Printer:
    """One OctoPrint of the fleet, as far as the broker knows."""

    def __init__(self, broker, name, model, state=STATE):
        self.connection = Connection()
        self.connection.open(broker.port)
        wait_for(lambda: self.connection.is_open, 10, "the connection to the broker")
        self.model = model
        self._now = 0.0
        self._publisher = MqttPublisher(
            lambda: self.connection.mqtt_publish,
            lambda: f"shop/{name}/rrfmodel",
            lambda: self.model,
            status=lambda: state,
            clock=lambda: self._now,
        )
        self.connection.mqtt_publish(f"shop/{name}/mqtt", "connected", retained=True)

    def publish(self, **keys):
        self.model = {**self.model, **keys}
        self._publisher.changed(keys)
        self._now += 1
        self._publisher.tick()


def command(broker, *options):
    where = ["--host", "127.0.0.1", "--port", str(broker.port)]
    return [sys.executable, str(FLEET / "fleet.py"), *where, *options]


def lines(broker, *options):
    """Return what the script prints of what the broker knows now."""
    done = subprocess.run(command(broker, "--once", *options), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return [line.split() for line in done.stdout.splitlines()]


@pytest.fixture
def fleet(broker):
    """Two printers that have published; ``fleet["left"]`` prints."""
    printers = {
        "left": Printer(
            broker, "left", model("processing", 205.4, filePosition=420, file={"size": 1000})
        ),
        "right": Printer(broker, "right", model("idle", 149.6)),
    }
    for printer in printers.values():
        printer.publish()
    yield printers
    for printer in printers.values():
        printer.connection.close()


HEAT = ["T0", "205/150", "T2", "21/0", "bed", "60/60"]


def test_a_line_for_each_printer(broker, fleet):
    wait_for(lambda: len(lines(broker)) == 2, 10, "two lines")
    assert lines(broker) == [
        ["left", "processing", "42%", *HEAT],
        ["right", "idle", "T0", "150/150", *HEAT[2:]],
    ]


def test_line_comes_again_when_it_has_changed(broker, fleet):
    with subprocess.Popen(command(broker), stdout=subprocess.PIPE, text=True) as process:
        try:
            first = {process.stdout.readline().split()[0] for _ in range(2)}
            assert first == {"left", "right"}
            fleet["right"].publish(state={"status": "busy"})
            assert process.stdout.readline().split()[:2] == ["right", "busy"]
        finally:
            process.kill()


@pytest.mark.parametrize(
    "topic, payload, said",
    [
        ("mqtt", "disconnected", ["OctoPrint", "is", "off"]),
        ("rrfmodel/status", {**STATE, "connected": False}, ["no", "printer"]),
        ("rrfmodel/status", {**STATE, "ready": False}, ["connecting"]),
        ("rrfmodel/status", {**STATE, "stale": True}, ["idle", *HEAT, "(no", "news)"]),
        ("progress/printing", {"path": "a.gcode", "progress": 7}, ["idle", "7%", *HEAT]),
        ("rrfmodel/heat", "{broken", ["idle"]),
    ],
    ids=["off", "no printer", "connecting", "stale", "streamed", "no json"],
)
def test_what_a_line_says(broker, topic, payload, said):
    printer = Printer(broker, "one", model("idle", 205.4))
    if topic == "rrfmodel/heat":
        printer.model = {"state": {"status": "idle"}}
    printer.publish()
    printer.connection.mqtt_publish(f"shop/one/{topic}", payload, retained=True)
    assert wait_for(lambda: lines(broker) == [["one", *said]], 10, f"the line to say {said}")
    printer.connection.close()


def test_without_a_broker_or_a_printer_it_says_so(broker):
    nobody = subprocess.run(command(broker, "--once"), capture_output=True, text=True)
    assert (nobody.returncode, nobody.stdout) == (1, "")
    assert "shop/" in nobody.stderr
    broker.stop()
    nothing = subprocess.run(command(broker), capture_output=True, text=True)
    assert (nothing.returncode, nothing.stdout) == (1, "")
    assert str(broker.port) in nothing.stderr


def test_it_needs_nothing_of_the_project():
    source = (FLEET / "fleet.py").read_text(encoding="utf-8")
    assert "octoprint_rrfmodel" not in source


def test_prometheus_asks_each_printer_with_its_own_key():
    config = yaml.safe_load((FLEET / "prometheus.yml").read_text(encoding="utf-8"))
    jobs = config["scrape_configs"]
    assert [job["static_configs"][0]["labels"]["printer"] for job in jobs] == ["left", "right"]
    assert {job["metrics_path"] for job in jobs} == {"/plugin/rrfmodel/metrics"}
    keys = [job["authorization"]["credentials_file"] for job in jobs]
    assert len(set(keys)) == len(keys)
    assert not [key for key in keys if os.path.exists(FLEET / key)]
