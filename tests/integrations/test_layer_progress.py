"""The payload that DisplayLayerProgress's users know: members, forms, and when it is sent."""

import time

import pytest

from octoprint_rrfmodel.integrations.layer_progress import (
    CHANGES,
    MESSAGE,
    SHORTEST_SECONDS,
    LayerProgress,
    Readers,
    StreamedPrint,
    streamed_print,
)
from tests.support.docs import json_examples

# members and examples of their forms: DisplayLayerProgress, README, developers' section
MEMBERS = {
    "updateReason",
    "totalLayer",
    "currentLayer",
    "lastLayerDuration",
    "lastLayerDurationInSeconds",
    "averageLayerDuration",
    "averageLayerDurationInSeconds",
    "currentHeight",
    "currentHeightFormatted",
    "totalHeight",
    "totalHeightFormatted",
    "feedrate",
    "feedrateG0",
    "feedrateG1",
    "fanspeed",
    "progress",
    "m73progress",
    "printTimeLeft",
    "printTimeLeftInSeconds",
    "printerState",
    "estimatedEndTime",
    "estimatedChangedFilamentTime",
    "changeFilamentTimeLeft",
    "changeFilamentTimeLeftInSeconds",
    "changeFilamentCount",
    "currentFilename",
}

IDLE = {
    "state": {"status": "idle", "currentTool": 0},
    "job": {"file": {}},
    "move": {"axes": [{"letter": "Z", "userPosition": 6.8}]},
    "inputs": [{"name": "File", "feedRate": 45.0}, {"name": "USB", "feedRate": 100.0}],
    "tools": [{"number": 0, "fans": [0]}],
    "fans": [{"requestedValue": 0.69}],
}
FILE = {"fileName": "0:/gcodes/vase.gcode", "size": 1000, "height": 15.0, "numLayers": 66}
JOB = {"file": FILE, "filePosition": 290, "layer": 22, "timesLeft": {"slicer": 123}}
PRINTING = {**IDLE, "state": {"status": "processing", "currentTool": 0}, "job": JOB}
NOW = 1_700_000_000
STREAMED = StreamedPrint(False, "local.gcode", 29.0, 40)


class Rig:
    """The part with a clock, a model and OctoPrint's print that the test turns."""

    def __init__(self, model=PRINTING, streamed=None):
        self.now = 0.0
        self.model = model
        self.streamed = streamed
        self.is_wanted = True
        self.sent = []
        self.fired = []
        self.part = LayerProgress(
            Readers(
                send=lambda message, payload: self.sent.append((message, payload)),
                fire=lambda event, payload: self.fired.append((event, payload)),
            ),
            lambda: self.model,
            lambda: self.streamed,
            is_wanted=lambda: self.is_wanted,
            clock=lambda: self.now,
            now=lambda: NOW,
        )

    def tick(self, seconds=SHORTEST_SECONDS):
        """Let time pass; return what was sent and fired by that."""
        self.now += seconds
        self.sent, self.fired = [], []
        self.part.tick()
        return self.sent, self.fired

    def payload(self, **job):
        """Return what is sent with these members of the job."""
        self.model = {**self.model, "job": {**self.model["job"], **job}}
        ((message, payload),) = self.tick()[0]
        assert message == MESSAGE
        return payload


def test_members_are_those_that_are_known():
    assert set(Rig().payload()) == MEMBERS


def test_forms_of_a_print_from_the_card():
    assert Rig().payload() == {
        "updateReason": "layerChanged",
        "totalLayer": "66",
        "currentLayer": "22",
        "lastLayerDuration": "-",
        "lastLayerDurationInSeconds": "-",
        "averageLayerDuration": "-",
        "averageLayerDurationInSeconds": "-",
        "currentHeight": "6.80",
        "currentHeightFormatted": "6.8",
        "totalHeight": "15.0",
        "totalHeightFormatted": "15.0",
        "feedrate": "2700",
        "feedrateG0": "-",
        "feedrateG1": "-",
        "fanspeed": "69%",
        "progress": "29",
        "m73progress": "",
        "printTimeLeft": "2m",
        "printTimeLeftInSeconds": 123,
        "printerState": "printing",
        "estimatedEndTime": time.strftime("%H:%M", time.localtime(NOW + 123)),
        "estimatedChangedFilamentTime": "-",
        "changeFilamentTimeLeft": "-",
        "changeFilamentTimeLeftInSeconds": 0,
        "changeFilamentCount": 0,
        "currentFilename": "vase.gcode",
    }


def test_documentation_shows_it():
    (documented,) = (e for e in json_examples("integrations.md") if "updateReason" in e)
    # the time of day is the reader's
    end = {"estimatedEndTime": documented["estimatedEndTime"]}
    assert {**Rig().payload(), **end} == documented


def test_forms_of_a_print_that_is_streamed():
    payload = Rig(IDLE, STREAMED).payload()
    known = ("progress", "printTimeLeft", "currentFilename", "currentHeight", "feedrate")
    assert [payload[name] for name in known] == ["29", "40s", "local.gcode", "6.80", "6000"]
    assert [payload[name] for name in ("currentLayer", "totalLayer", "totalHeight")] == ["-"] * 3


@pytest.mark.parametrize(
    "seconds, text",
    [
        (0, "0s"),
        (40, "40s"),
        (60, "1m"),
        (3599, "59m"),
        (3600, "1h0m"),
        (9000, "2h30m"),
        (93600, "1d2h0m"),
    ],
)
def test_time_left(seconds, text):
    payload = Rig().payload(timesLeft={"slicer": seconds})
    assert (payload["printTimeLeft"], payload["printTimeLeftInSeconds"]) == (text, seconds)


def test_unknown_time_left():
    payload = Rig().payload(timesLeft={})
    names = ("printTimeLeft", "printTimeLeftInSeconds", "estimatedEndTime")
    assert [payload[name] for name in names] == ["-"] * 3


@pytest.mark.parametrize(
    "value, text", [(0, "Off"), (0.0, "Off"), (1.0, "100%"), (0.5, "50%"), (None, "-")]
)
def test_fan(value, text):
    assert Rig({**PRINTING, "fans": [{"requestedValue": value}]}).payload()["fanspeed"] == text


def test_layer_durations():
    rig = Rig()
    seen = []
    for layer in range(22, 30):
        payload = rig.payload(layer=layer)
        seen.append((payload["lastLayerDuration"], payload["averageLayerDurationInSeconds"]))
        # the last layers take a minute longer
        rig.now += 2 if layer < 28 else 62
    assert seen == [
        # nobody knows when the first one that was seen began
        *[("-", "-")] * 2,
        *[("0h:00m:03s", "-")] * 4,
        ("0h:00m:03s", 3),
        ("0h:01m:03s", 15),
    ]


def test_an_event_for_each_change_and_one_message():
    rig = Rig()
    rig.tick()
    rig.model = {**PRINTING, "job": {**JOB, "layer": 23, "filePosition": 310}}
    sent, fired = rig.tick()
    assert [event for event, _ in fired] == [
        "DisplayLayerProgress_layerChanged",
        "DisplayLayerProgress_progressChanged",
    ]
    assert [payload["updateReason"] for _, payload in fired] == ["layerChanged", "progressChanged"]
    assert [payload["updateReason"] for _, payload in sent] == ["layerChanged"]


def test_an_event_does_not_tell_the_name():
    _, fired = Rig().tick()
    assert len(fired) == len(CHANGES)
    assert {payload["currentFilename"] for _, payload in fired} == {"-"}
    assert {frozenset(payload) for _, payload in fired} == {frozenset(MEMBERS)}


def test_nothing_without_a_change_and_at_most_once_a_second():
    rig = Rig()
    rig.tick()
    assert rig.tick() == ([], [])
    # the time alone is no reason
    rig.model = {**PRINTING, "job": {**JOB, "timesLeft": {"slicer": 122}}}
    assert rig.tick() == ([], [])
    counts = []
    for layer in range(30, 38):
        rig.model = {**PRINTING, "job": {**JOB, "layer": layer}}
        counts.append(len(rig.tick(0.25)[0]))
    assert counts == [0, 0, 0, 1, 0, 0, 0, 1]


def test_nothing_while_nothing_is_printed():
    rig = Rig(IDLE)
    assert rig.tick() == ([], [])


@pytest.mark.parametrize(
    "model, streamed, state",
    [
        ({**PRINTING, "state": {"status": "paused"}}, None, "paused"),
        (IDLE, STREAMED._replace(is_paused=True), "paused"),
        (IDLE, STREAMED, "printing"),
    ],
    ids=["card", "streamed paused", "streamed"],
)
def test_printer_state(model, streamed, state):
    assert Rig(model, streamed).payload()["printerState"] == state


@pytest.mark.parametrize("how", ["ended", "switched off"])
def test_last_message_says_that_it_is_over(how):
    rig = Rig()
    rig.tick()
    if how == "ended":
        rig.model = IDLE
    else:
        rig.is_wanted = False
    ((_, payload),), fired = rig.tick()
    assert [event for event, _ in fired] == [
        "DisplayLayerProgress_progressChanged",
        "DisplayLayerProgress_printerStateChanged",
    ]
    names = ("printerState", "progress", "printTimeLeft", "currentLayer")
    assert [payload[name] for name in names] == ["operational", "0", "-", "22"]
    assert rig.tick() == ([], [])


def test_next_print_begins_anew():
    rig = Rig()
    for layer in range(3):
        rig.payload(layer=layer)
    rig.model = IDLE
    rig.tick()
    rig.model = PRINTING
    assert rig.payload(layer=0)["lastLayerDuration"] == "-"


@pytest.mark.parametrize(
    "flag, is_paused", [("paused", True), ("pausing", True), ("printing", False)]
)
def test_octoprints_current_data(flag, is_paused):
    data = {
        "state": {"flags": {flag: True}},
        "progress": {"completion": 12.5, "printTimeLeft": 60},
        "job": {"file": {"path": "a.gcode"}},
    }
    assert streamed_print(data) == StreamedPrint(is_paused, "a.gcode", 12.5, 60)


def test_octoprint_may_not_know_yet():
    data = {
        "state": {"flags": {}},
        "progress": {"completion": None, "printTimeLeft": None},
        "job": {"file": {"path": None}},
    }
    payload = Rig(IDLE, streamed_print(data)).payload()
    names = ("progress", "printTimeLeft", "currentFilename")
    assert [payload[name] for name in names] == ["0", "-", "-"]
