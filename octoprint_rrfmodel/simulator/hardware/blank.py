"""The parts of an object model that the firmware fills in itself: inputs, job, restore points."""

from __future__ import annotations

from typing import Any

from ..firmware import Firmware

USB = "USB"
"""The channel that a host talks on."""

INPUT_NAMES = (
    "HTTP",
    "Telnet",
    "File",
    USB,
    "Aux",
    "Trigger",
    "Queue",
    "LCD",
    "SBC",
    "Daemon",
    "Aux2",
    "Autopause",
    "File2",
    "Queue2",
    "USB2",
)
"""Channels in the order of their index in ``inputs`` (RRF 3.5 GCodeChannel.h).

The last one stands for the second channel over USB of 3.7 (RRF #1156), whose name and place were
not to be had.
"""

USB_CHANNELS = (USB, "USB2")
INPUTS_SINCE_35 = ("File2", "Queue2")
INPUTS_SINCE_37 = ("USB2",)
MARLIN_CHANNELS = ("Telnet", *USB_CHANNELS)
"""The channels that start in Marlin compatibility (RRF 3.5 GCodes.cpp:110, 122)."""

NO_TAPER = float("nan")
"""``fadeHeight`` without taper: a number that prints as null, shown without ``n`` (Move.cpp)."""


def gcode_input(name: str) -> dict[str, Any]:
    return {
        "active": True,
        "axesRelative": False,
        "compatibility": "Marlin" if name in MARLIN_CHANNELS else "RepRapFirmware",
        "distanceUnit": "mm",
        "drivesRelative": True,
        "feedRate": 50.0,
        "inMacro": False,
        "inverseTimeMode": False,
        "lineNumber": 0,
        "macroRestartable": False,
        "motionSystem": 0,
        "name": name,
        "selectedPlane": 0,
        "stackDepth": 0,
        "state": "idle",
        "volumetric": False,
    }


def restore_point(axes: int) -> dict[str, Any]:
    return {
        "coords": [0.0] * axes,
        "extruderPos": 0.0,
        "fanPwm": 0.0,
        "feedRate": 50.0,
        "ioBits": 0,
        "laserPwm": None,
        "toolNumber": -1,
    }


def no_file() -> dict[str, Any]:
    """Return ``job.file`` while no file is selected."""
    return {
        "customInfo": {},
        "filament": [],
        "fileName": None,
        "firstLayerHeight": 0.0,
        "generatedBy": None,
        "height": 0.0,
        "lastModified": None,
        "layerHeight": 0.0,
        "numLayers": 0,
        "printTime": None,
        "simulatedTime": None,
        "size": 0,
        "thumbnails": [],
    }


def no_job() -> dict[str, Any]:
    """Return ``job`` while nothing is printing."""
    return {
        "build": None,
        "duration": None,
        "file": no_file(),
        "filePosition": 0,
        "firstLayerDuration": None,
        "lastDuration": 0,
        "lastFileName": None,
        "lastWarmUpDuration": 0,
        "layer": None,
        "layerTime": None,
        "pauseDuration": None,
        "rawExtrusion": None,
        "timesLeft": {"filament": None, "file": None, "layer": None, "slicer": None},
        "warmUpDuration": None,
    }


def input_list(firmware: Firmware, has_sbc: bool, aux2: bool) -> list[dict[str, Any] | None]:
    """Return ``inputs``; channels that the board doesn't have are null, later ones are missing."""
    missing = {"SBC": not has_sbc, "Aux2": not aux2, "File2": not aux2, "Queue2": not aux2}
    later: set[str] = set()
    if not firmware.at_least(3, 7):
        later.update(INPUTS_SINCE_37)
    if not firmware.at_least(3, 5):
        later.update(INPUTS_SINCE_35)
    names = [n for n in INPUT_NAMES if n not in later]
    return [None if missing.get(name) else gcode_input(name) for name in names]
