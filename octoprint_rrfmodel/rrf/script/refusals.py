"""Klipper's commands that have no counterpart, and why: codes of sentences."""

from __future__ import annotations

BY_HAND = "macro_by_hand"
IN_CONFIG = "macro_in_config"
OF_FILES = "macro_of_files"
RESONANCES = "macro_resonances"

REFUSALS = {
    # manual probing, step by step: RepRapFirmware asks by message boxes instead
    **dict.fromkeys(
        (
            "ABORT",
            "ACCEPT",
            "ADJUSTED",
            "AXIS_TWIST_COMPENSATION_CALIBRATE",
            "BED_SCREWS_ADJUST",
            "MANUAL_PROBE",
            "PROBE_CALIBRATE",
            "SCREWS_TILT_CALCULATE",
            "TESTZ",
            "Z_ENDSTOP_CALIBRATE",
        ),
        BY_HAND,
    ),
    **dict.fromkeys(
        (
            "SET_EXTRUDER_ROTATION_DISTANCE",
            "SET_IDLE_TIMEOUT",
            "SET_INPUT_SHAPER",
            "SET_LED",
            "SET_STEPPER_ENABLE",
            "SET_TEMPERATURE_FAN_TARGET",
            "SET_TMC_CURRENT",
            "Z_OFFSET_APPLY_ENDSTOP",
            "Z_OFFSET_APPLY_PROBE",
        ),
        IN_CONFIG,
    ),
    **dict.fromkeys(
        (
            "EXCLUDE_OBJECT_DEFINE",
            "EXCLUDE_OBJECT_END",
            "EXCLUDE_OBJECT_START",
            "SET_PRINT_STATS_INFO",
        ),
        OF_FILES,
    ),
    **dict.fromkeys(("MEASURE_AXES_NOISE", "SHAPER_CALIBRATE", "TEST_RESONANCES"), RESONANCES),
}
"""Command to the code of its sentence; any other that nobody knows has one of its own."""
