"""A warning in the form of the public contract, section 2: code, sentence, level, what mends it."""

from ..rrf.views.warnings import ADVICE, FAULT, LEVELS, POSITION_LOST, RESET, WARNING
from ..rrf.wire.refusals import CODES as REFUSALS
from .warning_texts import warning_text

PRINT_PAUSED = "print_paused"
"""The code of the warning that the plugin has paused the print."""

FILE_PAUSES = ("file_pause", "file_filament")
"""Codes of a file's own pauses."""

ALL_LEVELS = {
    **LEVELS,
    RESET.code: FAULT,
    POSITION_LOST.code: FAULT,
    PRINT_PAUSED: FAULT,
    **dict.fromkeys((*REFUSALS, *FILE_PAUSES, "file_blocks"), FAULT),
    "file_quotes": WARNING,
    "mqtt_topic": WARNING,
}
"""How much each warning matters; those that aren't here are advice."""

ORDER = (FAULT, WARNING, ADVICE)

FIXES = {
    "halted": "recover",
    "message_box_unanswerable": "recover",
    "long_running_commands": "fix_settings",
    "uppercase": "fix_settings",
    "unknown_commands": "fix_settings",
    "external_heatup": "fix_settings",
    "profile_tools": "fix_profile",
    "settings_reconnect": "reconnect",
    "profile_reconnect": "reconnect",
}
"""The command of ``POST /api/plugin/rrfmodel`` that mends what a warning is about."""


def worst_first(warnings):
    """Return warnings in the order of their levels."""
    return sorted(warnings, key=lambda told: ORDER.index(told["level"]))


def warning(code, values=None, name=None):
    """Return a warning in the form of the public contract; ``name`` tells it from its like."""
    told = {
        "code": name or code,
        "text": warning_text(code, values),
        "level": ALL_LEVELS.get(code, ADVICE),
    }
    if values:
        told["values"] = values
    if code in FIXES:
        told["fix"] = FIXES[code]
    return told
