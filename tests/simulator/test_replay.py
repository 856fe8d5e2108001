"""A board that does what the machine of a support bundle did."""

from __future__ import annotations

import json

import pytest

from octoprint_rrfmodel.rrf.wire import bundle
from octoprint_rrfmodel.rrf.wire.anonymiser import Anonymiser
from octoprint_rrfmodel.simulator import captured, replay
from octoprint_rrfmodel.simulator.__main__ import board_of, main, parser
from octoprint_rrfmodel.simulator.board import Board

CLOCKS = ("upTime", "msUpTime", "time")


def archive_of(model, protocol="M409", **reported):
    """Return a bundle with this model in it."""
    return bundle.packed(
        {
            bundle.MODEL: {"key": "", "flags": "d99vno", "result": Anonymiser().model(model)},
            bundle.MACHINE: {"form": 1, "protocol": protocol, "reported": reported},
        }
    )


def replayed(model, **more):
    return replay.recording(archive_of(model, **more)).board()


def without_clocks(model):
    whole = json.loads(json.dumps(model).replace("NaN", "null"))
    for name in CLOCKS:
        whole["state"].pop(name, None)
    return whole


def common(value, told):
    """Return of a value what there is in another one too; the rest was supplied."""
    if isinstance(value, dict) and isinstance(told, dict):
        return {name: common(below, told[name]) for name, below in value.items() if name in told}
    if isinstance(value, list) and isinstance(told, list) and len(value) == len(told):
        return [common(*pair) for pair in zip(value, told)]
    return value


MACHINES = [
    ("cartesian", "3.3", ()),
    ("toolchanger", "3.4", ()),
    ("idex", "3.5.3", ("heater_fault",)),
    ("cnc", "3.6", ("vin_off",)),
    ("manyaxes", "3.7", ("driver_error",)),
    ("corexy", "3.6.4", ("halted",)),
    ("delta", "3.5.1", ("filament_error",)),
    ("toolchanger", "3.6", ("message_box",)),
]


@pytest.mark.parametrize(("machine", "firmware", "faults"), MACHINES)
def test_the_model_of_a_bundle_is_the_board_s(machine, firmware, faults):
    recorded = Board(machine, firmware, faults=faults, clock=lambda: 0.0)
    board = replayed(recorded.model)
    assert board.firmware.version == recorded.firmware.version
    told = without_clocks(Anonymiser().model(recorded.model))
    assert common(without_clocks(board.model), told) == told


@pytest.mark.parametrize("status", ["processing", "paused", "busy", "halted", "off", "updating"])
def test_what_it_was_doing_it_does_until_it_is_restarted(status):
    model = Board("corexy", "3.6").model
    board = replayed({**model, "state": {**model["state"], "status": status}})
    assert board.model["state"]["status"] == status
    board.reset()
    assert board.model["state"]["status"] == "idle"


def test_a_box_that_was_open_can_be_answered(bench):
    recorded = Board("toolchanger", "3.6.4")
    recorded.execute('M291 P"Load Vera\'s filament" R"Vera" S3')
    board = replayed(recorded.model)
    box = board.model["state"]["messageBox"]
    assert box["mode"] == 3 and "Vera" not in json.dumps(box)
    assert board.model["state"]["status"] == recorded.model["state"]["status"] == "busy"
    board.execute(f"M292 P0 S{box['seq']}", "Telnet")
    assert board.model["state"]["messageBox"] is None


def test_m115_tells_the_recorded_names():
    recorded = Board("delta", "3.5.1")
    names = {
        "FIRMWARE_NAME": "RepRapFirmware for Test",
        "FIRMWARE_VERSION": "3.5.2",
        "ELECTRONICS": "X",
    }
    board = replayed(recorded.model, **names)
    board.receive(b"M115\n")
    wanted = "FIRMWARE_NAME: RepRapFirmware for Test FIRMWARE_VERSION: 3.5.2 ELECTRONICS: X\nok\n"
    assert board.transmit().decode() == wanted


def test_firmware_without_m409():
    model = {"state": {"status": "idle"}, "heat": {"heaters": [{"current": 20.5, "state": "off"}]}}
    told = {"FIRMWARE_NAME": "RepRapFirmware for Duet 2 WiFi", "FIRMWARE_VERSION": "2.04"}
    board = replayed(model, protocol="M408", **told)
    board.receive(b"M115\n")
    assert b"Duet 2 WiFi FIRMWARE_VERSION: 2.04" in board.transmit()
    board.receive(b"M408 S0\n")
    assert json.loads(board.transmit().split(b"\n")[0])["heaters"] == [20.5]


NO_BUNDLES = {
    "nothing": b"",
    "no zip": b"PK and more",
    "no model": bundle.packed({bundle.MACHINE: {}}),
    "no machine": bundle.packed({bundle.MODEL: {"state": {}}}),
    "no state": bundle.packed({bundle.MODEL: {"heat": {}}, bundle.MACHINE: {}}),
    "no JSON": bundle.packed({bundle.MODEL: "{", bundle.MACHINE: "{"}),
}


@pytest.mark.parametrize("archive", NO_BUNDLES.values(), ids=NO_BUNDLES)
def test_no_bundle(archive, tmp_path, capsys):
    file = tmp_path / "bundle.zip"
    file.write_bytes(archive)
    with pytest.raises(captured.UnreadableModel):
        replay.load(file)
    assert main(["--replay", str(file), "--http", "0"]) == 2
    assert capsys.readouterr().err.startswith("error: no ")


def test_a_bundle_that_is_not_there(tmp_path):
    with pytest.raises(captured.UnreadableModel, match="cannot read"):
        replay.load(tmp_path / "none.zip")


@pytest.mark.parametrize(
    ("protocol", "face", "is_sbc"),
    [
        ("dsf", ["--http", "0"], True),
        ("dsf", ["--link", "x"], False),
        ("rr", ["--http", "0"], False),
    ],
)
def test_a_computer_in_front_is_there_again(protocol, face, is_sbc, tmp_path):
    file = tmp_path / "bundle.zip"
    file.write_bytes(archive_of(Board("corexy", "3.6").model, protocol))
    options = parser().parse_args(["--replay", str(file), *face])
    assert board_of(options).firmware.version == "3.6.0"
    assert options.sbc is is_sbc


def test_what_was_too_large_is_left_out():
    archive = bundle.packed({"a.json": "x" * (bundle.MOST_BYTES + 1)})
    with pytest.raises(bundle.NoBundle, match="no a.json"):
        bundle.member(archive, "a.json")
