"""The card of a board on the network: what is on it, kept; what is changed of it.

The list is fetched beside the polls, a page at a time. Changes are made on the threads of whoever
wants them; one file is on its way at a time.
"""

import tempfile

from ...rrf.card.listing import ROOT, CardPlan
from ...rrf.views.machine import Machine
from ...rrf.wire.reply import MalformedReply, decode_page
from .card_details import CardDetails
from .card_names import check_name
from .card_refused import FAILURES, CardRefused
from .transfers import Transfers


class Card:
    """Knows the files of the board of ``link``, and changes them; ``model()`` is the snapshot.

    ``folder()`` is where files lie that are fetched. Paths are whole:
    ``0:/gcodes/folder/name.gcode``.
    """

    def __init__(self, link, model, folder=tempfile.gettempdir):
        self._link = link
        self._model = model
        self._plan = CardPlan()
        self._is_walking = False
        self.transfers = Transfers(link, folder)
        self.details = CardDetails(link, lambda: self.changed())
        self.downloads = self.transfers.downloads
        self.files = {}
        """By path; replaced whole."""
        self.folders = frozenset()
        self.changed = lambda: None
        """Called when the list is another one."""

    def forget(self):
        """Know nothing: another board, perhaps."""
        self._plan.forget()
        self._is_walking = False
        self.files, self.folders = {}, frozenset()
        self.details.forget()
        self.downloads.forget()

    def file_of(self, name):
        """Return the file of that name below the folder of G-code, ``None`` where none is."""
        if self._link.exchange is None:
            # what is known is another printer's
            return None
        return self.files.get(f"{ROOT}/{name.strip('/')}")

    def listed(self):
        """Return the files on the card (``CardFile``), as far as they are known; any thread."""
        return tuple(self.files.values()) if self._link.exchange is not None else ()

    def facts_of(self, path):
        """Return what the board has read from a file, ``None`` where it wasn't asked yet."""
        known = self.details.known.get(path)
        return known.members if known else None

    def look(self):
        """Fetch the list again where the model says that it is another one."""
        self._plan.observe(self._model())
        self._walk_on()

    def refresh(self):
        """Fetch the list again."""
        self._plan.refetch()
        self._walk_on()

    def _walk_on(self):
        exchange = self._link.exchange
        if exchange is not None and self._plan.behind and not self._is_walking:
            self._is_walking = True
            exchange.run(self._step)

    def _step(self, dialect):
        """Fetch a page (an errand of the exchange)."""
        self._is_walking = False
        request = self._plan.next_request()
        if request is None:
            return
        try:
            taken = self._plan.take(decode_page(dialect.read(request)))
        except MalformedReply:
            taken = False
        except FAILURES:
            self._plan.failed()
            raise
        if not taken:
            self._plan.failed()
        if self._plan.behind:
            self._walk_on()
        elif self._plan.index is not None:
            self._keep({file.path: file for file in self._plan.index.files.values()})
            if not Machine(self._model()).prints:
                # reading files slows a print down
                self.details.look(self.files.values())

    def _keep(self, files, folders=None):
        kept = self._plan.folders if folders is None else folders
        if (files, frozenset(kept)) != (self.files, self.folders):
            self.files, self.folders = files, frozenset(kept)
            self.changed()

    ##~~ changes, on threads of requests

    def upload(self, source, path, told=None, goes_first=False):
        """Bring a file of the host's to the card, whole; ``told(percent)`` meanwhile.

        Where it ``goes_first`` a file that is fetched meanwhile gives way.
        """
        brought = self.transfers.bring(source, path, told, goes_first)
        self._keep({**self.files, path: brought}, {*self.folders, *_parents(path)})
        self.refresh()

    def stop_uploads(self):
        """Call off what is on its way."""
        self.transfers.stop()

    def delete(self, path):
        """Delete a file."""
        self._change("delete", path)
        self._keep({p: file for p, file in self.files.items() if p != path}, self.folders)
        self.refresh()

    def delete_folder(self, path):
        """Delete a folder with all that is in it, what isn't listed excepted."""
        below = f"{path}/"
        for file in [each for each in self.files if each.startswith(below)]:
            self._change("delete", file)
        inner = sorted((each for each in self.folders if each.startswith(below)), reverse=True)
        for folder in (*inner, path):
            self._change("delete", folder)
        self._keep(
            {p: file for p, file in self.files.items() if not p.startswith(below)},
            self.folders.difference((*inner, path)),
        )
        self.refresh()

    def make_folder(self, path):
        """Make a folder."""
        check_name(path)
        self._change("make_folder", path)
        self._keep(self.files, self.folders | {path})
        self.refresh()

    def move(self, source, target):
        """Move a file or a folder."""
        check_name(target)
        self._change("move", source, target)

        def moved(path):
            return target + path[len(source) :] if (path + "/").startswith(source + "/") else path

        files = {moved(path): file._replace(path=moved(path)) for path, file in self.files.items()}
        self._keep(files, {*map(moved, self.folders), *_parents(target)})
        self.refresh()

    def _change(self, name, path, *more):
        if not self.transfers.asked(lambda dialect: getattr(dialect.files, name)(path, *more)):
            raise CardRefused("failed", path.rpartition("/")[2])


def _parents(path):
    """Return the folders that a path is in, but for the one of all G-code."""
    parts = path.split("/")[2:-1]
    return ["/".join((ROOT, *parts[:count])) for count in range(1, len(parts) + 1)]
