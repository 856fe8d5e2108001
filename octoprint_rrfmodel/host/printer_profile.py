"""The printer profile, and what the model says of it.

OctoPrint drops commands for tools beyond its number of extruders.
"""

import copy
import logging
import threading

from ..rrf.views.machine import Machine
from ..rrf.views.profile import MOST_EXTRUDERS, profile_values

NO_OFFSET = (0.0, 0.0)

COUNT = "extruder.count"

OFFSETS = "extruder.offsets"

ADAPTED = ("volume.origin", "volume.depth", "volume.custom_box", OFFSETS)
"""What OctoPrint fits by itself to what is written: to a round form, a size, a shared nozzle."""


def takes_tool_numbers(profile):
    """Return whether OctoPrint sends targets with the number of a tool; without a profile it may.

    It doesn't where there is one extruder or one nozzle (printer/standard.py, set_temperature).
    """
    extruder = (profile or {}).get("extruder") or {}
    return extruder.get("count", 2) > 1 and not extruder.get("sharedNozzle")


class PrinterProfile:
    """Compares the profile with the machine's tools, raises its number of extruders, lowers it.

    ``profiles()`` is OctoPrint's manager of profiles, ``in_use()`` the profile that the connection
    to RepRapFirmware goes by or ``None``, ``model()`` the snapshot. ``changes`` is where what was
    changed is written down.
    """

    def __init__(self, profiles, in_use, model, *, changes):
        self._profiles = profiles
        self._in_use = in_use
        self._model = model
        self._changes = changes
        self._lock = threading.Lock()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.printer_profile")

    def problem(self):
        """Return the code of the warning that is due, ``None`` where there is none."""
        in_use = self._in_use()
        needed = self._needed()
        if in_use is None or not needed:
            return None
        if _count(self._profiles().get_current_or_default()) < needed:
            return "profile_tools"
        if _count(in_use) < needed:
            return "profile_reconnect"
        return None

    def fix(self):
        """Give the profile as many extruders as the machine's tool numbers need."""
        with self._lock:
            profile, needed = self._profiles().get_current_or_default(), self._needed()
            if _count(profile) < needed:
                self._write(profile, {COUNT: needed})

    def differences(self):
        """Return what the model says otherwise: path, value now and value wanted of each."""
        profile = self._profiles().get_current_or_default()
        return [
            {"field": path, "now": _at(profile, path), "wanted": value}
            for path, value in self._wanted(profile).items()
            if not _is_same(_at(profile, path), value)
        ]

    def write(self, fields):
        """Give the profile the model's values of these fields; return those that are unknown."""
        with self._lock:
            profile = self._profiles().get_current_or_default()
            wanted = self._wanted(profile)
            unknown = [path for path in fields if path not in wanted]
            if unknown:
                return unknown
            self._write(profile, {path: wanted[path] for path in fields})
        return []

    def restore(self):
        """Take back what was written to profiles and nobody has changed since."""
        with self._lock:
            for name, log in self._logs().items():
                profile = self._profiles().get(name)
                old = {
                    path: change["old"]
                    for path, change in log.items()
                    if profile and _is_as_written(profile, path, change)
                }
                if old:
                    self._save(profile, old)
            self._changes.forget()

    def _write(self, profile, values):
        """Write values, and down what has become of the profile."""
        self._save(profile, values)
        saved = self._profiles().get(profile["id"])
        logs = self._logs()
        log = logs.setdefault(profile["id"], {})
        for path in dict.fromkeys((*values, *ADAPTED)):
            old, new = _at(profile, path), _at(saved, path)
            if not _is_same(old, new):
                known = log.get(path)
                is_ours = known is not None and _is_same(known["new"], old)
                log[path] = {"old": known["old"] if is_ours else old, "new": new}
        self._changes.write({name: {"fields": log} for name, log in logs.items()})

    def _logs(self):
        """Return what was changed, by profile and path; older files have extruders apart."""
        logs = {}
        for name, change in self._changes.read().items():
            logs[name] = dict(change.get("fields", {}))
            if "old" in change:
                logs[name].setdefault(COUNT, {"old": change["old"], "new": change["new"]})
        return logs

    def _wanted(self, profile):
        wanted = profile_values(self._model())
        # somebody may have given it more
        if wanted.get(COUNT, 0) < _count(profile):
            wanted.pop(COUNT, None)
        return wanted

    def _save(self, profile, values):
        changed = copy.deepcopy(profile)
        for path, value in values.items():
            _put(changed, path, value)
        extruder = changed["extruder"]
        count = extruder["count"]
        extruder["offsets"] = [*extruder["offsets"], *[NO_OFFSET] * count][:count]
        self._profiles().save(changed, allow_overwrite=True, trigger_event=True)
        self._logger.info("Changed profile %s: %s", profile["id"], values)

    def _needed(self):
        numbers = Machine(self._model()).tools
        return max((number for number in numbers if number < MOST_EXTRUDERS), default=-1) + 1


def _at(profile, path):
    for name in path.split("."):
        profile = profile.get(name) if isinstance(profile, dict) else None
    return profile


def _put(profile, path, value):
    *parents, last = path.split(".")
    for name in parents:
        profile = profile.setdefault(name, {})
    profile[last] = value


def _is_same(now, wanted):
    """Return whether two values of a profile mean the same; lengths come as int and as float."""
    if isinstance(now, dict) and isinstance(wanted, dict):
        return all(_is_same(now.get(name), wanted[name]) for name in wanted)
    if isinstance(now, (list, tuple)) and isinstance(wanted, (list, tuple)):
        return _used(now) == _used(wanted)
    is_number = type(now) in (int, float) and type(wanted) in (int, float)
    return abs(now - wanted) < 0.05 if is_number else now == wanted


def _used(offsets):
    """Return offsets without those at the end that are none."""
    pairs = [tuple(map(float, pair)) for pair in offsets]
    while pairs and pairs[-1] == NO_OFFSET:
        pairs.pop()
    return pairs


def _is_as_written(profile, path, change):
    """Return whether a field still has the value that was written, and no use for it."""
    if not _is_same(_at(profile, path), change["new"]):
        return False
    return path != COUNT or len(_used(_at(profile, OFFSETS))) <= change["old"]


def _count(profile, otherwise=0):
    return profile["extruder"]["count"] if profile else otherwise
