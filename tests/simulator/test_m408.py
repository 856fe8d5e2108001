"""The types of M408: members, letters, framing."""

from __future__ import annotations

import json

import pytest

from octoprint_rrfmodel.simulator.gcodes.queries.m408_values import LETTERS, OLD_LETTERS

BASIC = [
    "status",
    "heaters",
    "active",
    "standby",
    "hstat",
    "pos",
    "machine",
    "sfactor",
    "efactor",
    "babystep",
    "tool",
    "probe",
    "fanPercent",
    "fanRPM",
    "homed",
    "msgBox.mode",
]
GEOMETRY = [
    "geometry",
    "axes",
    "totalAxes",
    "axisNames",
    "volumes",
    "numTools",
    "myName",
    "firmwareName",
]
STATUS = ["status", "coords", "speeds", "currentTool", "params", "sensors", "temps", "time"]
SETTINGS = [
    "coldExtrudeTemp",
    "coldRetractTemp",
    "compensation",
    "controllableFans",
    "tempLimit",
    "endstops",
    "firmwareName",
    "firmwareVersion",
    "geometry",
    "axes",
    "totalAxes",
    "axisNames",
    "volumes",
    "mountedVolumes",
    "mode",
    "name",
    "probe",
    "tools",
    "mcutemp",
    "vin",
]
PRINTING = [
    "currentLayer",
    "currentLayerTime",
    "extrRaw",
    "fractionPrinted",
    "filePosition",
    "printDuration",
    "warmUpDuration",
    "timesLeft",
]
CONFIGURATION = [
    "axisMins",
    "axisMaxes",
    "accelerations",
    "currents",
    "firmwareElectronics",
    "firmwareName",
    "boardName",
    "firmwareVersion",
    "dwsVersion",
    "firmwareDate",
    "sysdir",
    "idleCurrentFactor",
    "idleTimeout",
    "minFeedrates",
    "maxFeedrates",
]

FORMS = {
    0: BASIC,
    1: BASIC + GEOMETRY,
    2: STATUS,
    3: STATUS + SETTINGS,
    4: STATUS + PRINTING,
    5: CONFIGURATION,
    7: STATUS,
}


def status(board, kind):
    text = board.send(f"M408 S{kind}")
    blank = "\n\n\n" if kind in (0, 1) else "\n\n"
    assert text.endswith("}" + blank + "ok\n")
    return json.loads(text[: -len(blank + "ok\n")])


@pytest.mark.parametrize("kind", FORMS)
@pytest.mark.parametrize("firmware", ["2.05", "3.3", "3.4", "3.5.3", "3.6"])
def test_members(bench, firmware, kind):
    found = status(bench(firmware=firmware), kind)
    extra = {"firstLayerDuration", "firstLayerHeight"} if kind == 4 else set()
    assert set(found) - extra == set(FORMS[kind])


def test_without_a_type_it_is_0(bench):
    assert bench().send("M408") == bench().send("M408 S0")


def test_exact_text_of_type_0(bench):
    assert bench().send("M408 S0") == (
        '{"status":"I","heaters":[21.3,21.3],"active":[0.0,0.0],"standby":[0.0,0.0],'
        '"hstat":[0,0],"pos":[0.000,0.000,0.000],"machine":[0.000,0.000,0.000],'
        '"sfactor":100.0,"efactor":[100.0],"babystep":0.000,"tool":-1,"probe":"0",'
        '"fanPercent":[0.0,0,100'
        + 30 * ",-1"
        + '],"fanRPM":[-1,0],"homed":[0,0,0],"msgBox.mode":-1}\n\n\nok\n'
    )


@pytest.mark.parametrize("machine", ["cartesian", "corexy", "toolchanger", "delta", "idex", "cnc"])
@pytest.mark.parametrize("kind", range(6))
def test_every_machine(bench, machine, kind):
    assert status(bench(machine), kind)


def test_heater_order_has_the_bed_first(bench):
    board = bench()
    board.send("M140 S60", "M568 P0 S200 A2")
    found = status(board, 0)
    assert found["active"] == [60, 200]
    assert found["hstat"] == [2, 2]


def test_letters_in_order():
    assert "".join(LETTERS.values()) == "CFHODRSAMPTBI"


def paused(board):
    board.send('M32 "square.gcode"')
    board.until(lambda b: (b.model["job"]["layer"] or 0) >= 2)
    board.done("M25")


def changing(board):
    board.send("T0")
    board.wait(1)


def moving(board):
    board.homed().send("G1 X100 F600")
    board.wait(1)


STATES = {
    "idle": (lambda board: None, "I", "I"),
    "busy": (moving, "B", "B"),
    "processing": (lambda board: board.send('M32 "square.gcode"'), "P", "P"),
    "simulating": (lambda board: board.send('M37 P"square.gcode"'), "M", "M"),
    "paused": (paused, "S", "A"),
    "halted": (lambda board: board.send("M112"), "H", "S"),
    "off": (lambda board: board.board.inject("vin_off"), "O", "O"),
}


@pytest.mark.parametrize(("reach", "letter", "old"), STATES.values(), ids=STATES)
def test_status_letter(bench, reach, letter, old):
    """S0 and S1 say A for paused and S for halted."""
    board = bench()
    reach(board)
    assert status(board, 2)["status"] == letter
    assert status(board, 3)["status"] == letter
    assert status(board, 0)["status"] == old
    assert status(board, 1)["status"] == old


def test_changing_tool(bench):
    """USB waits for the change, so another channel asks."""
    board = bench()
    changing(board)
    assert json.loads(board.board.execute("M408 S2"))["status"] == "T"


def test_only_two_letters_differ():
    assert OLD_LETTERS == {"S": "A", "H": "S"}


def test_printing(bench):
    board = bench()
    board.send('M32 "square.gcode"')
    board.until(lambda b: (b.model["job"]["layer"] or 0) >= 3)
    board.wait(30)
    found = status(board, 4)
    assert found["currentLayer"] >= 3
    assert 0 < found["fractionPrinted"] < 100
    assert found["printDuration"] > 60
    assert found["timesLeft"]["file"] > 0
    flat = status(board, 0)
    assert 0 < flat["fraction_printed"] < 1
    assert flat["timesLeft"][2] == 0


def test_message_box(bench):
    board = bench()
    board.board.execute('M291 P"Text ""x""" R"Title" S3 Z1')
    flat = status(board, 0)
    assert (flat["msgBox.mode"], flat["msgBox.msg"], flat["msgBox.controls"]) == (3, 'Text "x"', 4)
    box = status(board, 2)["output"]["msgBox"]
    assert box == {
        "msg": 'Text "x"',
        "title": "Title",
        "mode": 3,
        "seq": 1,
        "timeout": 0,
        "controls": 4,
    }


def test_message_and_beep(bench):
    board = bench()
    board.send("M117 Hello", "M300 S1000 P500")
    assert status(board, 2)["output"] == {
        "beepDuration": 500,
        "beepFrequency": 1000,
        "message": "Hello",
    }
    board.wait(1)
    assert status(board, 2)["output"] == {"message": "Hello"}


def test_chamber_and_spindle(bench):
    assert status(bench("corexy"), 2)["temps"]["chamber"]["heater"] == 2
    assert "chamber" not in status(bench(), 2)["temps"]
    assert status(bench("cnc"), 2)["spindles"] == [{"current": 0, "active": 0}]


def test_configuration(bench):
    found = status(bench("delta"), 5)
    assert found["axisMins"] == [-120, -120, -0.5]
    assert found["axisMaxes"] == [120, 120, 330.21]
    assert found["firmwareElectronics"] == "Duet WiFi 1.02 or later"
    assert found["boardName"] == "2WiFi"


def test_old_firmware_has_the_first_layer(bench):
    assert "firstLayerHeight" in status(bench(firmware="3.3"), 4)
    assert "layer" in status(bench(firmware="3.3"), 4)["timesLeft"]
    assert "firstLayerHeight" not in status(bench(firmware="3.5.3"), 4)


def test_nan_may_be_printed(bench):
    board = bench()
    board.board.model["heat"]["heaters"][0]["current"] = float("nan")
    assert '"heaters":[nan,21.3]' in board.send("M408 S0")
