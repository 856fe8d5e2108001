"""Macro files by names that can be sent as a command, and that nothing else has."""

from __future__ import annotations

import re
from collections.abc import Iterable

KEYWORDS = frozenset(
    (
        *("abort", "break", "continue", "echo", "elif", "else", "global", "if", "param"),
        *("set", "skip", "var", "while"),
    )
)
"""What begins a line of RepRapFirmware's own language (3.5 StringParser.cpp), in lower case."""

TAKEN = frozenset(
    (
        "ACTIVATE_EXTRUDER",
        "BED_MESH_CALIBRATE",
        "BED_MESH_CLEAR",
        "BED_MESH_PROFILE",
        "BED_TILT_CALIBRATE",
        "CANCEL_PRINT",
        "DELTA_CALIBRATE",
        "EXCLUDE_OBJECT",
        "FIRMWARE_RESTART",
        "GET_POSITION",
        "PAUSE",
        "PID_CALIBRATE",
        "PROBE",
        "QUAD_GANTRY_LEVEL",
        "QUERY_ENDSTOPS",
        "QUERY_PROBE",
        "RESPOND",
        "RESTART",
        "RESTORE_GCODE_STATE",
        "RESUME",
        "SAVE_CONFIG",
        "SAVE_GCODE_STATE",
        "SDCARD_PRINT_FILE",
        "SDCARD_RESET_FILE",
        "SET_DISPLAY_TEXT",
        "SET_FAN_SPEED",
        "SET_FILAMENT_SENSOR",
        "SET_GCODE_OFFSET",
        "SET_GCODE_VARIABLE",
        "SET_HEATER_TEMPERATURE",
        "SET_PIN",
        "SET_PRESSURE_ADVANCE",
        "SET_RETRACTION",
        "SET_VELOCITY_LIMIT",
        "TURN_OFF_HEATERS",
        "Z_TILT_ADJUST",
        "_CLIENT_EXTRUDE",
        "_CLIENT_LINEAR_MOVE",
        "_CLIENT_RETRACT",
    )
)
"""Commands of Klipper's that a macro file can't stand for (``rrf.script.table``)."""

FOLDER = "0:/macros/"

PREFIX = "MACRO_"
"""In front of a name that would mean something else."""

_OTHERS = re.compile(r"[^A-Za-z0-9_]+", re.ASCII)
_COMMAND = re.compile(r"[A-Za-z_][A-Za-z_][A-Za-z0-9_]*", re.ASCII)


def macro_names(paths: Iterable[str]) -> dict[str, str]:
    """Return the full paths of macro files by the names that they have as commands.

    Whatever a command can't hold is ``_``. A name that is taken, a G-code or a word of the
    firmware's own language has a prefix; capitals don't count.

    >>> macro_names(["0:/macros/Load PLA.g", "pause.g"])
    {'Load_PLA': '0:/macros/Load PLA.g', 'MACRO_pause': '0:/macros/pause.g'}
    """
    found: dict[str, str] = {}
    taken = {"GLOBALS"}
    for path in paths:
        inner = path[len(FOLDER) :] if path.lower().startswith(FOLDER) else path
        bare = inner[: -len(".g")] if inner.lower().endswith(".g") else inner
        name = _OTHERS.sub("_", bare).strip("_")
        if not name:
            continue
        if name.upper() in TAKEN or not _COMMAND.fullmatch(name) or name.lower() in KEYWORDS:
            name = PREFIX + name
        while name.upper() in taken:
            name += "_"
        taken.add(name.upper())
        found[name] = FOLDER + inner
    return found
