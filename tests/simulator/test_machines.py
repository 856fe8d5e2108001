"""Every machine in every firmware: a whole model, right shapes, and no command that fails."""

from __future__ import annotations

import json

import pytest

from octoprint_rrfmodel.simulator.firmware import VERSIONS
from octoprint_rrfmodel.simulator.hardware.blank import INPUT_NAMES
from octoprint_rrfmodel.simulator.machines import MACHINES, UnknownMachine, machine_called

KEYS = [
    "boards",
    "directories",
    "fans",
    "global",
    "heat",
    "inputs",
    "job",
    "limits",
    "move",
    "network",
    "sensors",
    "seqs",
    "spindles",
    "state",
    "tools",
    "volumes",
]


@pytest.mark.parametrize("firmware", [name for name in VERSIONS if name != "2.05"])
@pytest.mark.parametrize("machine", MACHINES)
def test_every_key_can_be_asked_for(bench, machine, firmware):
    board = bench(machine, firmware)
    for key in KEYS:
        start, whole = 0, None
        while True:
            flags = f"d99vno{f'a{start}' if start else ''}"
            text = board.send(f'M409 K"{key}" F"{flags}"')
            assert text.endswith("\n\nok\n")
            reply = json.loads(text[: -len("\n\nok\n")])
            assert "err" not in reply, key
            if "next" not in reply:
                break
            whole = (whole or []) + reply["result"]
            start = reply["next"]
            if not start:
                assert len(whole) == len(board.board.model[key])
                break


@pytest.mark.parametrize("machine", MACHINES)
def test_the_live_root_fits_the_buffers(bench, machine):
    assert set(bench(machine).ask("", "d99fn")) >= {"heat", "move", "state", "seqs"}


@pytest.mark.parametrize("machine", ["toolchanger", "manyaxes", "corexy"])
def test_the_whole_root_does_not(bench, machine):
    assert bench(machine).send('M409 F"d99vn"') == '{"err":-1}\n\nok\n'


def test_tools_have_gaps(bench):
    board = bench("toolchanger")
    numbers = [tool and tool["number"] for tool in board.ask("tools")]
    assert numbers == [None, 1, None, 3, None, None, None, 7, None, None, 10]
    assert board.ask("#tools") == 11


def test_cnc_has_neither_tools_nor_heat(bench):
    board = bench("cnc")
    assert board.ask("tools") == []
    assert board.ask("heat.heaters") == []
    assert set(board.ask("heat.bedHeaters")) == {-1}
    assert board.ask("state.machineMode") == "CNC"
    assert board.ask("spindles[].state") == ["stopped"] + ["unconfigured"] * 3


def test_two_beds(bench):
    assert bench("idex").ask("heat.bedHeaters")[:3] == [0, 1, -1]


def test_a_null_hole_in_the_sensors(bench):
    assert bench().ask("sensors.analog")[2] is None


KINEMATICS = {
    "cartesian": "cartesian",
    "corexy": "coreXY",
    "delta": "delta",
    "cnc": "cartesian",
}


@pytest.mark.parametrize(("machine", "name"), KINEMATICS.items())
def test_kinematics(bench, machine, name):
    assert bench(machine).ask("move.kinematics.name") == name


def test_axes_beyond_nine(bench):
    board = bench("manyaxes")
    assert len(board.ask("move.axes")) == 9
    assert len(board.ask("move", "d99vn")["axes"]) == 9
    first = board.reply("move.axes", "d99vna0")
    second = board.reply("move.axes", f"d99vna{first['next']}")
    assert first["next"] > 0
    assert second["next"] == 0
    letters = "".join(axis["letter"] for axis in first["result"] + second["result"])
    assert letters == "XYZUVWABCDabc"
    assert len(board.ask("move.axes", "d99f")) == 13


def test_lower_case_axes_move_by_their_quoted_letter(bench):
    board = bench("manyaxes").homed()
    board.done("G1 'a20 A10 F6000", "M400")
    axes = {axis["letter"]: axis["machinePosition"] for axis in board.board.model["move"]["axes"]}
    assert (axes["A"], axes["a"]) == (10, 20)


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("firmware", ["3.4", "3.5.3"])
def test_inputs_have_their_indexes(bench, machine, firmware):
    inputs = bench(machine, firmware).board.model["inputs"]
    assert len(inputs) == (12 if firmware == "3.4" else 14)
    for index, found in enumerate(inputs):
        assert found is None or found["name"] == INPUT_NAMES[index]
    assert inputs[3]["name"] == "USB"
    assert inputs[3]["compatibility"] == "Marlin"
    assert inputs[0]["compatibility"] == "RepRapFirmware"


def test_a_duet_2_has_less_of_everything(bench):
    board = bench("delta")
    assert board.ask("inputs")[8] is None
    assert "canAddress" not in board.board.model["boards"][0]
    assert "percentStstCurrent" not in board.board.model["move"]["axes"][0]
    assert board.board.model_text.array_bytes == 2816
    assert bench("delta", "3.3").board.model_text.array_bytes == 2560


def test_tool_boards(bench):
    boards = bench("toolchanger").ask("boards", "d99vn")
    assert [board["canAddress"] for board in boards] == [0, 20, 21, 22, 23]


def test_variables_of_all_types(bench):
    kinds = {type(value) for value in bench().ask("global", "n").values()}
    assert kinds == {float, bool, str, type(None), int, list}


def test_models_are_not_shared(bench):
    first, second = bench(), bench()
    first.send("M220 S50", "set global.retries = 9")
    first.board.model["move"]["kinematics"]["name"] = "x"
    assert second.ask("move.speedFactor") == 1
    assert second.ask("global.retries") == 3
    assert second.ask("move.kinematics.name") == "cartesian"


def test_unknown_machine_names_the_known_ones():
    with pytest.raises(UnknownMachine, match="unknown machine 'x', known are cartesian, corexy"):
        machine_called("x")


LINES = """
    G28|G29 S2|G10 P0 S200 R100|G92 E0|M0|M18|M20 S2|M21|M23 square.gcode|M27|M36|M39|M42 P0 S0.5
    M81|M80|M82|M84 S30|M92|M98 P"0:/macros/Say hello"|M104 S200|M105|M106 P0 S1|M107|M108|M111 S0
    M114|M115|M117 x|M118 S"x"|M119|M120|M121|M122|M140 S60|M141 S40|M144|M150 R255|M201 X500
    M220 S90|M221 S90|M290 S0.01|M291 P"x" S0|M292|M300 P100|M302|M400|M408 S3|M451|M486 T1|M550
    M555|M561|M562|M563 P0 S"x"|M564|M568 P0|M575 P0|M593 P"none"|M701|M702|M703|M955 P0|T0|T-1
    echo state.status|global x1 = 1|set global.x1 = {1,2}|if true
""".replace("\n", "|").split("|")


@pytest.mark.parametrize("machine", MACHINES)
@pytest.mark.parametrize("firmware", VERSIONS)
def test_every_command_ends_and_answers(bench, machine, firmware):
    board = bench(machine, firmware)
    for line in filter(None, map(str.strip, LINES)):
        if line == "M122" and VERSIONS[firmware].looks_at_usb:
            line = "M122 B0"  # a bare one empties the input, and its ok never comes
        said = board.done(line)
        assert said.endswith("ok\n") or said.startswith("ok "), line
