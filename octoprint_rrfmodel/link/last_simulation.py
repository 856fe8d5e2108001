"""Whether the board's last job was only simulated, which its model doesn't tell over a line."""


class LastSimulation:
    """Remembers the file that was simulated last, until something is printed (a listener).

    ``model()`` is the snapshot; noted by the worker, read by any thread.
    """

    def __init__(self, model):
        self._model = model
        self._file = None

    def replied(self, taken, asked_at):
        """Look at what the board does with its file."""
        model = self._model()
        status = (model.get("state") or {}).get("status")
        if status == "simulating":
            file = (model.get("job") or {}).get("file") or {}
            self._file = file.get("fileName") or self._file
        elif status == "processing":
            self._file = None

    def reset(self):
        """Forget it: the board began anew."""
        self._file = None

    def forgotten(self):
        """Forget it: the connection is gone."""
        self._file = None

    def __call__(self):
        """Return the file's path on the card, ``None`` where none was simulated."""
        return self._file
