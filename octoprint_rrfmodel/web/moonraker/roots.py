"""All roots together: which file a name means, and what is told of it in Moonraker's members."""

from flask_babel import gettext

from ...host.answers import RequestRefused
from .places import CARD, GCODES, Place, below, place_of


class Roots:
    """Finds files; ``own`` are ``OwnFiles``, ``card`` are ``CardFiles``.

    ``last_run(place)`` gives number and beginning of the last print of a file, both ``None`` for
    one that never was printed.
    """

    def __init__(self, own, card, last_run):
        self.own = own
        self.card = card
        self._by_name = {each.root: each for each in (own, card)}
        self._last_run = last_run

    def all(self):
        """Return the roots as clients are told of them."""
        return [
            {"name": root.root, "path": root.where(), "permissions": root.permissions}
            for root in (self.own, self.card)
        ]

    def named(self, name):
        """Return a root; refused where there is none."""
        return self._by_name[below(name, "").root]

    def of(self, place):
        """Return the root of a place."""
        return self._by_name[place.root]

    def thing(self, text):
        """Return the place of a path with its root in front, and what is there."""
        place = place_of(text)
        found = self.of(place).find(place.path)
        if found is None:
            raise RequestRefused(404, gettext("There is no such file or folder."))
        return Place(place.root, found.path), found

    def file(self, name):
        """Return the place of a file and what is there.

        Names are those below ``gcodes``; ``printer/`` in front means the card.
        """
        place = below(GCODES, name)
        found = self.own.find(place.path)
        root, _, path = place.path.partition("/")
        if found is None and root == CARD:
            place = below(CARD, path)
            found = self.card.find(place.path)
        if found is None or found.is_folder:
            raise RequestRefused(404, gettext("There is no such file."))
        return Place(place.root, found.path), found

    def metadata(self, place, found, is_asked=True):
        """Return what is known of a file."""
        number, began = self._last_run(place)
        return {
            "filename": f"{CARD}/{place.path}" if place.root == CARD else place.path,
            "size": found.size,
            "modified": found.modified,
            **self.of(place).facts(found, is_asked),
            "job_id": number,
            "print_start_time": began,
        }

    def item(self, place):
        """Return what changes tell of a file or folder; of one that is gone that it is."""
        root = self.of(place)
        found = root.find(place.path)
        if found is None:
            return {**_named(place), "modified": 0, "size": 0, "permissions": ""}
        return {
            **_named(place),
            "modified": found.modified,
            "size": found.size,
            "permissions": root.permissions,
        }


def _named(place):
    return {"path": place.path, "root": place.root}
