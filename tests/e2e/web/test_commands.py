"""Commands to the machine: the line on the wire, and what the board has made of it."""

import pytest

from .. import helpers
from ..operations import PROFILE, Machine

# the lines for those between are proven without a server, tests/rrf/gcode/test_commands_lines.py
FIRMWARE = ("2.05", "3.7")
HOT_SECONDS = 120


@pytest.fixture(scope="module")
def server(module_server_factory):
    return module_server_factory(profile=PROFILE)


def connected(server, board):
    """Return the machine of a board that is connected, homed and hot, its tool selected."""
    helpers.connect(server, board)
    machine = Machine(server, board)
    machine.settle()
    machine.board.execute("G28\nM104 T0 S210\nT0")
    server.wait_for(lambda: machine.board.channels["HTTP"].is_idle, 60, "the machine to be homed")
    server.wait_for(
        lambda: all(heater["current"] > 205 for heater in used_heaters(machine)),
        HOT_SECONDS,
        "the tool to be hot",
    )
    machine.settle()
    return machine


def used_heaters(machine):
    model = machine.board.model
    return [model["heat"]["heaters"][index] for index in model["tools"][0]["heaters"]]


@pytest.fixture(scope="module", params=FIRMWARE)
def machine(request, server, module_board_factory):
    """One board for all cases of a firmware: none of them needs what another changes."""
    board = module_board_factory(machine="cartesian", firmware=request.param, speed=20)
    made = connected(server, board)
    yield made
    helpers.disconnect(server)


def new(machine):
    return machine.board.firmware.at_least(3, 3)


def bed(model):
    return model["heat"]["heaters"][model["heat"]["bedHeaters"][0]]


def positions(model):
    return [axis["machinePosition"] for axis in model["move"]["axes"]]


def tool(model):
    return model["tools"][0]


CASES = [
    # parameters, lines for new and for old firmware (None: the same), what the board has then
    (
        "tool_temperatures",
        {"tool": 0, "active": 211.5, "standby": 150},
        ["M568 P0 S211.5 R150"],
        ["G10 P0 S211.5 R150"],
        lambda model: (tool(model)["active"], tool(model)["standby"]) == ([211.5], [150]),
    ),
    ("select_tool", {"tool": 0}, ["T0"], None, lambda model: model["state"]["currentTool"] == 0),
    (
        "bed",
        {"active": 60, "standby": 40},
        ["M140 P0 S60 R40"],
        None,
        lambda model: (
            (bed(model)["state"], bed(model)["active"], bed(model)["standby"]) == ("active", 60, 40)
        ),
    ),
    (
        "bed",
        {"active": 50, "state": "standby"},
        ["M140 P0 S50", "M144 P0"],
        None,
        lambda model: (bed(model)["state"], bed(model)["active"]) == ("standby", 50),
    ),
    (
        "bed",
        {"state": "active"},
        ["M144 P0 S1"],
        None,
        lambda model: bed(model)["state"] == "active",
    ),
    (
        "bed",
        {"state": "off"},
        ["M140 P0 S{-273.15}"],
        ["M120 M140 P0 S-273.15 M121"],
        lambda model: bed(model)["state"] == "off",
    ),
    (
        "fan",
        {"fan": 0, "speed": 0.3},
        ["M106 P0 S0.3"],
        None,
        lambda model: model["fans"][0]["requestedValue"] == 0.3,
    ),
    (
        "home",
        {"axes": ["X", "Y"]},
        ["G28 X Y"],
        None,
        lambda model: [axis["machinePosition"] for axis in model["move"]["axes"][:2]] == [0, 0],
    ),
    (
        "jog",
        {"axes": {"X": 30, "Y": 20}, "speed": 6000, "absolute": True},
        ["M120 G21 G90 G1 X30 Y20 F6000 M121"],
        None,
        lambda model: positions(model)[:2] == pytest.approx([30, 20]),
    ),
    (
        "jog",
        {"axes": {"X": -10}},
        ["M120 G21 G91 G1 X-10 M121"],
        None,
        lambda model: positions(model)[0] == pytest.approx(20),
    ),
    (
        "babystep",
        {"amount": 0.05},
        ["M290 Z0.05"],
        None,
        lambda model: model["move"]["axes"][2]["babystep"] == pytest.approx(0.05),
    ),
    (
        "babystep",
        {"amount": 0, "absolute": True},
        ["M290 R0 Z0"],
        None,
        lambda model: model["move"]["axes"][2]["babystep"] == pytest.approx(0),
    ),
    (
        "tool_offsets",
        {"tool": 0, "offsets": {"Y": -0.25}},
        ["G10 P0 Y-0.25"],
        None,
        lambda model: model["tools"][0]["offsets"][1] == pytest.approx(-0.25),
    ),
    (
        "tool_offsets",
        {"tool": 0, "offsets": {"Y": 0}},
        ["G10 P0 Y0"],
        None,
        lambda model: model["tools"][0]["offsets"][1] == pytest.approx(0),
    ),
    (
        "speed_factor",
        {"percent": 120},
        ["M220 S120"],
        None,
        lambda model: model["move"]["speedFactor"] == 1.2,
    ),
    (
        "extrusion_factor",
        {"extruder": 0, "percent": 90},
        ["M221 D0 S90"],
        None,
        lambda model: model["move"]["extruders"][0]["factor"] == 0.9,
    ),
    (
        "filament",
        {"action": "load", "name": "PLA"},
        ['M701 S"PLA"', "M703"],
        ["M702", 'M701 S"PLA"', "M703"],
        lambda model: model["move"]["extruders"][0]["filament"] == "PLA",
    ),
    (
        "filament",
        {"action": "load", "name": "PLA"},
        ["M702", 'M701 S"PLA"', "M703"],
        None,
        lambda model: model["move"]["extruders"][0]["filament"] == "PLA",
    ),
    (
        "filament",
        {"action": "unload"},
        ["M702"],
        None,
        lambda model: model["move"]["extruders"][0]["filament"] == "",
    ),
    (
        "mesh",
        {"action": "load"},
        ["G29 S1"],
        None,
        lambda model: model["move"]["compensation"]["type"] == "mesh",
    ),
    (
        "mesh",
        {"action": "clear"},
        ["G29 S2"],
        None,
        lambda model: model["move"]["compensation"]["type"] == "none",
    ),
    (
        "mesh",
        {"action": "probe"},
        ["G29"],
        None,
        lambda model: model["move"]["compensation"]["type"] == "mesh",
    ),
    ("mesh", {"action": "calibrate"}, ["G32"], None, None),
    ("macro", {"path": "0:/macros/Say hello"}, ['M98 P"0:/macros/Say hello"'], None, None),
    ("power", {"on": True}, ["M80"], None, lambda model: model["state"]["atxPower"] is True),
]


@pytest.mark.parametrize(
    "name, parameters, lines, old_lines, is_done",
    CASES,
    ids=[f"{index}-{case[0]}" for index, case in enumerate(CASES)],
)
def test_command(machine, name, parameters, lines, old_lines, is_done):
    machine.command(name, lines if new(machine) or old_lines is None else old_lines, **parameters)
    if is_done is not None:
        machine.server.wait_for(lambda: is_done(machine.board.model), 20, "the board to do it")
        if new(machine):
            machine.server.wait_for(lambda: is_done(machine.told()), 5, "the model to tell it")
    assert machine.server.state() == "Operational"
    assert machine.usb["stackDepth"] == 0


@pytest.mark.both_hosts("lines go through the queue of the host", once_for=("machine",))
def test_extruding(machine):
    before = machine.board.model["move"]["extruders"][0]["rawPosition"]
    machine.command("extrude", ["M120 M83 G1 E2 F300 M121"], amounts=2, speed=300)
    assert machine.server.wait_for(
        lambda: (
            machine.board.model["move"]["extruders"][0]["rawPosition"] == pytest.approx(before + 2)
        ),
        10,
        "the filament to be extruded",
    )
