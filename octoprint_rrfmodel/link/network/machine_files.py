"""The machine's own files on a board of the network: macros, system files, filaments.

Whoever calls waits for the board: for threads of their own. What is written over is copied first.
"""

import threading
from typing import NamedTuple

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...rrf.views.machine import Machine
from ...rrf.wire.reply import MalformedReply, decode_page
from ...rrf.wire.request import ListRequest
from .card_names import check_name
from .card_refused import FAILURES, CardRefused
from .file_read import facts_of
from .reasons import card_sentence, no_board_sentence

FOLDERS = {"macros": "0:/macros/", "system": "0:/sys/", "filaments": "0:/filaments/"}
"""Whose files these are, by the names of the model's ``directories``, and where they are unsaid."""

BACKUP = "backup"
"""Folder of the system's into which goes what is written over."""

CONFIGURATION = "config.g"
"""What a board reads at its start alone."""

MOST_BYTES = 256 * 1024
MOST_WRITTEN = 64 * 1024
MOST_PAGES = 100

STATUSES = {"gone": 404, "name": 400, "large": 409, "busy": 409, "failed": 409, "stopped": 409}
"""Of refusals; any other is the board's not answering."""

TEXT_CONTROLS = frozenset("\t\n\r")


class Stored(NamedTuple):
    """A file as the card has it."""

    size: int
    date: str

    @property
    def stamp(self):
        """What tells it from the same file after a change."""
        return f"{self.size} {self.date}"


class MachineFiles:
    """Lists, reads and writes files through ``card`` (``Card``); ``model()`` is the snapshot.

    One at a time; what is refused raises ``RequestRefused``.
    """

    def __init__(self, link, card, model):
        self._link = link
        self._card = card
        self._model = model
        self._turn = threading.Lock()

    def entries(self, path):
        """Return what is in a folder."""
        folder = self._allowed(path)
        return self._carried_out(self._list, folder)

    def read(self, path):
        """Return a file's text, and the stamp by which a change of it is seen."""
        return self._carried_out(self._read, self._allowed_file(path))

    def write(self, path, text, stamp=None):
        """Write a file; return what became of it.

        With a ``stamp`` only if the file is still the one that has it; an empty one is of none.
        """
        path, content = self._allowed_file(path), content_of(text)
        if Machine(self._model()).prints:
            raise RequestRefused(409, gettext("The machine prints. Change its files afterwards."))
        return self._carried_out(self._write, path, content, stamp)

    def _folders(self):
        told = self._model().get("directories") or {}
        found = {name: told.get(name) for name in FOLDERS}
        return {
            name: f"{folder.rstrip('/')}/" if isinstance(folder, str) and folder else FOLDERS[name]
            for name, folder in found.items()
        }

    def _allowed(self, path):
        """Return a path below one of the machine's folders, or that folder."""
        path = path.rstrip("/")
        try:
            check_name(path)
        except CardRefused as refused:
            raise RequestRefused(400, card_sentence(refused)) from None
        # names of the card have no case
        if not f"{path}/".lower().startswith(tuple(map(str.lower, self._folders().values()))):
            raise RequestRefused(
                400, gettext("Only files below the folders of macros, system and filaments.")
            )
        return path

    def _allowed_file(self, path):
        allowed = self._allowed(path)
        if path != allowed or f"{path}/".lower() in map(str.lower, self._folders().values()):
            raise RequestRefused(400, gettext("That is a folder. Name a file in it."))
        return path

    def _carried_out(self, function, *arguments):
        if not self._turn.acquire(blocking=False):
            raise RequestRefused(409, gettext("Another file is being looked at. Try again soon."))
        try:
            exchange = self._link.exchange
            if exchange is None:
                raise RequestRefused(409, no_board_sentence())
            if exchange.is_away:
                raise CardRefused("unreachable", "no answer")
            return function(exchange.dialect, *arguments)
        except CardRefused as refused:
            status = STATUSES.get(refused.code, 504)
            raise RequestRefused(status, card_sentence(refused)) from None
        except FAILURES as error:
            refused = CardRefused("unreachable", str(error) or "no answer")
            raise RequestRefused(504, card_sentence(refused)) from None
        finally:
            self._turn.release()

    def _list(self, dialect, folder):
        found, first = {}, 0
        for _ in range(MOST_PAGES):
            text = dialect.read(ListRequest(folder, first))
            try:
                page = decode_page(text.strip())
            except MalformedReply:
                raise CardRefused("not_whole", folder.rpartition("/")[2]) from None
            if page.error:
                raise CardRefused("gone", folder.rpartition("/")[2])
            # pages shift while files come and go
            found.update({entry.name: entry for entry in page.entries})
            if not page.entries or page.next <= first:
                break
            first = page.next
        return [
            {"name": name, "folder": each.is_folder, "size": each.size, "date": each.date}
            for name, each in found.items()
        ]

    def _stored(self, dialect, path):
        """Return what the card has there, ``None`` for nothing."""
        told = facts_of(dialect, path)
        return None if told["err"] else Stored(told["size"], str(told.get("lastModified") or ""))

    def _make_sure_of_nothing(self, path):
        """Raise ``CardRefused`` where there is a file after all, which would be written over."""
        try:
            self._card.transfers.fetch(path, most=MOST_BYTES)
        except CardRefused as refused:
            if refused.code != "gone":
                raise
        else:
            raise CardRefused("not_whole", path.rpartition("/")[2])

    def _read(self, dialect, path):
        stored = self._stored(dialect, path)
        if stored is None:
            raise CardRefused("gone", path.rpartition("/")[2])
        content = self._card.transfers.fetch(path, stored.size, most=MOST_BYTES)
        try:
            text = content.decode("utf-8")
        except UnicodeDecodeError:
            raise RequestRefused(409, gettext("This file holds no text.")) from None
        return {"path": path, "text": text, **stored._asdict(), "stamp": stored.stamp}

    def _write(self, dialect, path, content, stamp):
        stored = self._stored(dialect, path)
        if stamp is not None and stamp != (stored.stamp if stored else ""):
            raise RequestRefused(
                409, gettext("The file was changed meanwhile. Read it again before you change it.")
            )
        backup = None
        if stored is None:
            self._make_sure_of_nothing(path)
        else:
            backup = self._backup_of(path)
            before = self._card.transfers.fetch(path, stored.size, most=MOST_BYTES)
            self._card.transfers.bring(before, backup)
        _, size, date = self._card.transfers.bring(content, path)
        written = Stored(size, date)
        return {
            "path": path,
            **written._asdict(),
            "stamp": written.stamp,
            "backup": backup,
            "restart": path.lower() == f"{self._folders()['system']}{CONFIGURATION}".lower(),
        }

    def _backup_of(self, path):
        return f"{self._folders()['system']}{BACKUP}/{path.partition('/')[2]}"


def content_of(text):
    """Return the bytes of a text that may be written; raise ``RequestRefused`` for another."""
    is_text = isinstance(text, str) and not any(
        letter < " " and letter not in TEXT_CONTROLS or letter == "\x7f" for letter in text
    )
    if not is_text:
        raise RequestRefused(400, gettext("A file's text may hold no control characters."))
    try:
        content = text.encode("utf-8")
    except UnicodeEncodeError:
        raise RequestRefused(
            400, gettext("A file's text may hold no control characters.")
        ) from None
    if len(content) > MOST_WRITTEN:
        raise RequestRefused(400, gettext("A file that is written here has 64 kB at most."))
    return content
