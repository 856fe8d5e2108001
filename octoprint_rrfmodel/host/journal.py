"""What was changed of OctoPrint's own, written down so that it can be taken back."""

import json
from pathlib import Path


class Journal:
    """A file in OctoPrint's own folder, and not in the plugin's settings: OctoPrint's settings
    page would write those back as it found them.

    Nor in the plugin's data folder: the plugin manager's "clean up" deletes that of a plugin that
    is still there and has to take things back when it goes. ``base()`` is OctoPrint's folder,
    ``folder()`` the plugin's own, where older versions wrote; ``name`` is what the file is called.
    """

    def __init__(self, base, folder, name):
        self._base = base
        self._folder = folder
        self._name = name

    def read(self):
        """Return what is written down, an empty dictionary where nothing is."""
        for file in self._files():
            if file.exists():
                return json.loads(file.read_text(encoding="utf-8"))
        return {}

    def write(self, changes):
        """Write down all changes, older ones included; what was written before stays till then."""
        file, *older = self._files()
        new = file.with_suffix(".new")
        new.write_text(json.dumps(changes), encoding="utf-8")
        new.replace(file)
        for each in older:
            each.unlink(missing_ok=True)

    def forget(self):
        """Guarantee that nothing is written down."""
        for file in self._files():
            file.unlink(missing_ok=True)

    def _files(self):
        return Path(self._base()) / f"rrfmodel_{self._name}", Path(self._folder()) / self._name
