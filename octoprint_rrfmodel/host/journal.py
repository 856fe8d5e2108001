"""What was changed of OctoPrint's own, written down so that it can be taken back."""

import json
from pathlib import Path


class Journal:
    """A file in the plugin's folder, and not in its settings: OctoPrint's settings page would
    write those back as it found them.

    ``folder()`` is the plugin's own, ``name`` what the file is called.
    """

    def __init__(self, folder, name):
        self._folder = folder
        self._name = name

    def read(self):
        """Return what is written down, an empty dictionary where nothing is."""
        file = self._file()
        return json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}

    def write(self, changes):
        """Write down all changes, older ones included."""
        self._file().write_text(json.dumps(changes), encoding="utf-8")

    def forget(self):
        """Guarantee that nothing is written down."""
        self._file().unlink(missing_ok=True)

    def _file(self):
        return Path(self._folder()) / self._name
