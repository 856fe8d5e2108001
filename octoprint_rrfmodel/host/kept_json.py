"""Something that the plugin keeps in its data folder over a restart."""

import json
import logging
import os
from pathlib import Path


class KeptJson:
    """A file that is there whole or not at all; ``folder()`` is where, ``name`` what it is called.

    A file that can't be read or written is no reason to do anything but go on without.
    """

    def __init__(self, folder, name):
        self._folder = folder
        self._name = name
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.kept")

    def read(self):
        """Return what was kept, ``None`` where there is nothing, or nothing that can be read."""
        try:
            return json.loads(self._file().read_text(encoding="utf-8"))
        except FileNotFoundError:
            return None
        except (OSError, ValueError) as error:
            self._logger.warning("Could not read %s: %s", self._name, error)
            return None

    def write(self, value):
        """Return whether a value is kept, instead of the one before.

        That stays until this one is there whole.
        """
        try:
            file = self._file()
            new = file.with_suffix(".new")
            with open(new, "w", encoding="utf-8") as written:
                json.dump(value, written)
                written.flush()
                # the power of a machine may go at any time
                os.fsync(written.fileno())
            new.replace(file)
        except OSError as error:
            self._logger.warning("Could not keep %s: %s", self._name, error)
            return False
        return True

    def remove(self):
        """Return whether nothing is kept any more."""
        try:
            self._file().unlink(missing_ok=True)
        except OSError as error:
            self._logger.warning("Could not remove %s: %s", self._name, error)
            return False
        return True

    def _file(self):
        return Path(self._folder()) / self._name
