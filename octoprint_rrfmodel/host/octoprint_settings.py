"""OctoPrint's settings that matter for RepRapFirmware: checked, set on request, and set back."""

import logging
import threading
from typing import NamedTuple

from ..rrf.gcode.blocking import BLOCKING
from .version import IS_2

KNOWN_TO_WAIT = frozenset(("M109", "M116", "M190", "M191"))
"""Commands for which OctoPrint waits without being told (``_gcode_M109_sent`` and the like)."""

SPELLED = (
    "M20",
    "M23",
    "M28",
    "M30",
    "M32",
    "M36",
    "M37",
    "M38",
    "M98",
    "M117",
    "M118",
    "M291",
    "M292",
    "M408",
    "M409",
    "M470",
    "M471",
    "M486",
    "M505",
    "M550",
    "M551",
    "M563",
    "M586",
    "M587",
    "M588",
    "M589",
    "M701",
    "M703",
    "M929",
)
"""Commands with names and texts in which case matters."""


class Need(NamedTuple):
    """One line of the table."""

    code: str
    """Of the warning where it isn't met."""
    path_1: tuple
    """Where OctoPrint 1.11 has the setting."""
    path_2: tuple
    """Where OctoPrint 2.0 has it; what is written to ``serial`` there is lost without a word."""
    codes: tuple = ()
    """What a list has to hold."""
    value: object = None
    """What anything but a list has to be."""

    @property
    def path(self):
        """Where this OctoPrint has the setting."""
        return list(self.path_2 if IS_2 else self.path_1)


def _of_line(code, name, **wanted):
    return Need(code, ("serial", name), ("plugins", "serial_connector", name), **wanted)


NEEDS = (
    # otherwise a macro that takes long counts as a printer that is silent
    _of_line(
        "long_running_commands",
        "longRunningCommands",
        codes=tuple(sorted(BLOCKING - KNOWN_TO_WAIT)),
    ),
    Need(
        "uppercase",
        ("feature", "autoUppercaseBlacklist"),
        ("feature", "autoUppercaseBlocklist"),
        codes=SPELLED,
    ),
    # T-1, echo, set and the like are acknowledged and OctoPrint takes them for no commands
    _of_line("unknown_commands", "unknownCommandsNeedAck", value=True),
    # temperatures come unasked while a command blocks (3.5 GCodes.cpp:4865)
    _of_line("external_heatup", "externalHeatupDetection", value=False),
)


AT_CONNECTION = frozenset(("long_running_commands", "unknown_commands"))
"""Codes of what OctoPrint reads only when it connects (1.11 comm.py:584, :680, 2.0 the same)."""


class OctoPrintSettings:
    """Knows what is missing, sets it, and sets back exactly that.

    ``settings()`` are the plugin's, which lead to OctoPrint's. ``changes`` is where what was
    changed is written down.
    """

    def __init__(self, settings, changes):
        self._settings = settings
        self._changes = changes
        self._lock = threading.Lock()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.octoprint_settings")
        self.missing = ()
        """The codes of the warnings, as they were when last looked."""
        self._connected_without = frozenset()

    def look(self):
        """Find out what is missing."""
        self.missing = tuple(need.code for need in NEEDS if self._lacks(need))

    def connected(self):
        """Look at what is missing, and note that the connection goes by that."""
        self.look()
        self._connected_without = AT_CONNECTION.intersection(self.missing)

    def awaits_connection(self):
        """Return whether something is set by now that this connection goes without."""
        return bool(self._connected_without.difference(self.missing))

    def table(self):
        """Return each setting that matters: code, path, value now and wanted, and whether it fits.

        Of a list only what has to be in it is told: codes that are missing now, and all wanted.
        """
        rows = []
        for need in NEEDS:
            value = self._settings().global_get(need.path)
            lacking = [code for code in need.codes if code not in (value or ())]
            rows.append(
                {
                    "code": need.code,
                    "setting": ".".join(need.path),
                    "now": list(value or ()) if need.codes else value,
                    "wanted": list(need.codes) if need.codes else need.value,
                    "missing": lacking,
                    "fulfilled": not self._lacks(need),
                }
            )
        return rows

    def fix(self):
        """Set what is missing and write down what was changed."""
        with self._lock:
            changes = self._changes.read()
            for need in NEEDS:
                if self._lacks(need):
                    self._fix(need, changes.setdefault(need.code, {}))
            self._changes.write(changes)
            self._save()

    def restore(self):
        """Take back what was changed and has not been changed since."""
        with self._lock:
            changes = self._changes.read()
            for need in NEEDS:
                if need.code in changes:
                    self._restore(need, changes[need.code])
            if changes:
                self._save()
                self._changes.forget()

    def _lacks(self, need):
        value = self._settings().global_get(need.path)
        if need.codes:
            return not set(need.codes) <= set(value or ())
        return value is not need.value

    def _fix(self, need, change):
        settings = self._settings()
        value = settings.global_get(need.path)
        if need.codes:
            added = [code for code in need.codes if code not in (value or ())]
            change["added"] = change.get("added", []) + added
            settings.global_set(need.path, [*(value or ()), *added])
        else:
            change["old"] = value
            settings.global_set(need.path, need.value)
        self._logger.info("Changed %s: %s", ".".join(need.path), change)

    def _restore(self, need, change):
        settings = self._settings()
        value = settings.global_get(need.path)
        if need.codes:
            left = [code for code in value or () if code not in change["added"]]
            settings.global_set(need.path, left)
        elif value is need.value:
            settings.global_set(need.path, change["old"])
        self._logger.info("Changed %s back", ".".join(need.path))

    def _save(self):
        self._settings().save(trigger_event=True)
        self.look()
