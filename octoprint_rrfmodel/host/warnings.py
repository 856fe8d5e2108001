"""A warning in the form of the public contract, section 2: code, sentence, level, what mends it."""

from ..rrf.views.warnings import ADVICE, FAULT, LEVELS, POSITION_LOST, RESET, WARNING
from .warning_texts import warning_text

PRINT_PAUSED = "print_paused"
"""The code of the warning that the plugin has paused the print."""

ALL_LEVELS = {
    **LEVELS,
    RESET.code: FAULT,
    POSITION_LOST.code: FAULT,
    PRINT_PAUSED: FAULT,
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
}
"""The command of ``POST /api/plugin/rrfmodel`` that mends what a warning is about."""


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
