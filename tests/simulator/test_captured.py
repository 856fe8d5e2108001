"""Boards that serve a captured object model."""

from __future__ import annotations

import json

import pytest

from octoprint_rrfmodel.simulator import captured
from octoprint_rrfmodel.simulator.board import Board

MODEL = {"state": {"status": "idle", "upTime": 500}, "heat": {"heaters": []}}

TEXTS = {
    "bare": json.dumps(MODEL),
    "in an envelope": json.dumps({"key": "", "flags": "d99vn", "result": MODEL}),
    "only a result": json.dumps({"result": MODEL}),
    "pretty-printed": json.dumps({"result": MODEL}, indent=2),
    "JSON lines": json.dumps(MODEL) + "\n" + json.dumps({"state": {"upTime": 501}}) + "\n",
}


@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_model_in(text):
    assert captured.model_in(text) == MODEL


@pytest.mark.parametrize("text", ["", "{", "[]", "5", '{"heat":{}}', '{"state":5}', "no"])
def test_no_model_in(text):
    with pytest.raises(captured.UnreadableModel):
        captured.model_in(text)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(captured.UnreadableModel, match="cannot read"):
        captured.load(tmp_path / "none.json")


VERSIONS = {
    "3.3": "3.3",
    "3.4.5": "3.4",
    "3.5beta1": "3.5.1",
    "3.5.0-rc.1": "3.5.1",
    "3.5.4": "3.5.3",
    "3.6.0-beta.1+1": "3.6",
    "3.6.2+1": "3.6.2",
    "3.7.0": "3.7",
    "3.8.0": "3.7",
    "3.1.1": "3.3",
    "": "3.5.3",
    "what": "3.5.3",
}


@pytest.mark.parametrize(("version", "name"), VERSIONS.items())
def test_firmware_of(version, name):
    assert captured.firmware_of({"boards": [{"firmwareVersion": version}]}) == name


@pytest.mark.parametrize("boards", [None, [], [None], [{}]])
def test_firmware_of_a_model_without_boards(boards):
    assert captured.firmware_of({"boards": boards}) == "3.5.3"


def test_what_is_there_stays_and_what_is_missing_is_supplied(bench):
    model = {
        "state": {"status": "idle", "currentTool": 1},
        "tools": [None, {"number": 1, "heaters": [0], "active": [0], "standby": [0]}],
        "heat": {"heaters": [{"current": 33.25}]},
        "boards": [{"firmwareVersion": "3.5.4", "firmwareName": "RepRapFirmware for Test"}],
        "extra": {"kept": True},
    }
    board = bench(model=model)
    assert board.ask("heat.heaters[0].current") == 33.25
    assert board.ask("tools[0]") is None
    assert board.ask("extra.kept") is True
    assert board.ask("seqs.move") == 0
    assert board.ask("inputs[3].name") == "USB"
    board.wait(60)
    assert board.ask("state.upTime") == 60
    assert "FIRMWARE_NAME: RepRapFirmware for Test FIRMWARE_VERSION: 3.5.4" in board.send("M115")
    assert board.send("M105").startswith("ok T:")


def test_the_given_model_is_not_changed(bench):
    model = json.loads(json.dumps(MODEL))
    board = bench(model=model)
    board.done("T0", "G28", "M104 S200", 'M550 P"x"')
    assert model == MODEL


def test_usb_answers_whatever_the_capture_says(bench):
    inputs = [
        {"name": name, "compatibility": "repRapFirmware"}
        for name in ("HTTP", "Telnet", "File", "USB")
    ]
    assert bench(model={**MODEL, "inputs": inputs}).send("M110") == "ok\n"


LINES = [
    'M409 F"d99fn"', 'M409 K"move" F"d99vn"', 'M409 K"state" F"d99vn"', "M408 S0", "M408 S3",
    "M408 S4", "M408 S5", "M105", "M114", "M119", "M122", "G28", "G1 X10 F6000", "T0", "M109 S60",
    "M140 S50", "M106 P0 S1", "M290 S0.1", "M220 S90", "M84", "M117 x", 'M32 "square.gcode"',
]  # fmt: skip


def test_captures_of_real_boards(captures):
    """Everything that holds a whole model can be served, polled and driven."""
    served = 0
    for path in sorted(captures.glob("om*.json*")):
        try:
            model = captured.load(path)
        except captured.UnreadableModel:
            continue
        served += 1
        time = [0.0]
        board = Board(firmware=captured.firmware_of(model), model=model, clock=lambda t=time: t[0])
        for line in LINES:
            board.receive(line.encode() + b"\n")
            said = b""
            for _ in range(300):
                time[0] += 1
                said += board.transmit()
                if board.channels["USB"].is_idle:
                    break
            assert b"ok\n" in said or said.startswith(b"ok "), (path.name, line)
    assert served >= 8


def test_values_of_a_capture_come_out_as_they_went_in(captures):
    model = captured.load(captures / "om360b1_duet2wifi_full_idle.json")
    board = Board(firmware="3.6", model=model, clock=lambda: 0.0)
    board.receive(b'M409 K"move.kinematics" F"d99vn"\n')
    reply = json.loads(board.transmit().split(b"\n")[0])
    assert reply["result"] == model["move"]["kinematics"]
    board.receive(b'M409 K"heat.heaters[0].model" F"d99vn"\n')
    reply = json.loads(board.transmit().split(b"\n")[0])
    assert reply["result"] == model["heat"]["heaters"][0]["model"]
