"""The printer profile, and what the model says of it.

OctoPrint drops commands for tools beyond its number of extruders.
"""

import copy
import logging
import threading

from .rrf.machine import Machine
from .rrf.profile import profile_values

NO_OFFSET = (0.0, 0.0)


class PrinterProfile:
    """Compares the profile with the machine's tools, raises its number of extruders, lowers it.

    ``profiles()`` is OctoPrint's manager of profiles, ``connection()`` its connection to
    RepRapFirmware or ``None``, ``model()`` the snapshot. ``changes`` is where what was changed is
    written down.
    """

    def __init__(self, profiles, connection, model, changes):
        self._profiles = profiles
        self._connection = connection
        self._model = model
        self._changes = changes
        self._lock = threading.Lock()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.printer_profile")

    def problem(self):
        """Return the code of the warning that is due, ``None`` where there is none."""
        comm = self._connection()
        needed = self._needed()
        if comm is None or not needed:
            return None
        if _count(self._profiles().get_current_or_default()) < needed:
            return "profile_tools"
        if _count(profile_of(comm, self._profiles())) < needed:
            return "profile_reconnect"
        return None

    def fix(self):
        """Give the profile as many extruders as the machine's tool numbers need."""
        with self._lock:
            profile = self._profiles().get_current_or_default()
            count, needed = _count(profile), self._needed()
            if count >= needed:
                return
            changes = self._changes.read()
            known = changes.get(profile["id"], {})
            is_raised_again = known.get("new") == count
            old = known["old"] if is_raised_again else count
            known = {**known, "old": old, "new": needed}
            self._changes.write({**changes, profile["id"]: known})
            self._set_count(profile, needed)

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
            changed = copy.deepcopy(profile)
            changes = self._changes.read()
            log = changes.setdefault(profile["id"], {}).setdefault("fields", {})
            for path in fields:
                _put(changed, path, wanted[path])
            self._save(changed)
            # a form brings its origin with it: OctoPrint changes what goes along
            saved = self._profiles().get(profile["id"])
            for path in wanted:
                old, new = _at(profile, path), _at(saved, path)
                if not _is_same(old, new):
                    known = log.get(path)
                    is_ours = known is not None and _is_same(known["new"], old)
                    log[path] = {"old": known["old"] if is_ours else old, "new": new}
            self._changes.write(changes)
        return []

    def restore(self):
        """Take back what was written to profiles and nobody has changed since."""
        with self._lock:
            for name, change in self._changes.read().items():
                profile = self._profiles().get(name)
                fields = change.pop("fields", {})
                if profile and fields:
                    profile = copy.deepcopy(profile)
                    for path, values in fields.items():
                        if _is_same(_at(profile, path), values["new"]):
                            _put(profile, path, values["old"])
                    self._save(profile)
                if change and _is_as_raised(profile, **change):
                    self._set_count(profile, change["old"])
            self._changes.forget()

    def _wanted(self, profile):
        wanted = profile_values(self._model())
        # somebody may have given it more
        if wanted.get("extruder.count", 0) < _count(profile):
            wanted.pop("extruder.count", None)
        return wanted

    def _save(self, profile):
        extruder = profile["extruder"]
        count = extruder["count"]
        extruder["offsets"] = [*extruder["offsets"], *[NO_OFFSET] * count][:count]
        self._profiles().save(profile, allow_overwrite=True, trigger_event=True)
        self._logger.info("Changed the printer profile %s", profile["id"])

    def _set_count(self, profile, count):
        extruder = profile["extruder"]
        offsets = [*extruder["offsets"], *[NO_OFFSET] * count][:count]
        changed = {**profile, "extruder": {**extruder, "count": count, "offsets": offsets}}
        self._profiles().save(changed, allow_overwrite=True, trigger_event=True)
        self._logger.info("Changed the extruders of profile %s to %s", profile["id"], count)

    def _needed(self):
        return max(Machine(self._model()).tools, default=-1) + 1


def profile_of(comm, profiles):
    """Return the profile that a connection goes by: 2.0 keeps the one that it was made with."""
    return getattr(comm, "_printer_profile", None) or profiles.get_current_or_default()


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
    is_number = type(now) in (int, float) and type(wanted) in (int, float)
    return abs(now - wanted) < 0.05 if is_number else now == wanted


def _is_as_raised(profile, old, new):
    """Return whether the profile still has the number that was set, and no use for it."""
    if _count(profile) != new:
        return False
    return all(tuple(offset) == NO_OFFSET for offset in profile["extruder"]["offsets"][old:])


def _count(profile, otherwise=0):
    return profile["extruder"]["count"] if profile else otherwise
