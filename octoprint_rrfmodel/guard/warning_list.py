"""What a person should know or change: codes, sentences, and the command that mends it."""

from ..host.warning_texts import paused_text, waiting_text, warning_text
from ..rrf.views.warnings import (
    ADVICE,
    FAULT,
    LEVELS,
    POSITION_LOST,
    RESET,
    UNANSWERABLE,
    WARNING,
    alerts,
)

PRINT_PAUSED = "print_paused"

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
    "long_running_commands": "fix_settings",
    "uppercase": "fix_settings",
    "unknown_commands": "fix_settings",
    "external_heatup": "fix_settings",
    "profile_tools": "fix_profile",
}
"""The command of ``POST /api/plugin/rrfmodel`` that mends what a warning is about."""


class Advice:
    """Puts the warnings together; any thread may ask.

    ``model()`` is the snapshot, ``is_rrf()`` says whether RepRapFirmware is at the other end,
    ``is_operational()`` whether any printer is. The others know what is to be told.
    """

    def __init__(self, model, is_rrf, is_operational, guard, recovery, settings, profile, box):
        self._model = model
        self._is_rrf = is_rrf
        self._is_operational = is_operational
        self._guard = guard
        self._recovery = recovery
        self._settings = settings
        self._profile = profile
        self._box = box

    def __call__(self):
        """Return the warnings, the worst first, in the form of the public contract, section 2."""
        if not self._is_rrf():
            was_halted = self._recovery.is_wanted and not self._is_operational()
            return [warning("halted")] if was_halted else []
        found = alerts(self._model(), self._guard.has_print())
        found += [cause for cause in self._guard.causes() if cause not in found]
        if self._box.is_open and UNANSWERABLE not in found:
            found.append(UNANSWERABLE)
        codes = [*self._settings.missing, self._profile.problem()]
        warnings = [
            *self._paused(),
            *map(_of_alert, found),
            *(warning(code) for code in codes if code),
        ]
        return sorted(warnings, key=lambda told: ORDER.index(told["level"]))

    def _paused(self):
        pause = self._guard.pause()
        if pause is None:
            return []
        causes = [_of_alert(cause) for cause in pause.causes]
        why = waiting_text(pause.message) if pause.message else _sentences(causes)
        return [
            {
                "code": PRINT_PAUSED,
                "text": paused_text(why, pause.what_next),
                "level": ALL_LEVELS[PRINT_PAUSED],
                "values": {"next": pause.what_next, "message": pause.message},
                "causes": causes,
            }
        ]


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


def _of_alert(alert):
    return warning(alert.code, alert.values, alert.name)


def _sentences(warnings):
    return " ".join(told["text"] for told in warnings)
