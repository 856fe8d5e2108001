"""OctoPrint's own files as a root of Moonraker's, with what slicers have written into them."""

import shutil
from collections import OrderedDict

from ...rrf.card.sliced import Sliced, letters_of, sliced
from ...rrf.card.thumbnail import picture
from ...rrf.klipper import print_files as shapes
from .places import GCODES, WRITE

MOST_KEPT = 500
"""Files whose beginning is kept."""


class OwnFiles:
    """OctoPrint's own files; ``files`` are its ``PrintFiles``."""

    root = GCODES
    permissions = WRITE
    can_be_changed = True

    def __init__(self, files):
        self.files = files
        self._kept = OrderedDict()

    def find(self, path):
        """Return a file or folder, ``None`` for none."""
        return self.files.find(path)

    def listed(self):
        """Return all files that can be printed."""
        return [each for each in self.files.entries(recursive=True) if each.is_printable]

    def inside(self, folder):
        """Return what is in a folder."""
        return self.files.entries(folder)

    def where(self):
        """Return the folder on the disk."""
        return self.files.on_disk().rstrip("/\\")

    def usage(self):
        """Return how full the disk is."""
        return shutil.disk_usage(self.where())._asdict()

    def facts(self, found, is_asked=True):
        """Return what is known of a file, in Moonraker's members."""
        if not found.is_printable:
            return {}
        name = found.path.rpartition("/")[2]
        return shapes.of_analysis(found.analysis, self._sliced(found), name)

    def picture(self, wanted):
        """Return a picture in a file (``rrf.card.thumbnail.Picture``), ``None`` for none."""
        found = self.find(wanted.file)
        if found is None or not found.is_printable:
            return None
        for each in self._sliced(found).thumbnails:
            if (each.width, each.height) == wanted[1:]:
                with open(self.files.on_disk(found.path), "rb") as file:
                    return picture(letters_of(file, each))
        return None

    def open(self, found):
        """Return a file to read from."""
        return open(self.files.on_disk(found.path), "rb")

    def scan(self, path):
        """Have a file looked at anew; what OctoPrint finds comes later."""
        self.forget(path)
        self.files.analyse(path)

    def forget(self, path):
        """Read a file's beginning again when it is asked for next."""
        self._kept.pop(path, None)

    def _sliced(self, found):
        key = found.size, found.modified
        kept = self._kept.get(found.path)
        if kept is None or kept[0] != key:
            try:
                with open(self.files.on_disk(found.path), "rb") as file:
                    kept = key, sliced(file)
            except OSError:
                return Sliced()
            self._kept[found.path] = kept
            while len(self._kept) > MOST_KEPT:
                self._kept.popitem(last=False)
        return kept[1]
