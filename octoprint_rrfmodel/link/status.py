"""The plugin's state, as ``GET /plugin/rrfmodel/status`` and every push tell it."""

from ..rrf.gcode.doing import OTHER
from ..rrf.wire.masking import masked

UNIMPORTANT = frozenset(("age", "ages", "at", "revision", "counters", "doing", "heater_ages"))
"""Members of the state that change all the time and are worth no message of their own."""


def worth_telling(status):
    """Return what of the state is worth a message when it changes."""
    told = {name: value for name, value in status.items() if name not in UNIMPORTANT}
    doing = status.get("doing")
    # the lines of a print are through before anybody has read of them
    told["doing"] = doing["command"] if doing and doing["what"] != OTHER else None
    return told


class PluginStatus:
    """Puts the state together from those who know its parts; any thread may ask.

    ``link`` is the line to the board, ``poller`` asks it, ``known`` is what has come of that.
    ``warnings()`` are the warnings in their form, ``is_first_run()`` whether the wizard is due,
    ``heater_ages()`` how old each temperature is that the line has told, ``simulated_file()`` what
    was simulated last, ``jobs()`` another number after each change of the jobs that are kept,
    ``beside()`` whether a board on a cable has been found on the network, too.
    """

    def __init__(self, version, link, poller, *, known, **told):
        self._version = version
        self._link = link
        self._poller = poller
        self._known = known
        self._warnings = told["warnings"]
        self._is_first_run = told["is_first_run"]
        self._heater_ages = told["heater_ages"]
        self._simulated_file = told["simulated_file"]
        self._jobs = told["jobs"]
        self._beside = told["beside"]

    def __call__(self):
        """Return the state in the shape of the public contract, section 2."""
        poller, link, age = self._poller, self._link, self._known.age()
        follower = poller.follower
        return {
            "version": self._version(),
            "connected": link.is_operational,
            "is_rrf": link.is_rrf,
            "protocol": follower.protocol and (link.protocol or follower.protocol),
            "firmware": self._firmware() if link.is_rrf else None,
            "ready": follower.ready,
            "stale": poller.is_stale(),
            "blocked": poller.why_silent(),
            "age": None if age is None else round(age, 2),
            "ages": self._known.ages(),
            "at": round(self._known.now(), 3),
            "revision": follower.store.revision,
            "resets": follower.resets,
            "counters": {
                "polls": poller.polls,
                "bytes": poller.bytes,
                "rewritten": link.rewritten,
                **follower.counters,
            },
            "too_large": list(follower.too_large),
            "warnings": self._warnings(),
            "link": link.kind,
            "beside": self._beside(),
            "doing": self._doing(),
            "heater_ages": self._heater_ages(),
            "simulated_file": self._simulated_file(),
            "jobs": self._jobs(),
            "first_run": self._is_first_run(),
        }

    def _doing(self):
        doing = self._link.doing()
        if doing is None:
            return None
        since = max(0.0, self._known.now() - doing.since)
        return {"command": masked(doing.command), "what": doing.what, "since": round(since, 1)}

    def _firmware(self):
        """Return what M115 told; the model's version wins, it survives a firmware update."""
        boards = self._known.model().get("boards")
        board = boards[0] if boards and isinstance(boards[0], dict) else {}
        said = self._link.reported.get
        return {
            "name": board.get("firmwareName") or said("FIRMWARE_NAME"),
            "version": board.get("firmwareVersion") or said("FIRMWARE_VERSION"),
            "electronics": said("ELECTRONICS") or board.get("name"),
            "date": board.get("firmwareDate") or said("FIRMWARE_DATE"),
        }
