"""Files on their way to a board's card, and small ones from there: one at a time."""

import io
import os
import threading
import time
import zlib
from datetime import datetime

from ...rrf.card.listing import CardFile
from .card_names import check_name
from .card_refused import FAILURES, CardRefused
from .downloads import Downloads
from .file_read import facts_of, whole_file
from .transport import Unreachable

STALL_SECONDS = 9.0
"""Time for which a board keeps a file open whose sender has vanished."""

TRIES = 2

DATE_SECONDS = 3
"""By how much a date may differ: the card keeps every second one."""


class Transfers:
    """Brings files to the card of ``link``'s board, on the threads of whoever wants them.

    ``folder()`` is where files lie that are fetched. Paths are whole.
    """

    def __init__(self, link, folder):
        self._link = link
        self._turn = threading.Lock()
        self._stops = False
        self.downloads = Downloads(link, self._turn, folder)

    def bring(self, source, path, told=None, goes_first=False):
        """Bring a file of the host's, or bytes; return what the card has then (``CardFile``).

        ``told(percent)`` is called meanwhile. Where it ``goes_first`` a file that is fetched
        meanwhile gives way.
        """
        check_name(path)
        if goes_first:
            self.downloads.call_off()
        if not self._turn.acquire(timeout=STALL_SECONDS if goes_first else 0):
            raise CardRefused("busy")
        try:
            self._stops = False
            size, crc = _measured(source)
            since = time.time() if isinstance(source, bytes) else os.path.getmtime(source)
            modified = time.strftime("%Y-%m-%dT%H:%M:%S", time.localtime(since))
            self._upload(source, path, told, size=size, crc=crc, modified=modified)
            if self.dialect().files.is_proof:
                return CardFile(path, size, modified)
            return CardFile(path, size, self._checked(path, size, modified))
        finally:
            self._turn.release()

    def fetch(self, path, size=None, *, most):
        """Return the bytes of a small file in any folder; as ``file_read.whole_file``."""
        if not self._turn.acquire(timeout=STALL_SECONDS):
            raise CardRefused("busy")
        try:
            return self.asked(lambda dialect: whole_file(dialect.files, path, size, most=most))
        finally:
            self._turn.release()

    def stop(self):
        """Call off what is on its way to the card."""
        self._stops = True

    def _upload(self, source, path, told, **measured):
        """Send it, more than once if need be."""

        def sent(count):
            if self._stops:
                raise CardRefused("stopped")
            if told is not None:
                told(100 * count // max(measured["size"], 1))

        for attempt in range(1, TRIES + 1):
            try:
                with _opened(source) as body:
                    is_whole = self.dialect().files.upload(body, path, told=sent, **measured)
            except FAILURES as error:
                if attempt == TRIES:
                    raise CardRefused("unreachable", str(error)) from None
                time.sleep(STALL_SECONDS)
                continue
            if is_whole:
                return
        raise CardRefused("not_whole", path.rpartition("/")[2])

    def _checked(self, path, size, modified):
        """Return the date of what the card has, if it is what was sent.

        The board says 0 also where it isn't.
        """
        told = self.asked(lambda dialect: facts_of(dialect, path))
        date = told.get("lastModified")
        differs = told["err"] != 0 or told["size"] != size
        if differs or (date is not None and not _is_about(date, modified)):
            raise CardRefused("not_whole", path.rpartition("/")[2])
        return date or modified

    def asked(self, ask):
        """Return what ``ask(dialect)`` does; raise ``CardRefused`` where the board isn't there."""
        try:
            return ask(self.dialect())
        except FAILURES as error:
            raise CardRefused("unreachable", str(error)) from None

    def dialect(self):
        """Return the dialect of the board (``dialect.Dialect``)."""
        exchange = self._link.exchange
        if exchange is None:
            raise Unreachable("no connection")
        return exchange.dialect


def _opened(source):
    return io.BytesIO(source) if isinstance(source, bytes) else open(source, "rb")


def _measured(source):
    size, crc = 0, 0
    with _opened(source) as body:
        while piece := body.read(1024 * 1024):
            size += len(piece)
            crc = zlib.crc32(piece, crc)
    return size, crc


def _is_about(date, other):
    try:
        between = datetime.fromisoformat(date) - datetime.fromisoformat(other)
    except (TypeError, ValueError):
        return False
    return abs(between.total_seconds()) <= DATE_SECONDS
