"""Errors of a board that a person has to see, commands that block, and standing warnings."""

import pytest

from octoprint_rrfmodel.rrf.gcode.blocking import BLOCKING
from octoprint_rrfmodel.rrf.views.warnings import MachineWarning, warnings_of
from octoprint_rrfmodel.rrf.wire.errors import is_halted, is_serious

SERIOUS = [
    "Error: Heater 1 fault: temperature excursion exceeded 15.0\xb0C",
    "Heater 0 fault: temperature rising too slowly: expected 2.50\xb0C/sec measured 0.20\xb0C/sec",
    "Error: Heating fault on heater 1, temperature excursion exceeded 10.0C",
    "Emergency Stop! Reset the controller to continue.",
    "Error: over-voltage event",
    "Driver 3 error: phase A short-to-ground",
    "Error: over temperature shutdown",
]

HARMLESS = [
    "Error: M25: Cannot pause print, because no file is being printed!",
    "Error: G0/G1: insufficient axes homed",
    "Error: M121: insufficient axes homed",
    "Error: G1: target position outside machine limits",
    "Error: M0: Pause the print before attempting to cancel it",
    "Error: M104: Invalid tool number",
    "Error: M104: Machine is halted",
    "Error: Bad command: foo",
    "Error:  at column 7: M409: expected a string expression",
    "Error: No tool selected",
    "Error: Attempting to extrude with no tool selected.",
    "Error: M220: Invalid speed factor",
    "Error: Failed to delete file 0:/gcodes/a.g",
    "Error: M140: Requested temperature out of range",
    "Error: M569: Driver 10 does not exist",
]


@pytest.mark.parametrize("text", SERIOUS)
def test_text_of_harm_is_serious(text):
    assert is_serious(text)


@pytest.mark.parametrize("text", HARMLESS)
def test_refused_command_is_not_serious(text):
    assert not is_serious(text)


@pytest.mark.parametrize(
    ("text", "halted"),
    [
        ("Error: M110: Machine is halted", True),
        ("Error:  at column 3: M110: machine is halted", True),
        ("Error: M110: Machine is idle", False),
    ],
)
def test_refusal_of_a_halted_board_is_known(text, halted):
    assert is_halted(text) is halted


@pytest.mark.parametrize(
    "command",
    [
        "M109",
        "M190",
        "M191",
        "M116",
        "G28",
        "G29",
        "G30",
        "G32",
        "G4",
        "M400",
        "M98",
        "T",
        "M226",
        "M600",
        "M701",
        "M702",
        "M703",
        "M24",
        "M25",
        "M0",
        "M125",
    ],
)
def test_command_that_ends_with_its_ok_is_known_to_block(command):
    assert command in BLOCKING


@pytest.mark.parametrize(
    "command", ["G0", "G1", "M104", "M140", "M105", "M106", "M409", "M408", "M220", "M568", "M32"]
)
def test_command_that_is_acknowledged_at_once_does_not_block(command):
    assert command not in BLOCKING


@pytest.mark.parametrize(
    ("model", "expected"),
    [
        ({}, []),
        ({"state": {"status": "idle"}}, []),
        ({"state": {"status": "halted"}}, [MachineWarning("halted")]),
        ({"state": {"status": "off"}}, [MachineWarning("off")]),
        (
            {"heat": {"heaters": [{"state": "fault"}, None, {"state": "fault"}, {"state": "off"}]}},
            [MachineWarning("heater_fault", (0,)), MachineWarning("heater_fault", (2,))],
        ),
        (
            {"state": {"status": "halted"}, "heat": {"heaters": [{"state": "fault"}]}},
            [MachineWarning("halted"), MachineWarning("heater_fault", (0,))],
        ),
        ({"state": None, "heat": []}, []),
        ({"state": {"status": {}}, "heat": {"heaters": 5}}, []),
    ],
)
def test_warnings_of_a_model(model, expected):
    assert warnings_of(model) == expected
