"""Where files are, by the paths that Moonraker's clients give: a root, and a path below it."""

from typing import NamedTuple

from flask_babel import gettext

from ...host.answers import RequestRefused

GCODES, CARD = "gcodes", "printer"
"""OctoPrint's own files, and those on the board's card."""

ROOTS = (GCODES, CARD)

READ, WRITE = "r", "rw"
"""What may be done with files."""

LONGEST = 500


class Place(NamedTuple):
    """A file or folder below a root."""

    root: str
    path: str
    """Without a slash in front or behind, empty for the root itself."""

    @property
    def name(self):
        """The last part of the path."""
        return self.path.rpartition("/")[2]

    def at(self, name):
        """Return what is called so in this folder."""
        return Place(self.root, f"{self.path}/{name}" if self.path else name)


def place_of(text):
    """Return the place of a path that begins with its root; raise ``RequestRefused``."""
    root, _, path = text.strip("/").partition("/")
    return below(root, path)


def below(root, path):
    """Return the place of a path below a root; raise ``RequestRefused``."""
    if root not in ROOTS:
        raise RequestRefused(404, gettext("There are the roots gcodes and printer, and no other."))
    path = path.strip("/")
    if path and not all(map(_is_plain, path.split("/"))) or len(path) > LONGEST:
        raise RequestRefused(
            400,
            gettext(
                "A path may hold no part that is empty or begins with a dot, no backslash and no"
                " control character, and 500 letters at most."
            ),
        )
    return Place(root, path)


def _is_plain(part):
    return bool(part.strip()) and part[0] != "." and part.isprintable() and "\\" not in part
