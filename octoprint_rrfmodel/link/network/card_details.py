"""What slicers say of the card's files, and their pictures, fetched when nothing else is asked.

OctoPrint asks for these on the thread that serves everybody, where nothing may wait for a board.
"""

import collections
from typing import NamedTuple

from ...rrf.card.thumbnail import MOST_LETTERS, best, decode_piece, picture, print_file
from ...rrf.wire.reply import MalformedReply, members_of
from ...rrf.wire.request import FileRequest, PieceRequest

MOST_FILES = 200
"""The newest of so many files; each costs a request, and one for each piece of its picture."""


class Detail(NamedTuple):
    """What is known of a file."""

    of: tuple
    """Its size and date, by which it is told from the next one of that name."""
    members: dict
    """As ``rr_fileinfo`` tells them."""
    picture: object = None
    """``rrf.card.thumbnail.Picture``, ``None`` where there is none."""
    sides: str = ""
    """Its width and height as ``160x120``."""


class CardDetails:
    """Fetches them through the errands of ``link``'s exchange; ``changed()`` tells of news."""

    def __init__(self, link, changed):
        self._link = link
        self._changed = changed
        self._waiting = collections.deque()
        self._work = None
        self._request = None
        self.known = {}
        """By path; replaced whole."""

    def forget(self):
        """Know nothing: another board, perhaps."""
        self._waiting.clear()
        self._work = None
        self.known = {}

    def look(self, files):
        """Fetch what isn't known of these files (``CardFile``), the newest first."""
        newest = sorted(files, key=lambda file: file.date, reverse=True)[:MOST_FILES]
        self.known = {
            file.path: self.known[file.path]
            for file in newest
            if file.path in self.known and self.known[file.path].of == (file.size, file.date)
        }
        self._waiting = collections.deque(file for file in newest if file.path not in self.known)
        if self._work is None:
            self._go_on()

    def _go_on(self):
        exchange = self._link.exchange
        if exchange is None or not self._waiting:
            self._work = None
            return
        self._work = self._asked(self._waiting.popleft())
        self._request = next(self._work)
        exchange.run(self._step)

    def _step(self, dialect):
        """Ask one thing (an errand of the exchange)."""
        if self._work is None:
            return
        try:
            self._request = self._work.send(dialect.read(self._request))
        except (StopIteration, MalformedReply):
            self._go_on()
        except BaseException:
            # the board is away or was reset: the list comes again
            self._work = None
            raise
        else:
            exchange = self._link.exchange
            if exchange is None:
                # the connection has ended meanwhile, on another thread
                self._work = None
            else:
                exchange.run(self._step)

    def _asked(self, file):
        """Give what is to be asked, and take the answers."""
        members = members_of((yield FileRequest(file.path)))
        told = print_file(members) if members.get("err") == 0 else None
        thumbnail = best(told.thumbnails) if told else None
        letters, offset = "", thumbnail.offset if thumbnail else 0
        while offset and len(letters) <= MOST_LETTERS:
            piece = decode_piece((yield PieceRequest(file.path, offset)))
            letters += piece.data
            offset = piece.next if not piece.error and piece.next > offset else 0
        found = picture(letters) if letters else None
        sides = f"{thumbnail.width}x{thumbnail.height}" if found else ""
        detail = Detail((file.size, file.date), members, found, sides)
        self.known = {**self.known, file.path: detail}
        self._changed()
