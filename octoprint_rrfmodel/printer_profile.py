"""The printer profile's number of extruders: OctoPrint drops commands for tools beyond it."""

from .rrf.machine import Machine


class PrinterProfile:
    """Compares the profile with the machine's tools and raises its number of extruders.

    ``profiles()`` is OctoPrint's manager of profiles, ``connection()`` its connection to
    RepRapFirmware or ``None``, ``model()`` the snapshot.
    """

    def __init__(self, profiles, connection, model):
        self._profiles = profiles
        self._connection = connection
        self._model = model

    def problem(self):
        """Return the code of the warning that is due, ``None`` where there is none."""
        comm = self._connection()
        needed = self._needed()
        if comm is None or not needed:
            return None
        if _count(self._profiles().get_current_or_default()) < needed:
            return "profile_tools"
        # 2.0 keeps the profile that the connection was made with
        if _count(getattr(comm, "_printer_profile", None), needed) < needed:
            return "profile_reconnect"
        return None

    def fix(self):
        """Give the profile as many extruders as the machine's tool numbers need."""
        profiles = self._profiles()
        profile = profiles.get_current_or_default()
        missing = self._needed() - _count(profile)
        if missing <= 0:
            return
        extruder = profile["extruder"]
        offsets = [*extruder["offsets"], *[(0.0, 0.0)] * missing]
        changed = {
            **profile,
            "extruder": {**extruder, "count": self._needed(), "offsets": offsets},
        }
        profiles.save(changed, allow_overwrite=True, trigger_event=True)

    def _needed(self):
        return max(Machine(self._model()).tools, default=-1) + 1


def _count(profile, otherwise=0):
    return profile["extruder"]["count"] if profile else otherwise
