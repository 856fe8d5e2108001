"""Metrics as Prometheus reads them: each row's value, every machine, every recording."""

from __future__ import annotations

import copy
import json
import math
import re

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from prometheus_client.parser import text_string_to_metric_families

from octoprint_rrfmodel.rrf.metrics import METRICS, exposition
from octoprint_rrfmodel.rrf.metrics.plugin import BLOCKED
from octoprint_rrfmodel.rrf.model.merge import patched
from octoprint_rrfmodel.rrf.views.state_words import (
    BOARDS,
    HEATERS,
    SPINDLES,
    STATUSES,
    TOOLS,
    UNKNOWN,
)
from octoprint_rrfmodel.rrf.views.state_words import MONITORS as MONITOR_WORDS
from octoprint_rrfmodel.rrf.wire.m408 import M408Model
from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.firmware import VERSIONS
from octoprint_rrfmodel.simulator.machines import MACHINES
from tests.support.examples import some
from tests.support.places import ROOT

from ..strategies import ANY_JSON

STATUS = {
    "version": "0.1.0",
    "connected": True,
    "is_rrf": True,
    "protocol": "M409",
    "firmware": {"name": "RRF", "version": "3.5.3", "electronics": "Mini", "date": "2024"},
    "ready": True,
    "stale": False,
    "blocked": "streaming",
    "age": 0.4,
    "ages": {"heat": 0.5},
    "revision": 1234,
    "resets": 2,
    "counters": {
        "polls": 10,
        "replies": 9,
        "bytes": 4000,
        "malformed": 1,
        "out_of_buffers": 3,
        "timeouts": 4,
        "rewritten": 5,
    },
    "warnings": [{"code": "off", "text": "x"}, {"code": "heater_fault_1", "text": "y"}],
}


def families(model, status=STATUS):
    """Return what Prometheus' own parser makes of it, by the name of the table's row."""
    found = {}
    for family in text_string_to_metric_families(exposition(model, status)):
        name = family.name + ("_total" if family.type == "counter" else "")
        assert name not in found
        found[name] = family
    return found


def values(model, status=STATUS):
    """Return row → labels → value."""
    return {
        name: {tuple(sample.labels.values()): sample.value for sample in family.samples}
        for name, family in families(model, status).items()
    }


def check(model, status=STATUS):
    """Assert what holds for each text: every row is there, nothing else, no value is strange."""
    found = families(model, status)
    assert list(found) == [metric.name for metric in METRICS]
    for metric in METRICS:
        family = found[metric.name]
        assert (family.documentation, family.type) == (metric.help, metric.kind)
        seen = set()
        for sample in family.samples:
            assert tuple(sample.labels) == metric.labels
            assert math.isfinite(sample.value)
            labels = tuple(sample.labels.values())
            assert labels not in seen
            seen.add(labels)
    return found


##~~ the table


@pytest.mark.parametrize("metric", METRICS, ids=lambda metric: metric.name)
def test_row_keeps_to_the_rules_for_names(metric):
    assert re.fullmatch(r"rrf_[a-z0-9]+(_[a-z0-9]+)*", metric.name)
    assert metric.kind == ("counter" if metric.name.endswith("_total") else "gauge")
    assert all(re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", label) for label in metric.labels)
    assert len(set(metric.labels)) == len(metric.labels)
    assert metric.help.endswith(".")
    assert "\n" not in metric.help
    assert "\\" not in metric.help


def test_no_row_comes_twice():
    assert len({metric.name for metric in METRICS}) == len(METRICS)


##~~ one value for each row


class Machine:
    """A simulated board and the time that passes for it."""

    def __init__(self, machine, firmware="3.5.3", **options):
        self.time = 0.0
        self.board = Board(machine, firmware, clock=lambda: self.time, **options)

    def send(self, *lines):
        self.board.receive("".join(f"{line}\n" for line in lines).encode())

    def until(self, condition, most=3600):
        end = self.time + most
        while not condition(self.board.model):
            assert self.time < end, "that never happened"
            self.time += 0.5
            self.board.transmit()


@pytest.fixture(scope="module")
def models():
    """The models that the values below are read from, each with what is needed for its rows."""
    printer = Machine("cartesian")
    printer.send("G28", "M106 P0 S0.5", "M220 S110", "M221 D0 S95", "M290 S0.02")
    printer.send('M32 "square.gcode"')
    printer.until(lambda model: (model["job"]["layer"] or 0) >= 3)
    after = Machine("cartesian", speed=20.0)
    after.send('M32 "square.gcode"')
    after.until(lambda model: model["job"]["lastDuration"])
    changer = Machine("toolchanger")
    changer.send("G28", "T3", "M568 P3 S205 R150 A1")
    changer.until(lambda model: model["heat"]["heaters"][2]["standby"] == 150)
    router = Machine("cnc")
    router.send("M3 P0 S12000")
    made = {
        "printer": printer.board,
        "after": after.board,
        "toolchanger": changer.board,
        "cnc": router.board,
    }
    models = {name: json.loads(json.dumps(board.model)) for name, board in made.items()}
    # what no simulated machine tells
    move = models["toolchanger"]["move"]
    move["compensation"]["meshDeviation"] = {"mean": -0.012, "deviation": 0.034}
    models["toolchanger"]["network"]["interfaces"] = [
        {"type": "wifi", "signal": None, "rssi": -61},
        {"type": "ethernet", "signal": None},
    ]
    analog = models["toolchanger"]["sensors"]["analog"]
    analog += [None] * (9 - len(analog)) + [{"type": "dhthumidity", "lastReading": 38.0}]
    models["toolchanger"]["boards"][2]["drivers"] = [{"status": 1 << 1}, {"status": 1 << 8}]
    return models


def at(*steps):
    """Return what looks a number up, for one that depends on the simulation."""

    def look(model):
        for step in steps:
            model = model[step]
        return model

    return look


HEATED = 205.0

# row: machine, labels' values, value
EXPECTED = {
    "rrf_info": (
        "printer",
        ("0.1.0", "M409", "RRF", "3.5.3", "2024", "Mini"),
        1,
    ),
    "rrf_connected": ("printer", (), 1),
    "rrf_ready": ("printer", (), 1),
    "rrf_stale": ("printer", (), 0),
    "rrf_blocked": ("printer", ("streaming",), 1),
    "rrf_age_seconds": ("printer", (), 0.4),
    "rrf_key_age_seconds": ("printer", ("heat",), 0.5),
    "rrf_warnings": ("printer", (), 2),
    "rrf_warning": ("printer", ("heater_fault_1",), 1),
    "rrf_revisions_total": ("printer", (), 1234),
    "rrf_resets_total": ("printer", (), 2),
    "rrf_polls_total": ("printer", (), 10),
    "rrf_replies_total": ("printer", (), 9),
    "rrf_reply_bytes_total": ("printer", (), 4000),
    "rrf_malformed_replies_total": ("printer", (), 1),
    "rrf_out_of_buffers_total": ("printer", (), 3),
    "rrf_timeouts_total": ("printer", (), 4),
    "rrf_rewritten_commands_total": ("printer", (), 5),
    "rrf_status": ("printer", ("processing",), 1),
    "rrf_up_time_seconds": (
        "printer",
        (),
        lambda model: model["state"]["upTime"] + model["state"]["msUpTime"] / 1000,
    ),
    "rrf_message_box_open": ("printer", (), 0),
    "rrf_current_tool": ("toolchanger", (), 3),
    "rrf_atx_power": ("printer", (), 1),
    "rrf_tool_info": ("toolchanger", ("10", "Prüfkopf"), 1),
    "rrf_tool_state": ("toolchanger", ("3", "standby"), 1),
    "rrf_spindle_state": ("cnc", ("0", "forward"), 1),
    "rrf_spindle_speed_rpm": ("cnc", ("0",), 12000),
    "rrf_spindle_active_rpm": ("cnc", ("0",), 12000),
    "rrf_filament_monitor_enabled": ("printer", ("0",), 1),
    "rrf_filament_monitor_state": ("printer", ("0", "ok"), 1),
    "rrf_filament_error": ("printer", ("0",), 0),
    "rrf_heater_info": ("toolchanger", ("3", "tool", "7"), 1),
    "rrf_heater_temperature_celsius": ("printer", ("1",), HEATED),
    "rrf_heater_target_celsius": ("printer", ("1",), HEATED),
    "rrf_heater_active_celsius": ("toolchanger", ("2",), HEATED),
    "rrf_heater_standby_celsius": ("toolchanger", ("2",), 150),
    "rrf_heater_state": ("printer", ("1", "active"), 1),
    "rrf_heater_fault": ("printer", ("1",), 0),
    "rrf_heater_pwm_ratio": ("printer", ("1",), at("heat", "heaters", 1, "avgPwm")),
    "rrf_sensor_info": ("printer", ("3", "mcu", "mcutemp"), 1),
    "rrf_sensor_temperature_celsius": ("printer", ("1",), HEATED),
    "rrf_sensor_reading": ("toolchanger", ("9", "%"), 38.0),
    "rrf_sensor_ok": ("printer", ("1",), 1),
    "rrf_fan_info": ("printer", ("1", "Hotend"), 1),
    "rrf_fan_requested_ratio": ("printer", ("0",), 0.5),
    "rrf_fan_actual_ratio": ("printer", ("0",), 0.5),
    "rrf_fan_speed_rpm": ("printer", ("1",), at("fans", 1, "rpm")),
    "rrf_axis_position_millimeters": ("printer", ("X",), at("move", "axes", 0, "machinePosition")),
    "rrf_axis_user_position_millimeters": (
        "printer",
        ("Z",),
        at("move", "axes", 2, "userPosition"),
    ),
    "rrf_axis_homed": ("toolchanger", ("C",), 1),
    "rrf_axis_babystep_millimeters": ("printer", ("Z",), 0.02),
    "rrf_axis_min_millimeters": ("toolchanger", ("C",), -45),
    "rrf_axis_max_millimeters": ("printer", ("X",), 235),
    "rrf_extruder_position_millimeters": (
        "printer",
        ("0",),
        at("move", "extruders", 0, "position"),
    ),
    "rrf_extruder_factor_ratio": ("printer", ("0",), 0.95),
    "rrf_extruder_pressure_advance_seconds": ("printer", ("0",), 0.045),
    "rrf_speed_factor_ratio": ("printer", (), 1.1),
    "rrf_move_requested_speed_millimeters_per_second": (
        "printer",
        (),
        at("move", "currentMove", "requestedSpeed"),
    ),
    "rrf_move_top_speed_millimeters_per_second": (
        "printer",
        (),
        at("move", "currentMove", "topSpeed"),
    ),
    "rrf_move_extrusion_rate_millimeters_per_second": (
        "printer",
        (),
        at("move", "currentMove", "extrusionRate"),
    ),
    "rrf_mesh_deviation_mean_millimeters": ("toolchanger", (), -0.012),
    "rrf_mesh_deviation_rms_millimeters": ("toolchanger", (), 0.034),
    "rrf_job_progress_ratio": (
        "printer",
        (),
        lambda model: model["job"]["filePosition"] / model["job"]["file"]["size"],
    ),
    "rrf_job_file_size_bytes": ("printer", (), at("job", "file", "size")),
    "rrf_job_file_position_bytes": ("printer", (), at("job", "filePosition")),
    "rrf_job_layer": ("printer", (), at("job", "layer")),
    "rrf_job_layers": ("printer", (), 40),
    "rrf_job_duration_seconds": ("printer", (), at("job", "duration")),
    "rrf_job_pause_duration_seconds": ("printer", (), 0),
    "rrf_job_warm_up_duration_seconds": ("printer", (), at("job", "warmUpDuration")),
    "rrf_job_layer_time_seconds": ("printer", (), at("job", "layerTime")),
    "rrf_job_time_left_seconds": ("printer", ("slicer",), at("job", "timesLeft", "slicer")),
    "rrf_job_raw_extrusion_millimeters": ("printer", (), at("job", "rawExtrusion")),
    "rrf_job_last_duration_seconds": ("after", (), at("job", "lastDuration")),
    "rrf_board_info": (
        "toolchanger",
        ("20", "Duet 3 Expansion TOOL1LC", "TOOL1LC", "", "3.5.3", "2024-09-30 15:47:52"),
        1,
    ),
    "rrf_board_state": ("toolchanger", ("23", "running"), 1),
    "rrf_board_mcu_temperature_celsius": ("toolchanger", ("20",), 41.3),
    "rrf_board_vin_volts": ("toolchanger", ("20",), 23.9),
    "rrf_board_vin_min_volts": ("printer", ("0",), 23.8),
    "rrf_board_vin_max_volts": ("printer", ("0",), 24.3),
    "rrf_board_v12_volts": ("toolchanger", ("0",), at("boards", 0, "v12", "current")),
    "rrf_board_free_memory_bytes": ("toolchanger", ("20",), 3884),
    "rrf_board_drivers": ("toolchanger", ("21", "error"), 1),
    "rrf_volume_info": ("printer", ("0", "0:/"), 1),
    "rrf_volume_mounted": ("printer", ("1",), 0),
    "rrf_volume_size_bytes": ("printer", ("0",), 15931539456),
    "rrf_volume_free_bytes": ("printer", ("0",), at("volumes", 0, "freeSpace")),
    "rrf_network_info": ("toolchanger", ("0", "wifi"), 1),
    "rrf_network_signal_dbm": ("toolchanger", ("0",), -61),
}


@pytest.mark.parametrize("metric", METRICS, ids=lambda metric: metric.name)
def test_value_of_a_row(models, metric):
    machine, labels, expected = EXPECTED[metric.name]
    model = models[machine]
    wanted = expected(model) if callable(expected) else expected
    assert wanted is not None
    assert values(model)[metric.name][labels] == pytest.approx(wanted, abs=1e-9)


def test_every_expectation_has_a_row():
    assert list(EXPECTED) == [metric.name for metric in METRICS]


##~~ every machine, every firmware, every recording


@pytest.mark.parametrize("firmware", VERSIONS)
@pytest.mark.parametrize("machine", MACHINES)
def test_machine(machine, firmware):
    board = Board(machine, firmware, clock=lambda: 0.0)
    found = check(board.model)
    assert found["rrf_status"].samples
    assert found["rrf_axis_homed"].samples
    assert bool(found["rrf_heater_temperature_celsius"].samples) is (machine != "cnc")


@pytest.mark.parametrize("form", [0, 1, 2, 3, 4, 5])
def test_machine_without_m409(form):
    machine = Machine("delta", "2.05")
    machine.send(f"M408 S{form}")
    reply = machine.board.transmit().decode().partition("\n")[0]
    found = check(M408Model().take(json.loads(reply)))
    rows = {name for name, family in found.items() if family.samples}
    told = {"rrf_board_info"} if form == 5 else {"rrf_status", "rrf_heater_state"}
    assert told <= rows
    assert "rrf_job_layer" not in rows


def test_recordings(shared_dir):
    checked = []
    for path in sorted((shared_dir / "captures").glob("*.json*")):
        lines = path.read_text(encoding="utf-8")
        if path.suffix == ".jsonl":
            first, *patches = map(json.loads, lines.splitlines())
            for number, patch in enumerate(patches):
                first = patched(first, patch)[0]
                if number % 10 == 0:
                    check(first)
        else:
            try:
                first = json.loads(lines)
            except ValueError:
                continue  # one is spoilt on purpose
        if "heaters" in first or "status" in first:
            first = M408Model().take(first)
        check(first.get("result", first))
        checked.append(path.name)
    assert len(checked) > 25


PRINTING_408 = {
    "status": "P",
    "coords": {"axesHomed": [1, 1, 1], "xyz": [1.5, 2.5, 3.5], "machine": [1.5, 2.5, 3.5]},
    "axisNames": "XYZ",
    "temps": {"current": [60.5, 205.5, 2000.0], "state": [2, 2, 0], "bed": {"heater": 0}},
    "currentLayer": 36,
    "fractionPrinted": 28.2,
    "printDuration": 528.9,
    "timesLeft": {"file": 626.4, "filament": 421.7, "layer": 452.0},
}


def test_print_without_m409():
    found = values(M408Model().take(PRINTING_408))
    assert found["rrf_job_progress_ratio"] == {(): 0.282}
    assert found["rrf_job_layer"] == {(): 36}
    assert found["rrf_job_time_left_seconds"] == {
        ("file",): 626.4,
        ("filament",): 421.7,
        ("layer",): 452.0,
    }
    # the third isn't there
    assert found["rrf_heater_temperature_celsius"] == {("0",): 60.5, ("1",): 205.5}


def test_what_m408_goes_on_telling_of_a_job_that_is_over_is_left_out():
    collected = M408Model()
    collected.take(PRINTING_408)
    found = values(collected.take({"status": "I"}))
    jobs = [name for name in found if name.startswith("rrf_job_")]
    assert jobs
    assert [name for name in jobs if found[name]] == []


##~~ what is left out, what stands for what


def only(name, model, status=STATUS):
    return values(model, status)[name]


@pytest.mark.parametrize("word", [*STATUSES, UNKNOWN])
def test_exactly_one_status_holds(word):
    told = only("rrf_status", {"state": {"status": word}})
    assert [labels for labels, value in told.items() if value] == [(word,)]
    assert len(told) == len(STATUSES) + 1


@pytest.mark.parametrize("word", ["printing", "Idle", "", 'x"} 1\nrrf_evil 1', "\u2028"])
def test_a_word_that_is_none_of_the_firmwares_is_unknown(word):
    told = only("rrf_status", {"state": {"status": word}})
    assert [labels for labels, value in told.items() if value] == [(UNKNOWN,)]


@pytest.mark.parametrize("word", HEATERS)
def test_heater_fault(word):
    model = {"heat": {"heaters": [{"state": word}, None]}}
    assert only("rrf_heater_fault", model) == {("0",): word == "fault"}


TARGETS = [
    ({"state": "active", "active": 60.5, "standby": 40}, 60.5),
    ({"state": "tuning", "active": 60.5, "standby": 40}, 60.5),
    ({"state": "standby", "active": 60.5, "standby": 40}, 40),
    ({"state": "off", "active": 60.5, "standby": 40}, 0),
    ({"state": "fault", "active": 60.5, "standby": 40}, 0),
    ({"state": "active", "active": -273.15}, 0),
    ({"state": "active"}, None),
    ({"active": 60.5}, None),
]


@pytest.mark.parametrize(("heater", "target"), TARGETS)
def test_target(heater, target):
    told = only("rrf_heater_target_celsius", {"heat": {"heaters": [heater]}})
    assert told == ({} if target is None else {("0",): target})


READINGS = [
    ({"lastReading": 30.5}, 30.5, 1),
    ({"lastReading": 0}, 0, 1),
    ({"lastReading": 30.5, "state": "ok"}, 30.5, 1),
    ({"lastReading": 30.5, "state": None}, 30.5, 1),
    ({"lastReading": 30.5, "state": "openCircuit"}, 30.5, 0),
    ({"lastReading": 2000.0}, None, 0),
    ({"lastReading": -273.15}, None, 0),
    ({"lastReading": None}, None, 0),
    ({"name": "a"}, None, None),
    # what is no temperature has no bounds of one
    ({"lastReading": 38.0, "type": "dhthumidity"}, None, 1),
    ({"lastReading": 101325, "type": "bme-pressure"}, None, 1),
    ({"lastReading": None, "type": "linear-analog"}, None, 0),
]


@pytest.mark.parametrize(("sensor", "reading", "works"), READINGS)
def test_sensor(sensor, reading, works):
    told = values({"sensors": {"analog": [None, sensor]}})
    assert told["rrf_sensor_temperature_celsius"].get(("1",)) == reading
    assert told["rrf_sensor_ok"].get(("1",)) == works


MONITORS = [
    ({"status": "ok", "enableMode": 0}, 0, 0),
    ({"status": "noFilament", "enableMode": 2}, 1, 1),
    ({"status": "noDataReceived", "enabled": True}, 1, 0),
    ({"status": "tooLittleMovement", "enabled": False}, 0, 1),
    ({"enableMode": "1"}, None, None),
]


@pytest.mark.parametrize(("monitor", "enabled", "error"), MONITORS)
def test_filament_monitor(monitor, enabled, error):
    told = values({"sensors": {"filamentMonitors": [monitor]}})
    assert told["rrf_filament_monitor_enabled"].get(("0",)) == enabled
    assert told["rrf_filament_error"].get(("0",)) == error


@pytest.mark.parametrize(
    "value", [None, float("nan"), float("inf"), -math.inf, 10**400, "1", [], {}]
)
def test_what_is_no_number_is_left_out(value):
    assert only("rrf_speed_factor_ratio", {"move": {"speedFactor": value}}) == {}


@pytest.mark.parametrize("value", [0, 1, -3, 0.1, 1e-7, 123456789012, 5e-324, 1.7e308, 1e22])
def test_numbers_come_back_as_they_were(value):
    assert only("rrf_speed_factor_ratio", {"move": {"speedFactor": value}}) == {(): value}


def test_newer_firmware_has_some_values_elsewhere():
    model = {
        "move": {
            "speedFactor": 1.0,
            "motionSystems": [{"speedFactor": 0.5}],
            "extruders": [{"pressAdv": {"k0": 0.03}}, {"pressAdv": {"k": 0.04}}, {}],
        }
    }
    assert only("rrf_speed_factor_ratio", model) == {(): 0.5}
    advances = only("rrf_extruder_pressure_advance_seconds", model)
    assert advances == {("0",): 0.03, ("1",): 0.04}


def test_heaters_are_told_apart_by_what_they_heat():
    heat = {"heaters": [{}, {"a": 1}, {"a": 1}, {"a": 1}, {"a": 1}]}
    heat.update(bedHeaters=[-1, 1], chamberHeaters=[2])
    tools = [None, {"number": 5, "heaters": [3]}, {"number": 6, "heaters": [1, 3]}]
    told = only("rrf_heater_info", {"heat": heat, "tools": tools})
    assert set(told) == {
        ("1", "bed", "1"),
        ("2", "chamber", "0"),
        ("3", "tool", "5"),
        ("4", "other", ""),
    }


def test_spindles_that_are_not_configured_are_left_out():
    model = {
        "spindles": [{"state": "unconfigured", "current": 0}, {"state": "reverse", "current": -5}]
    }
    assert only("rrf_spindle_speed_rpm", model) == {("1",): -5}


def test_board_is_known_by_its_address():
    model = {"boards": [{"freeRam": 1}, {"freeRam": 2, "canAddress": 121}, {"freeRam": 3}]}
    assert only("rrf_board_free_memory_bytes", model) == {("0",): 1, ("121",): 2, ("2",): 3}


def test_drivers_are_counted_by_condition():
    statuses = [0, 1, 2, 1 << 6 | 1 << 8, 1 << 7, None]
    model = {"boards": [{"drivers": [{"status": status} for status in statuses]}]}
    assert only("rrf_board_drivers", model) == {
        ("0", "error"): 1,
        ("0", "over_temperature_warning"): 1,
        ("0", "open_load"): 2,
        ("0", "stall"): 1,
    }


@pytest.mark.parametrize(
    ("state", "told"), [({}, {}), ({"messageBox": None}, {(): 0}), ({"messageBox": {}}, {(): 1})]
)
def test_message_box(state, told):
    assert only("rrf_message_box_open", {"state": state}) == told


NAMES = ['say "hi"', "back\\slash", "two\nlines", "Prüfkopf 1 °C", "a,b={}", "#", "\\n", '\\"', ""]


@pytest.mark.parametrize("name", NAMES)
def test_names_come_back_as_they_were(name):
    assert set(only("rrf_fan_info", {"fans": [{"name": name}]})) == {("0", name)}


def test_half_a_character_is_replaced():
    text = exposition({"fans": [{"name": "a\ud800"}]}, {})
    assert 'rrf_fan_info{fan="0",name="a?"} 1' in text


def test_labels_that_come_twice_are_told_once():
    axes = [{"letter": "X", "homed": True}, {"letter": "X", "homed": False}]
    assert only("rrf_axis_homed", {"move": {"axes": axes}}) == {("X",): 1}


@pytest.mark.parametrize("reason", [None, *BLOCKED])
def test_blocked(reason):
    told = only("rrf_blocked", {}, {**STATUS, "blocked": reason})
    assert told == {(word,): word == reason for word in BLOCKED}


def test_without_a_printer_nothing_of_one_is_told():
    status = {"version": "0.1.0", "connected": False, "firmware": None, "age": None, "warnings": []}
    told = {name for name, samples in values({}, status).items() if samples}
    assert told == {"rrf_info", "rrf_connected", "rrf_blocked", "rrf_warnings"}


TOP = st.sampled_from(
    ["state", "heat", "tools", "fans", "move", "job", "boards", "sensors", "volumes", "network"]
)


SMALL = {
    "state": {"status": "processing", "currentTool": 0, "upTime": 1, "msUpTime": 5},
    "heat": {"heaters": [{"current": 1.0, "state": "active"}], "bedHeaters": [0]},
    "tools": [{"number": 0, "heaters": [0], "name": "a", "state": "off"}],
    "fans": [{"requestedValue": 0.5, "rpm": 5, "name": ""}],
    "move": {
        "axes": [{"letter": "X", "homed": True}],
        "extruders": [{"pressAdv": {"k": 1}}],
        "motionSystems": [{"speedFactor": 1}],
    },
    "job": {"file": {"size": 10, "numLayers": 3}, "filePosition": 4, "timesLeft": {"file": 1}},
    "boards": [{"canAddress": 1, "drivers": [{"status": 5}], "mcuTemp": {"current": 1}}],
    "sensors": {
        "analog": [{"lastReading": 1.0, "state": "ok"}],
        "filamentMonitors": [{"status": "ok", "enableMode": 1}],
    },
    "spindles": [{"state": "forward"}],
    "network": {"interfaces": [{"signal": 1}]},
    "m408": {"fractionPrinted": 1, "fraction_printed": 0.5},
}


def places(value, path=()):
    """Yield the path of each value, containers included."""
    yield path
    if isinstance(value, (dict, list)):
        for step, below in value.items() if isinstance(value, dict) else enumerate(value):
            yield from places(below, (*path, step))


def broken(value):
    """Return a strategy of the value with up to three of its parts replaced by whatever it is."""

    def replaced(changes):
        root = [copy.deepcopy(value)]
        for path, new in changes:
            place = root
            try:
                for step in (0, *path[:-1]):
                    place = place[step]
                place[path[-1]] = new
            except (TypeError, LookupError):
                continue  # what held it was replaced before
        return root[0]

    paths = st.sampled_from([path for path in places(value) if path])
    return st.lists(st.tuples(paths, ANY_JSON), max_size=3).map(replaced)


@settings(max_examples=some(200))
@given(broken(SMALL), broken(STATUS))
@example({}, {})
def test_no_model_and_no_state_is_too_strange(model, status):
    assert check(model, status)


@given(st.dictionaries(TOP, ANY_JSON))
def test_no_value_is_too_strange(model):
    assert check(model)


##~~ the reference

REFERENCE = ROOT / "docs" / "metrics.md"
ROW = re.compile(r"^\| `(rrf_\w+)` \|([^|]*)\|([^|]*)\|$", re.MULTILINE)
"""A row of a table: the metric, its labels, what it says."""


@pytest.fixture(scope="module")
def reference():
    return REFERENCE.read_text(encoding="utf-8")


def test_reference_has_each_row_once_with_its_labels(reference):
    rows = [(name, tuple(re.findall(r"`(\w+)`", cell))) for name, cell, _ in ROW.findall(reference)]
    assert sorted(rows) == sorted((metric.name, metric.labels) for metric in METRICS)


def test_reference_names_nothing_else(reference):
    named = set(re.findall(r"\brrf_\w+", reference))
    assert named == {metric.name for metric in METRICS}


@pytest.mark.parametrize(
    ("words", "metric"),
    [
        (STATUSES, "rrf_status"),
        (HEATERS, "rrf_heater_state"),
        (TOOLS, "rrf_tool_state"),
        (SPINDLES[1:], "rrf_spindle_state"),
        (MONITOR_WORDS, "rrf_filament_monitor_state"),
        (BOARDS, "rrf_board_state"),
        (BLOCKED, "rrf_blocked"),
    ],
)
def test_reference_has_the_words_of_a_state(reference, words, metric):
    text = next(text for name, _, text in ROW.findall(reference) if name == metric)
    assert set(re.findall(r"`(\w+)`", text)) >= set(words)
