"""What real boards have said, as Klipper's objects."""

import json

import pytest

from octoprint_rrfmodel.rrf.klipper import Kept, World
from octoprint_rrfmodel.rrf.model.merge import patched
from octoprint_rrfmodel.rrf.wire.m408 import M408Model

from ..test_captures import ENVELOPE, FULL, M408, PATCH, SESSION, fed_as, model_of, text_of
from . import HOST, get, whole, world
from .test_query import ALWAYS, is_served


@pytest.fixture(scope="module")
def captures(shared_dir):
    return shared_dir / "captures"


OBJECTS_OF = {
    "m408_1_s0_rrf30_duet2.json": {"extruder", "heater_bed", "fan"},
    "m408_5_s3_rrf30_duet2.json": {"extruder", "heater_bed", "fan"},
    "m408_panelpi_04_P.json": {"extruder", "heater_bed", "fan"},
    "om31_duet2_d99fn.json": {"motion_report"},
    "om31_duet2_move_d99vn.json": {"motion_report"},
    "om342_mini5plus_full_idle.json": {"mcu", "temperature_sensor mcu_0"},
    "om345_mb6hc_sbc_job_session.jsonl": {
        "extruder",
        "heater_bed",
        "fan",
        "temperature_fan fan0",
        "mcu",
        "gcode_macro globals",
    },
    "om35b1_mini5plus_full_idle.json": {"mcu", "temperature_sensor mcu_0"},
    "om360b1_duet2wifi_full_idle.json": {"mcu", "output_pin gpOut3", "controller_fan fan2"},
    "rrstatus3_30_duet2.json": {"extruder", "heater_bed", "fan"},
}


def capture(captures, name):
    """Return the model that a recording makes by itself."""
    if name.endswith(".jsonl"):
        return json.loads(text_of(captures, name).splitlines()[0])
    value = json.loads(text_of(captures, name))
    if "result" in value:
        result = value["result"]
        return {value["key"]: result} if value.get("key") else result
    return value


def expected(name):
    """Return the objects that a recording has to give, at least."""
    return ALWAYS | OBJECTS_OF.get(name, set())


@fed_as(ENVELOPE, FULL, PATCH, SESSION)
def test_recorded_model_is_served(captures, name):
    assert set(is_served(world(capture(captures, name)))) >= expected(name)


@fed_as(M408)
def test_recorded_status_is_served(captures, name):
    model = M408Model().take(json.loads(text_of(captures, name)))
    assert set(is_served(world(model))) >= expected(name)


def test_broken_sensors_of_a_real_board(captures):
    at = world(model_of(captures, "om35b1_mini5plus_full_idle.json"))
    sensors = [name for name in is_served(at) if name.startswith("temperature_sensor")]
    readings = [get(at, name, "temperature") for name in sensors]
    assert None in readings
    assert all(value is None or -100 < value < 500 for value in readings)


def test_cancelled_job_of_a_real_board(captures):
    """Paused, a text, busy, idle, and no ``cancelling`` at all; the texts come with the model."""
    for is_told in (True, False):
        states, kept, model = [], Kept(), {}
        lines = text_of(captures, "om345_mb6hc_sbc_job_session.jsonl").splitlines()
        for now, line in enumerate(lines):
            patch = json.loads(line)
            model = patched(model, patch)[0]
            for message in patch.get("messages", ()) if is_told else ():
                kept.heard(message["content"])
            kept.observe(model, HOST, now / 4)
            at = World(model, HOST, kept.snapshot, now / 4)
            state = get(at, "print_stats", "state")
            if states[-1:] != [state]:
                states.append(state)
        assert states == ["standby", "printing", "paused", "standby"]
        assert get(at, "print_stats", "filename") == "TatoCage-0.3mm.gcode"
        assert get(at, "virtual_sdcard", "is_active") is False
        assert whole(at, "display_status")["progress"] == pytest.approx(548 / 5723298)
        assert get(at, "idle_timeout", "state") == "Ready"
