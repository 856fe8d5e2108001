"""The plugin's state, as ``GET /plugin/rrfmodel/status`` and every push tell it."""


class PluginStatus:
    """Puts the state together from those who know its parts; any thread may ask."""

    def __init__(self, version, bridge, poller, follower, is_connected, warnings, first_run, clock):
        self._version = version
        self._bridge = bridge
        self._poller = poller
        self._follower = follower
        self._is_connected = is_connected
        self._warnings = warnings
        self._first_run = first_run
        self._clock = clock
        self._reported = {}

    def reported(self, data):
        """Note what the printer said about its firmware in answer to M115."""
        self._reported = dict(data or {})

    def __call__(self):
        """Return the state in the shape of the public contract, section 2."""
        follower, poller = self._follower, self._poller
        applied_at = poller.applied_at
        now = self._clock()
        age = None if applied_at is None else round(now - applied_at, 2)
        return {
            "version": self._version(),
            "connected": self._is_connected(),
            "is_rrf": self._bridge.is_rrf,
            "protocol": follower.protocol,
            "firmware": self._firmware() if self._bridge.is_rrf else None,
            "ready": follower.ready,
            "stale": poller.is_stale(),
            "blocked": poller.blocked(),
            "age": age,
            "at": round(now, 3),
            "revision": follower.store.revision,
            "resets": follower.resets,
            "counters": {
                "polls": poller.polls,
                "bytes": poller.bytes,
                "rewritten": self._bridge.rewritten,
                **follower.counters,
            },
            "warnings": self._warnings(),
            "first_run": self._first_run(),
        }

    def _firmware(self):
        """Return what M115 told; the model's version wins, it survives a firmware update."""
        boards = self._follower.store.model.get("boards")
        board = boards[0] if boards and isinstance(boards[0], dict) else {}
        said = self._reported.get
        return {
            "name": board.get("firmwareName") or said("FIRMWARE_NAME"),
            "version": board.get("firmwareVersion") or said("FIRMWARE_VERSION"),
            "electronics": said("ELECTRONICS") or board.get("name"),
            "date": board.get("firmwareDate") or said("FIRMWARE_DATE"),
        }
