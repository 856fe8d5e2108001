"""Events: what is told between models made by hand, random ones, and those of a whole machine."""

import json
import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.model.merge import patched
from octoprint_rrfmodel.rrf.views.event_facts import Facts, facts_of
from octoprint_rrfmodel.rrf.views.events import EVENTS, NAMES, Chronicle, events_between
from octoprint_rrfmodel.rrf.views.job import progress
from octoprint_rrfmodel.rrf.views.state_words import MONITORS, STATUSES
from octoprint_rrfmodel.rrf.wire.line import find_reply
from octoprint_rrfmodel.rrf.wire.m408 import M408Model
from octoprint_rrfmodel.simulator.board import Board
from tests.support.examples import some
from tests.support.places import ROOT

from ..strategies import ANY_JSON


def told(*models):
    """Return the events between the models, each as its name and payload; texts are lines."""
    chronicle = Chronicle()
    found = []
    for model in models:
        if isinstance(model, str):
            chronicle.heard(model)
        else:
            found += [tuple(event) for event in chronicle.look(model)]
    return found


def state(**members):
    return {"state": members}


def printing(status="processing", position=10, duration=5, layer=None, **members):
    """Return the model of a board with a job, or with what is left of one."""
    file = {"size": 100, "numLayers": 40, "fileName": "0:/gcodes/a.gcode"}
    file.update(members.pop("file", {}))
    job = {"file": file, "filePosition": position, "duration": duration, "layer": layer}
    return {"state": {"status": status, **members}, "job": job}


IDLE = printing("idle", 0, None, file={"size": 0, "numLayers": 0, "fileName": None})
BUSY = printing("busy", 0, None)
STARTED = ("job_started", {})
FINISHED = "Finished printing file 0:/gcodes/a.gcode, print time was 0h 5m"
CANCELLED = "Cancelled printing file 0:/gcodes/a.gcode, print time was 0h 5m"


def changed(old, new):
    return ("status_changed", {"old": old, "new": new})


def finished(cancelled=False, error=False, duration=5):
    return ("job_finished", {"duration": duration, "cancelled": cancelled, "error": error})


def heaters(*states):
    return {"heat": {"heaters": [{"state": word} for word in states]}}


def monitors(*statuses, **members):
    members = {"enableMode": 1, **members}
    return {"sensors": {"filamentMonitors": [{"status": word, **members} for word in statuses]}}


def box(seq=1, mode=2, **members):
    return state(messageBox={"seq": seq, "mode": mode, "title": "secret", "message": "secret"})


def opened(seq=1, mode=2):
    return ("message_box_opened", {"mode": mode, "seq": seq})


def closed(seq=1, mode=2):
    return ("message_box_closed", {"mode": mode, "seq": seq})


NO_BOX = state(messageBox=None)

SEQUENCES = {
    "nothing is known": ([{}, {}], []),
    "what was so before is no news": ([printing(upTime=5, currentTool=1, layer=3)], []),
    "nothing changes": ([printing(), printing()], []),
    # status
    "status": ([state(status="idle"), state(status="busy")], [changed("idle", "busy")]),
    "status that flaps": (
        [state(status="idle"), state(status="busy"), state(status="idle")],
        [changed("idle", "busy"), changed("busy", "idle")],
    ),
    "status that isn't told for a while": (
        [state(status="idle"), {}, {"state": None}, state(status="busy")],
        [changed("idle", "busy")],
    ),
    "status that is no word of the firmware's": (
        [state(status="idle"), state(status="secret"), state(status="<b>"), state(status="idle")],
        [changed("idle", "unknown"), changed("unknown", "idle")],
    ),
    "status that is no text": ([state(status="idle"), state(status=["secret"])], []),
    # reset
    "reset": ([state(upTime=100), {}, state(upTime=1)], [("firmware_reset", {})]),
    "up-time that was spoilt once": ([state(upTime=17), state(upTime=97), state(upTime=19)], []),
    "up-time goes on": ([state(upTime=100), state(upTime=100), state(upTime=101)], []),
    "up-time that is no number": ([state(upTime=100), state(upTime="1"), state(upTime=101)], []),
    "status goes on over a reset": (
        [state(upTime=100, status="busy"), {}, state(upTime=1, status="idle")],
        [("firmware_reset", {}), changed("busy", "idle")],
    ),
    "reset in the middle of a job": (
        [printing(upTime=100), {}, {**IDLE, **state(upTime=1, status="idle")}],
        [("firmware_reset", {}), changed("processing", "idle"), finished(True, True)],
    ),
    # tool
    "tool": (
        [state(currentTool=-1), state(currentTool=3), state(currentTool=-1)],
        [("tool_changed", {"old": -1, "new": 3}), ("tool_changed", {"old": 3, "new": -1})],
    ),
    "tool that is no number": (
        [state(currentTool=1), state(currentTool="secret"), state(currentTool=True)],
        [],
    ),
    # boxes
    "box opens and closes": ([NO_BOX, box(), box(), NO_BOX], [opened(), closed()]),
    "box that is open from the beginning": ([box()], [opened()]),
    "box after another": ([box(1), box(2, mode=3)], [opened(), closed(), opened(2, 3)]),
    "box that isn't told of for a while": (
        [box(), {}, state(status="busy"), NO_BOX],
        [opened(), closed()],
    ),
    "same number after a reset is another box": (
        [state(upTime=9, **box()["state"]), {}, state(upTime=1, **box()["state"])],
        [opened(), ("firmware_reset", {}), closed(), opened()],
    ),
    "box without numbers": (
        [state(messageBox={"seq": "secret", "mode": 1.5}), NO_BOX],
        [opened(None, None), closed(None, None)],
    ),
    # heaters
    "fault": (
        [heaters("active", "active"), heaters("active", "fault")],
        [("heater_fault", {"heater": 1})],
    ),
    "fault from the beginning": ([heaters("fault")], [("heater_fault", {"heater": 0})]),
    "fault is told once": (
        [heaters("fault"), heaters("fault"), {}, heaters("fault")],
        [("heater_fault", {"heater": 0})],
    ),
    "fault that comes again": (
        [heaters("fault"), heaters("off"), heaters("fault")],
        [("heater_fault", {"heater": 0})] * 2,
    ),
    "fault that comes again with a reset": (
        [{**heaters("fault"), **state(upTime=9)}, {}, {**heaters("fault"), **state(upTime=1)}],
        [("heater_fault", {"heater": 0}), ("firmware_reset", {}), ("heater_fault", {"heater": 0})],
    ),
    "state that isn't told is no repair": (
        [heaters("fault"), {"heat": {"heaters": [{}]}}, heaters("fault")],
        [("heater_fault", {"heater": 0})],
    ),
    # filament
    "filament": (
        [monitors("ok", "ok"), monitors("ok", "noFilament"), monitors("ok", "ok")],
        [("filament_error", {"extruder": 1, "status": "noFilament"})],
    ),
    "filament error from the beginning": ([monitors("noFilament"), monitors("noFilament")], []),
    "another filament error": (
        [monitors("ok"), monitors("noFilament"), monitors("sensorError")],
        [
            ("filament_error", {"extruder": 0, "status": "noFilament"}),
            ("filament_error", {"extruder": 0, "status": "sensorError"}),
        ],
    ),
    "filament error of a monitor that is off": (
        [monitors("ok", enableMode=0), monitors("noFilament", enableMode=0)],
        [],
    ),
    "filament error by an older firmware": (
        [monitors("ok", enableMode=True), monitors("tooLittleMovement", enableMode=True)],
        [("filament_error", {"extruder": 0, "status": "tooLittleMovement"})],
    ),
    "filament error in a word that isn't known": (
        [monitors("ok"), monitors("secret")],
        [("filament_error", {"extruder": 0, "status": "unknown"})],
    ),
    "no data yet is no filament error": ([monitors("ok"), monitors("noDataReceived")], []),
    # layers
    "layers": (
        [printing(layer=None), printing(layer=1), printing(layer=1), printing(layer=3)],
        [
            ("layer_changed", {"layer": 1, "total": 40}),
            ("layer_changed", {"layer": 3, "total": 40}),
        ],
    ),
    "layers of a file that tells no number": (
        [printing(layer=1), printing(layer=2, file={"numLayers": 0})],
        [("layer_changed", {"layer": 2, "total": None})],
    ),
    "layer of a job that goes on at the connection": ([printing(layer=7)], []),
    "layer that is none": ([printing(layer=1), printing(layer="secret"), printing(layer=0)], []),
    # jobs
    "job begins": ([IDLE, printing()], [changed("idle", "processing"), STARTED]),
    "job that goes on at the connection": (
        [printing(), FINISHED, IDLE],
        [changed("processing", "idle"), finished()],
    ),
    "job ends in the firmware's words": (
        [IDLE, printing(position=50), FINISHED, BUSY, IDLE],
        [
            changed("idle", "processing"),
            STARTED,
            changed("processing", "busy"),
            finished(),
            changed("busy", "idle"),
        ],
    ),
    "job is cancelled in the firmware's words": (
        [printing(position=100), CANCELLED, IDLE],
        [changed("processing", "idle"), finished(cancelled=True)],
    ),
    "job ends without a word": (
        [printing(position=99), IDLE],
        [changed("processing", "idle"), finished()],
    ),
    "job stops without a word": (
        [printing(position=98), IDLE],
        [changed("processing", "idle"), finished(cancelled=True, error=True)],
    ),
    "job is cancelling": (
        [printing(position=100), printing("cancelling"), IDLE],
        [
            changed("processing", "cancelling"),
            changed("cancelling", "idle"),
            finished(cancelled=True),
        ],
    ),
    "paused, busy, idle": (
        [printing("paused", 100), BUSY, IDLE],
        [changed("paused", "busy"), finished(cancelled=True), changed("busy", "idle")],
    ),
    "paused, resumed, done": (
        [printing("paused"), printing("resuming"), printing(position=100, duration=9), IDLE],
        [
            changed("paused", "resuming"),
            changed("resuming", "processing"),
            changed("processing", "idle"),
            finished(duration=9),
        ],
    ),
    "emergency stop": (
        [printing(position=100), printing("halted", 100)],
        [changed("processing", "halted"), finished(cancelled=True, error=True)],
    ),
    "emergency stop while paused": (
        [printing("paused"), printing("halted")],
        [changed("paused", "halted"), finished(cancelled=True, error=True)],
    ),
    "no motor supply is no end": (
        [printing(), printing("off"), printing("paused")],
        [changed("processing", "off"), changed("off", "paused")],
    ),
    "word that isn't known is no end": (
        [printing(), printing("secret"), printing()],
        [changed("processing", "unknown"), changed("unknown", "processing")],
    ),
    "simulation is no job": (
        [IDLE, printing("simulating"), IDLE],
        [changed("idle", "simulating"), changed("simulating", "idle")],
    ),
    "duration that was told last": (
        [printing(duration=7), printing(duration=None, position=100), IDLE],
        [changed("processing", "idle"), finished(duration=7)],
    ),
    "duration that is no number": (
        [printing(duration="secret", position=100), IDLE],
        [changed("processing", "idle"), finished(duration=None)],
    ),
    "one job follows the other between two models": (
        [printing(duration=80), FINISHED, printing(duration=1)],
        [finished(duration=80), STARTED],
    ),
    "another file between two models": (
        [printing(duration=80), printing(duration=1, file={"fileName": "b"})],
        [finished(True, True, duration=80), STARTED],
    ),
    "broken digit is no other job": ([printing(duration=80), printing(duration=8)], []),
    "file that is told late is no other job": (
        [IDLE, printing(duration=0, file={"fileName": "old"}), printing(duration=1)],
        [changed("idle", "processing"), STARTED],
    ),
    "words about the job before": (
        [FINISHED, IDLE, FINISHED, printing(position=5), IDLE],
        [
            changed("idle", "processing"),
            STARTED,
            changed("processing", "idle"),
            finished(True, True),
        ],
    ),
}


@pytest.mark.parametrize(("models", "events"), SEQUENCES.values(), ids=SEQUENCES.keys())
def test_sequence(models, events):
    assert told(*models) == events


def test_table():
    names = [row.name for row in EVENTS]
    assert len(set(names)) == len(names)
    assert set(NAMES) == {
        "model_ready",
        "message_box_unanswerable",
        "firmware_reset",
        "status_changed",
        "tool_changed",
        "message_box_opened",
        "message_box_closed",
        "heater_fault",
        "filament_error",
        "layer_changed",
        "job_started",
        "job_finished",
    }


def test_new_connection_begins_anew():
    assert told(box(), box()) == [opened()]
    assert told(box()) == [opened()], "nothing is kept beyond the chronicle"


##~~ firmware without M409


def m408(letter, **members):
    return {"status": letter, **members}


def test_job_without_m409():
    collected = M408Model()
    models = [
        collected.take(fields)
        for fields in (
            m408("I", fractionPrinted=0.0, currentLayer=0, printDuration=0.0),
            m408("P", fractionPrinted=0.5, currentLayer=1, printDuration=3.0),
            m408("P", fractionPrinted=99.5, currentLayer=36, printDuration=528.9),
            m408("I"),
        )
    ]
    assert told(*models) == [
        changed("idle", "processing"),
        STARTED,
        ("layer_changed", {"layer": 1, "total": None}),
        ("layer_changed", {"layer": 36, "total": None}),
        changed("processing", "idle"),
        finished(duration=528.9),
    ]


PROGRESS = [
    ({"job": {"file": {"size": 200}, "filePosition": 50}}, 0.25),
    ({"job": {"file": {"size": 200}, "filePosition": 500}}, 1.0),
    ({"job": {"file": {"size": 0}, "filePosition": 0}}, None),
    ({"job": {"file": {"size": 10**400}, "filePosition": 1}}, None),
    ({"m408": {"fractionPrinted": 28.2}}, 0.282),
    ({"m408": {"fraction_printed": 0.25}}, 0.25),
    ({"m408": {"fractionPrinted": -1.0}}, 0.0),
    ({"m408": {"fractionPrinted": "1"}}, None),
    ({}, None),
]


@pytest.mark.parametrize(("model", "part"), PROGRESS)
def test_progress(model, part):
    assert progress(model) == (part if part is None else pytest.approx(part))


##~~ anything

WORDS = st.one_of(st.sampled_from([*STATUSES, *MONITORS, "fault", "secret"]), ANY_JSON)

MODELS = st.one_of(
    st.fixed_dictionaries(
        {},
        optional={
            "state": st.fixed_dictionaries(
                {},
                optional={
                    "status": WORDS,
                    "upTime": st.one_of(st.integers(0, 5), ANY_JSON),
                    "currentTool": st.one_of(st.integers(-1, 3), ANY_JSON),
                    "messageBox": st.one_of(
                        st.none(), st.fixed_dictionaries({"seq": st.integers(1, 2)}), ANY_JSON
                    ),
                },
            ),
            "heat": st.fixed_dictionaries(
                {"heaters": st.lists(st.one_of(st.fixed_dictionaries({"state": WORDS}), ANY_JSON))}
            ),
            "sensors": st.fixed_dictionaries(
                {
                    "filamentMonitors": st.lists(
                        st.fixed_dictionaries({"status": WORDS, "enableMode": st.integers(0, 2)})
                    )
                }
            ),
            "job": st.one_of(
                st.fixed_dictionaries(
                    {},
                    optional={
                        "layer": st.one_of(st.integers(0, 3), ANY_JSON),
                        "duration": st.one_of(st.integers(0, 9), ANY_JSON),
                        "filePosition": st.one_of(st.integers(0, 9), ANY_JSON),
                        "file": st.one_of(
                            st.fixed_dictionaries({"size": st.just(9), "fileName": WORDS}),
                            ANY_JSON,
                        ),
                    },
                ),
                ANY_JSON,
            ),
        },
    ),
    st.dictionaries(st.sampled_from(["state", "heat", "sensors", "job"]), ANY_JSON),
)

HARMLESS = {*STATUSES, *MONITORS, "unknown"}


@settings(max_examples=some(60))
@given(st.lists(st.one_of(MODELS, st.sampled_from([FINISHED, CANCELLED, ""])), max_size=6))
def test_payloads_hold_numbers_and_known_words_alone(sequence):
    names = []
    for name, payload in told(*sequence):
        names.append(name)
        json.dumps(payload, allow_nan=False)
        assert all(isinstance(key, str) for key in payload)
        for value in payload.values():
            assert value is None or type(value) in (bool, int, float) or value in HARMLESS
    assert set(names) <= set(NAMES)
    # nothing ends more often than it has begun, but for what was there at the connection
    for ends, begins in (
        ("job_finished", "job_started"),
        ("message_box_closed", "message_box_opened"),
    ):
        assert names.count(ends) - names.count(begins) <= (ends == "job_finished")


@settings(max_examples=some(30))
@given(st.lists(MODELS, max_size=4))
def test_same_model_again_is_no_news(sequence):
    facts = Facts()
    for model in sequence:
        facts = facts_of(model, facts)
        again = facts_of(model, facts)
        assert [
            event for event in events_between(facts, again) if event.name != "firmware_reset"
        ] == []


@settings(max_examples=some(30))
@given(st.lists(MODELS, max_size=5))
def test_changes_follow_one_another(sequence):
    last = {}
    for name, payload in told(*sequence):
        if name in ("status_changed", "tool_changed"):
            assert payload["old"] != payload["new"]
            assert last.get(name, payload["old"]) == payload["old"]
            last[name] = payload["new"]


##~~ a machine


class Followed:
    """A simulated board that is polled over its serial line, and the chronicle of it."""

    def __init__(self, machine="cartesian", firmware="3.5.3"):
        self.time = 0.0
        self.board = Board(machine, firmware, clock=lambda: self.time)
        self.follower = Follower()
        self.chronicle = Chronicle()
        self.events = []

    def hear(self, text):
        """Return the reply in what came; the other lines go into the chronicle."""
        reply = None
        for line in text.splitlines():
            found = find_reply(line)
            if found is None:
                self.chronicle.heard(line)
            else:
                reply = found.reply
        return reply

    def poll(self):
        """Ask what is due now, and take the answer."""
        self.hear(self.board.transmit().decode())
        # a busy channel answers nothing, and nobody asks then
        if not self.board.channels["USB"].is_idle:
            return
        self.board.receive(f"{self.follower.next_request().line}\n".encode())
        reply = self.hear(self.board.transmit().decode())
        if reply is None:
            self.follower.not_supported()
        else:
            self.follower.take(reply)
        self.events += [tuple(event) for event in self.chronicle.look(self.follower.store.model)]

    def connect(self):
        """Fetch the whole model; return what is told of it."""
        for _ in range(60):
            self.poll()
            if self.follower.ready and not self.follower.behind:
                return self.told()
        raise AssertionError("never ready")

    def do(self, *lines):
        """Send lines as somebody at the machine would."""
        for line in lines:
            self.board.execute(line)
        self.go(2)

    def go(self, seconds):
        """Let time pass, polling twice a second."""
        for _ in range(int(seconds * 2)):
            self.time += 0.5
            self.poll()

    def until(self, condition, most=2000):
        end = self.time + most
        while not condition(self.board.model):
            assert self.time < end, "that never happened"
            self.go(1)
        self.go(4)

    def told(self):
        """Return what was told since the last call."""
        events, self.events = self.events, []
        return events


def is_idle(model):
    return model["state"]["status"] == "idle"


FIRMWARES = pytest.mark.parametrize(
    "firmware", ["2.05", "3.3", "3.4", "3.5.1", "3.5.3", "3.6", "3.7"]
)


@FIRMWARES
def test_machine_that_does_nothing(firmware):
    machine = Followed("delta", firmware)
    assert machine.connect() == []
    machine.go(30)
    assert machine.told() == []


@FIRMWARES
def test_print_from_beginning_to_end(firmware):
    machine = Followed("delta", firmware)
    machine.connect()
    machine.do('M32 "square.gcode"')
    machine.until(is_idle)
    events = machine.told()
    assert events[:2] == [changed("idle", "processing"), STARTED]
    # a layer that is over before the next poll isn't seen
    layers = [payload["layer"] for name, payload in events if name == "layer_changed"]
    assert len(layers) > 5
    assert layers == sorted(set(layers))
    assert layers[-1] == 40
    ends = [payload for name, payload in events if name == "job_finished"]
    assert len(ends) == 1
    assert (ends[0]["cancelled"], ends[0]["error"]) == (False, False)
    assert ends[0]["duration"] > 60
    names = [name for name, _ in events]
    assert names.count("job_started") == 1
    assert "firmware_reset" not in names


@FIRMWARES
def test_print_that_is_cancelled(firmware):
    machine = Followed("delta", firmware)
    machine.connect()
    machine.do('M32 "square.gcode"')
    machine.go(95)
    machine.do("M25")
    machine.until(lambda model: model["state"]["status"] == "paused")
    machine.do("M0")
    machine.until(is_idle)
    events = machine.told()
    assert events.count(STARTED) == 1
    ends = [payload for name, payload in events if name == "job_finished"]
    assert [(end["cancelled"], end["error"]) for end in ends] == [(True, False)]
    words = [payload["new"] for name, payload in events if name == "status_changed"]
    assert "paused" in words
    assert words[-1] == "idle"


@pytest.mark.parametrize("firmware", ["3.3", "3.4", "3.5.3", "3.6", "3.7"])
def test_emergency_stop_and_reset(firmware):
    machine = Followed("cartesian", firmware)
    machine.connect()
    machine.do('M32 "square.gcode"')
    machine.go(100)
    assert STARTED in machine.told()
    machine.board.inject("halted")
    machine.go(5)
    ended, *_ = [event for event in machine.told() if event[0] == "job_finished"]
    assert (ended[1]["cancelled"], ended[1]["error"]) == (True, True)
    machine.board.inject("reset")
    machine.go(10)
    names = [name for name, _ in machine.told()]
    assert names[0] == "firmware_reset"
    assert names.count("firmware_reset") == 1
    assert "job_finished" not in names


def test_reset_in_the_middle_of_a_print():
    machine = Followed()
    machine.connect()
    machine.do('M32 "square.gcode"')
    machine.go(100)
    machine.told()
    machine.board.inject("reset")
    machine.go(10)
    events = machine.told()
    assert events[0] == ("firmware_reset", {})
    ends = [payload for name, payload in events if name == "job_finished"]
    assert [(end["cancelled"], end["error"]) for end in ends] == [(True, True)]
    assert changed("processing", "idle") in events


FAULTS = {
    "heater_fault:1": ("heater_fault", {"heater": 1}),
    "filament_error": ("filament_error", {"extruder": 0, "status": "tooLittleMovement"}),
    "message_box:2": ("message_box_opened", {"mode": 2, "seq": 1}),
}


@pytest.mark.parametrize(("fault", "event"), FAULTS.items())
def test_incident(fault, event):
    machine = Followed()
    machine.connect()
    machine.board.inject(fault)
    machine.go(5)
    events = machine.told()
    assert events.count(event) == 1
    assert [name for name, _ in events].count(event[0]) == 1
    machine.board.clear(fault.partition(":")[0])
    machine.go(5)
    names = [name for name, _ in machine.told()]
    assert event[0] not in names
    assert ("message_box_closed" in names) is (event[0] == "message_box_opened")


def test_what_was_open_before_the_connection():
    machine = Followed()
    machine.board.inject("message_box:3")
    machine.board.inject("heater_fault:0")
    names = {name for name, _ in machine.connect()}
    assert names == {"heater_fault", "message_box_opened"}


def test_tools():
    machine = Followed("toolchanger")
    machine.connect()
    machine.do("G28")
    machine.until(is_idle)
    machine.told()
    machine.do("T3")
    machine.until(lambda model: model["state"]["currentTool"] == 3)
    machine.do("T-1")
    machine.until(lambda model: model["state"]["currentTool"] == -1)
    changes = [payload for name, payload in machine.told() if name == "tool_changed"]
    assert changes == [{"old": -1, "new": 3}, {"old": 3, "new": -1}]


def test_recorded_print_that_is_cancelled(shared_dir):
    lines = (shared_dir / "captures" / "om345_mb6hc_sbc_job_session.jsonl").read_text("utf-8")
    model, models = {}, []
    for line in lines.splitlines():
        model = patched(model, json.loads(line))[0]
        models.append(model)
    events = [event for event in told(*models) if event[0] != "layer_changed"]
    assert events == [
        changed("idle", "processing"),
        STARTED,
        changed("processing", "paused"),
        changed("paused", "busy"),
        finished(cancelled=True, duration=20),
        changed("busy", "idle"),
    ]


##~~ the reference

REFERENCE = ROOT / "docs" / "events.md"
ROW = re.compile(r"^\| `(\w+)` \|([^|]*)\|", re.MULTILINE)


def test_reference_has_each_event_with_its_payload():
    table = REFERENCE.read_text(encoding="utf-8").partition("## Jobs")[0]
    listed = {name: re.findall(r"`(\w+)`", cell) for name, cell in ROW.findall(table)}
    assert tuple(listed) == NAMES
    # every event but the first two was told by one of the sequences above
    payloads = {name: list(payload) for _, events in SEQUENCES.values() for name, payload in events}
    assert listed == {"model_ready": [], "message_box_unanswerable": [], **payloads}
