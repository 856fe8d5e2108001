"""The board's card as a root of Moonraker's, from what is known of it."""

import asyncio
from concurrent.futures import TimeoutError as TookTooLong

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...host.print_files import StoredFile
from ...link.poll_slot import TooManyQueries
from ...rrf.card.listing import ROOT
from ...rrf.card.thumbnail import best, print_file
from ...rrf.klipper import print_files as shapes
from .places import CARD, READ, WRITE

ANSWER_SECONDS = 3.0
"""How long a client waits for what the board is asked of one file; what sockets ask waits behind
it, and what they are told."""


class CardFiles:
    """The files on the board's card, from what is known of it without asking.

    ``link`` leads to the board, ``model()`` is the snapshot, ``files`` OctoPrint's ``PrintFiles``
    of it (2.0 over the network alone changes any). ``attach`` brings who asks the board.
    """

    root = CARD

    def __init__(self, link, model, files):
        self._link = link
        self._model = model
        self.files = files
        self._ask = self._loop = None

    def attach(self, thumbnails, loop):
        """Take ``Thumbnails``, which asks the board on Tornado's ``loop``."""
        self._ask, self._loop = thumbnails, loop

    @property
    def permissions(self):
        """What may be done: over a line the card is read alone."""
        return WRITE if self.can_be_changed else READ

    @property
    def can_be_changed(self):
        """Whether files can be brought, changed and fetched."""
        return self._link.kind == "network" and self._is_there()

    def _is_there(self):
        return self._link.is_operational and self._link.is_rrf and self._link.card is not None

    def find(self, path):
        """Return a file or folder, ``None`` for none; names have no case."""
        if not path:
            return StoredFile("", 0, 0.0, is_folder=True)
        wanted = path.lower()
        for each in self._all():
            if each.path.lower() == wanted:
                return each
        return None

    def listed(self):
        """Return all files."""
        return [each for each in self._all() if not each.is_folder]

    def inside(self, folder):
        """Return what is in a folder."""
        begin = f"{folder}/".lower() if folder else ""
        return [
            each
            for each in self._all()
            if each.path.lower().startswith(begin) and "/" not in each.path[len(begin) :]
        ]

    def _all(self):
        """Return files, and each folder that is known or has one of them in it."""
        if not self._is_there():
            return []
        card = self._link.card
        files = [
            StoredFile(each.name, each.size, float(each.modified or 0), is_printable=True)
            for each in card.listed()
        ]
        folders = {each[len(ROOT) + 1 :] for each in card.folders}
        for each in files:
            parts = each.path.split("/")[:-1]
            folders.update("/".join(parts[: end + 1]) for end in range(len(parts)))
        return [StoredFile(each, 0, 0.0, is_folder=True) for each in sorted(folders)] + files

    def where(self):
        """Return the folder on the card."""
        return ROOT

    def usage(self):
        """Return how full the card is, zeros where the board doesn't tell."""
        volume = next(iter(self._model().get("volumes") or ()), None) or {}
        free, total = volume.get("freeSpace"), volume.get("capacity")
        if type(free) is not int or type(total) is not int:
            return {"total": 0, "used": 0, "free": 0}
        return {"total": total, "used": max(0, total - free), "free": free}

    def facts(self, found, is_asked=True):
        """Return what the board has read from a file; with ``is_asked`` it may be asked for it.

        Where it can't be asked, or doesn't answer in time, nothing is known.
        """
        path = f"{ROOT}/{found.path}"
        told = self._link.card.facts_of(path) or self._printed(path)
        if told is None and is_asked:
            told = self._asked(path)
        file = print_file(told) if told else None
        if file is None:
            return {}
        shown = best(file.thumbnails)
        name = found.path.rpartition("/")[2]
        return shapes.of_card(told, (shown,) if shown else (), name)

    def _printed(self, path):
        file = (self._model().get("job") or {}).get("file") or {}
        return file if str(file.get("fileName") or "").lower() == path.lower() else None

    def _asked(self, path):
        try:
            return self._answer_to(self._ask.facts(path)).told
        except RequestRefused as refused:
            if refused.status == 404:
                raise
            return None

    def _answer_to(self, question):
        future = asyncio.run_coroutine_threadsafe(question, self._loop.asyncio_loop)
        try:
            return future.result(ANSWER_SECONDS)
        except (TookTooLong, asyncio.TimeoutError, TooManyQueries, RuntimeError) as error:
            future.cancel()
            raise RequestRefused(504, gettext("The printer did not answer in time.")) from error

    def open(self, found):
        """Return what to read a file from, which is fetched whole first; ``RequestRefused``."""
        if not self.can_be_changed:
            raise RequestRefused(
                409, gettext("Files of the card can be downloaded over the network alone.")
            )
        return self.files.read(found.path)

    def scan(self, path):
        """Nothing has to be: the board looks at its files by itself."""

    def forget(self, path):
        """Nothing is kept here."""
