"""What a person should know or change: codes, sentences, and the command that mends it."""

from .notices import warning_text
from .rrf.alerts import UNANSWERABLE, alerts

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
            return [_warning("halted")] if was_halted else []
        found = alerts(self._model())
        # some things are no matter of concern without a print
        found += [cause for cause in self._guard.causes() if cause not in found]
        if self._box.is_open and UNANSWERABLE not in found:
            found.append(UNANSWERABLE)
        codes = [*self._settings.missing, self._profile.problem()]
        return [
            *(_warning(alert.code, alert.numbers, alert.name) for alert in found),
            *(_warning(code) for code in codes if code),
        ]


def _warning(code, numbers=(), name=None):
    warning = {"code": name or code, "text": warning_text(code, numbers)}
    if code in FIXES:
        warning["fix"] = FIXES[code]
    return warning
