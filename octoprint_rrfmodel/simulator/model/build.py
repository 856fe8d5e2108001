"""The full object model of a machine, put together once at power-up."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from typing import Any

from ..clock import BOOT_TIME
from ..firmware import Firmware
from ..hardware import blank, parts
from ..hardware.boards import toolboard
from ..machines import Machine, mainboard
from .members import for_firmware

SEQS = """
    boards directories fans global heat inputs job ledStrips move network reply scanner sensors
    spindles state tools volChanges volumes
"""
"""Members of ``seqs``."""


def _slots(heaters: Sequence[int], count: int) -> list[int]:
    return list(heaters) + [-1] * (count - len(heaters))


def _by_number(tools: list[dict[str, Any]]) -> list[dict[str, Any] | None]:
    """Return ``tools`` as RRF reports them: the index is the tool number, gaps are null."""
    found: dict[int, dict[str, Any]] = {tool["number"]: tool for tool in tools}
    return [found.get(number) for number in range(max(found, default=-1) + 1)]


def _move(machine: Machine, queue_length: int, is_duet2: bool) -> dict[str, Any]:
    axes = machine.axes()
    printing, travel = machine.accelerations
    first_motor = sum(len(axis["drivers"]) for axis in axes)
    on_tool_boards = dict(enumerate(machine.tool_boards))
    extruders = [
        parts.extruder(
            f"{on_tool_boards[index]}.0" if index in on_tool_boards else f"0.{first_motor + index}"
        )
        for index in range(machine.extruders)
    ]
    if is_duet2:
        for drive in axes + extruders:
            del drive["percentStstCurrent"]
    return {
        "axes": axes,
        "backlashFactor": 10,
        "calibration": {
            "final": {"deviation": 0.0, "mean": 0.0},
            "initial": {"deviation": 0.0, "mean": 0.0},
            "numFactors": 0,
        },
        "compensation": {
            "fadeHeight": blank.NO_TAPER,
            "file": None,
            "liveGrid": None,
            "meshDeviation": None,
            "probeGrid": {
                "axes": ["X", "Y"],
                "maxs": [215.0, 195.0],
                "mins": [15.0, 15.0],
                "radius": -1.0,
                "spacings": [20.0, 20.0],
                "xMax": 215.0,
                "xMin": 15.0,
                "xSpacing": 20.0,
                "yMax": 195.0,
                "yMin": 15.0,
                "ySpacing": 20.0,
            },
            "skew": {"compensateXY": True, "tanXY": 0.0, "tanXZ": 0.0, "tanYZ": 0.0},
            "type": "none",
        },
        "currentMove": {
            "acceleration": 0.0,
            "deceleration": 0.0,
            "extrusionRate": 0.0,
            "laserPwm": None,
            "requestedSpeed": 0.0,
            "topSpeed": 0.0,
        },
        "extruders": extruders,
        "idle": {"factor": 0.3, "timeout": 30.0},
        "keepout": [],
        "kinematics": copy.deepcopy(machine.kinematics),
        "limitAxes": True,
        "noMovesBeforeHoming": True,
        "printingAcceleration": printing,
        "queue": [
            {"gracePeriod": 0.01, "length": queue_length},
            {"gracePeriod": 0.01, "length": 5},
        ],
        "rotation": {"angle": 0.0, "centre": [0.0, 0.0]},
        "shaping": {
            "amplitudes": [],
            "damping": 0.1,
            "delays": [0.0],
            "durations": [],
            "frequency": 40.0,
            "minimumAcceleration": 10.0,
            "reductionLimit": 0.25,
            "type": "none",
        },
        "speedFactor": 1.0,
        "travelAcceleration": travel,
        "virtualEPos": 0.0,
        "workplaceNumber": 0,
        "workspaceNumber": 1,
    }


def _state(machine: Machine, axes: int) -> dict[str, Any]:
    return {
        "atxPower": True if machine.has_atx else None,
        "atxPowerPort": "pson" if machine.has_atx else None,
        "beep": None,
        "currentTool": -1,
        "deferredPowerDown": False if machine.has_atx else None,
        "displayMessage": "",
        "gpOut": [{"freq": 500, "pwm": 0.0} for _ in range(machine.gp_out)],
        "laserPwm": None,
        "logFile": "",
        "logLevel": "off",
        "machineMode": machine.mode,
        "macroRestarted": False,
        "messageBox": None,
        "msUpTime": 0,
        "nextTool": -1,
        "powerFailScript": "",
        "previousTool": -1,
        "restorePoints": [blank.restore_point(axes) for _ in range(6)],
        "startupError": None,
        "status": "starting",
        "thisActive": True,
        "thisInput": None,
        "time": BOOT_TIME,
        "upTime": 0,
    }


def _sensors(machine: Machine, axes: int) -> dict[str, Any]:
    endstops: list[dict[str, Any] | None] = [parts.endstop() for _ in range(axes)]
    if machine.has_probe:
        endstops[2] = {"highEnd": False, "probe": 0, "triggered": False, "type": "zProbeAsEndstop"}
    return {
        "analog": list(machine.sensors()),
        "endstops": endstops,
        "filamentMonitors": [parts.filament_monitor()] if machine.has_filament_monitor else [],
        "gpIn": [],
        "probes": [parts.probe()] if machine.has_probe else [],
    }


def _network(machine: Machine, wifi: bool) -> dict[str, Any]:
    interface = {
        "actualIP": "192.0.2.17",
        "firmwareVersion": "2.1.0" if wifi else None,
        "gateway": "192.0.2.1",
        "mac": "02:00:00:00:00:17",
        "ssid": "example" if wifi else None,
        "state": "active",
        "subnet": "255.255.255.0",
        "type": "wifi" if wifi else "ethernet",
    }
    if not wifi:
        del interface["firmwareVersion"], interface["ssid"]
    return {
        "corsSite": "",
        "hostname": "simulated",
        "interfaces": [interface],
        "name": machine.name,
    }


def _volumes() -> list[dict[str, Any]]:
    return [
        {
            "capacity": 15931539456,
            "freeSpace": 15710814208,
            "mounted": True,
            "openFiles": False,
            "partitionSize": 15927345152,
            "path": "0:/",
            "speed": 20000000,
        },
        {
            "capacity": None,
            "freeSpace": None,
            "mounted": False,
            "openFiles": None,
            "partitionSize": None,
            "path": "1:/",
            "speed": None,
        },
    ]


DIRECTORIES = {
    "filaments": "0:/filaments/",
    "firmware": "0:/firmware/",
    "gCodes": "0:/gcodes/",
    "macros": "0:/macros/",
    "menu": "0:/menu/",
    "scans": "0:/scans/",
    "system": "0:/sys/",
    "web": "0:/www/",
}


def full_model(machine: Machine, firmware: Firmware) -> dict[str, Any]:
    """Return a new object model of that machine, as after ``config.g``, clocks at zero."""
    board = mainboard(machine, firmware)
    move = _move(machine, board.queue_length, board.is_duet2)
    if firmware.at_least(3, 7) and move["kinematics"]["name"] == "delta":
        move["kinematics"]["name"] = "linearDelta"
    if firmware.at_least(3, 6):
        move["shaping"]["amplitudes"] = [1.0]
    axes = len(move["axes"])
    seqs: dict[str, Any] = {name: 0 for name in SEQS.split()}
    seqs["volChanges"] = [0, 0]
    model = {
        "boards": [board.model(firmware)]
        + [toolboard(address, firmware) for address in machine.tool_boards],
        "directories": dict(DIRECTORIES),
        "fans": machine.fans(),
        "global": copy.deepcopy(machine.variables),
        "heat": {
            "bedHeaters": _slots(machine.beds, board.limits["bedHeaters"]),
            "chamberHeaters": _slots(machine.chambers, board.limits["chamberHeaters"]),
            "coldExtrudeTemperature": 160.0,
            "coldRetractTemperature": 90.0,
            "heaters": machine.heaters(),
        },
        "inputs": blank.input_list(firmware, not board.is_duet2, not board.is_duet2),
        "job": blank.no_job(),
        "ledStrips": [
            {"board": 0, "pin": pin, "stopMovement": True, "type": kind}
            for pin, kind in machine.led_strips
        ],
        "limits": dict(board.limits),
        "move": move,
        "network": _network(machine, board.wifi),
        "scanner": {"progress": 0.0, "status": "D"},
        "sensors": _sensors(machine, axes),
        "seqs": seqs,
        "spindles": [parts.spindle(index < machine.spindles) for index in range(4)],
        "state": _state(machine, axes),
        "tools": _by_number(machine.tools()),
        "volumes": _volumes(),
    }
    whole: dict[str, Any] = for_firmware(model, firmware)
    return whole
