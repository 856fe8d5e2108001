"""The printer profile's number of extruders: OctoPrint drops commands for tools beyond it."""

import logging
import threading

from .rrf.machine import Machine

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
            known = changes.get(profile["id"])
            is_raised_again = known is not None and known["new"] == count
            old = known["old"] if is_raised_again else count
            self._changes.write({**changes, profile["id"]: {"old": old, "new": needed}})
            self._set_count(profile, needed)

    def restore(self):
        """Take back what was raised in profiles that nobody has changed since."""
        with self._lock:
            for name, change in self._changes.read().items():
                profile = self._profiles().get(name)
                if _is_as_raised(profile, **change):
                    self._set_count(profile, change["old"])
            self._changes.forget()

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


def _is_as_raised(profile, old, new):
    """Return whether the profile still has the number that was set, and no use for it."""
    if _count(profile) != new:
        return False
    return all(tuple(offset) == NO_OFFSET for offset in profile["extruder"]["offsets"][old:])


def _count(profile, otherwise=0):
    return profile["extruder"]["count"] if profile else otherwise
