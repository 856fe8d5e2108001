"""Files on their way from a board to who wants them: brought to the host's disk, then handed out.

OctoPrint reads a file on the thread that serves everybody, where nothing may wait for a board, and
what was begun to be sent can't be told as broken any more. So a file is here first, and whole.
"""

import tempfile
import threading
import time
from concurrent.futures import Future

from ...host.own_thread import on_a_thread_of_its_own
from .card_refused import CardRefused
from .file_read import pieces_of
from .transport import PIECE

MOST_KEPT = 64 * 1024 * 1024
"""Bytes of files that stay for the next who wants them; the oldest go first."""

TURN_SECONDS = 60.0
"""Time that a file waits until another one has been transferred."""

BEGIN_SECONDS = 30.0
SLOWEST = 10_000
"""Bytes a second below which a transfer has come to nothing."""


class Download:
    """A file of the card that is fetched, or here; ``end`` is a future of its being here whole.

    ``end`` raises ``CardRefused``. Who wants it holds it: a file that nobody holds is not fetched
    on, and gone.
    """

    def __init__(self, file, folder):
        self.file = file
        self.end = Future()
        self.end.set_running_or_notify_cancel()
        self._lock = threading.Lock()
        self._holders = 0
        self._is_called_off = False
        # closed by whoever holds it last
        self._spool = tempfile.TemporaryFile(dir=folder)  # noqa: SIM115

    def hold(self):
        """Want it; return whether that is still possible."""
        with self._lock:
            is_there = not self._spool.closed
            self._holders += is_there
            return is_there

    def release(self):
        """Want it no more."""
        with self._lock:
            self._holders -= 1
            if not self._holders:
                self._spool.close()

    def call_off(self):
        """Fetch it no further, whoever wants it."""
        self._is_called_off = True

    def take(self, piece):
        """Put the next piece behind the others; raise ``CardRefused`` where nobody wants it."""
        if self._is_called_off:
            raise CardRefused("stopped")
        with self._lock:
            if self._spool.closed:
                raise CardRefused("stopped")
            try:
                self._spool.write(piece)
            except OSError:
                raise CardRefused("no_room", self.file.path.rpartition("/")[2]) from None

    def read(self, begin, count):
        """Return so many bytes from there on, fewer at the end."""
        with self._lock:
            self._spool.seek(begin)
            return self._spool.read(count)


class Reader:
    """What OctoPrint reads a file from that is here; it never waits."""

    def __init__(self, download):
        self._download = download
        self._at = 0

    def read(self, size=None):
        """Return the next bytes, none at the end."""
        count = PIECE if size is None or size < 0 else min(size, PIECE)
        piece = self._download.read(self._at, count) if self._download else b""
        self._at += len(piece)
        return piece

    def close(self):
        """Want the file no more."""
        download, self._download = self._download, None
        if download is not None:
            download.release()


class Downloads:
    """Fetches files of the card of ``link``'s board, one at a time.

    ``turn`` is the lock that one transfer holds, ``folder()`` is where files may lie meanwhile.
    """

    def __init__(self, link, turn, folder):
        self._link = link
        self._turn = turn
        self._folder = folder
        self._lock = threading.Lock()
        self._under_way = {}
        self._kept = {}
        """Those that are here, held, by path; the one that was wanted last is the last."""

    def want(self, file):
        """Return the ``Download`` of a file (``CardFile``), held for the caller."""
        with self._lock:
            known = self._known(self._kept, file) or self._known(self._under_way, file)
            if known is not None:
                return known
            exchange = self._link.exchange
            if exchange is None or exchange.is_away:
                raise CardRefused("unreachable", "no answer")
            try:
                made = Download(file, self._folder())
            except OSError:
                raise CardRefused("no_room", file.path.rpartition("/")[2]) from None
            made.hold()
            self._under_way[file.path] = made
        on_a_thread_of_its_own(self._fetch, made, exchange.dialect.files, name="rrfmodel.download")
        return made

    def here(self, file):
        """Return the ``Download`` of a file that is here whole, held, ``None`` for another."""
        with self._lock:
            return self._known(self._kept, file)

    def _known(self, downloads, file):
        known = downloads.get(file.path)
        if known is None or known.file != file or not known.hold():
            return None
        if downloads is self._kept:
            downloads[file.path] = downloads.pop(file.path)
        return known

    def call_off(self):
        """Fetch nothing further."""
        with self._lock:
            under_way = list(self._under_way.values())
        for download in under_way:
            download.call_off()

    def forget(self):
        """Keep nothing: another board, perhaps."""
        self.call_off()
        with self._lock:
            kept, self._kept, self._under_way = self._kept, {}, {}
        for download in kept.values():
            download.release()

    def _fetch(self, download, files):
        refused = CardRefused("not_whole", download.file.path.rpartition("/")[2])
        try:
            self._fetch_in_turn(download, files)
            refused = None
        except CardRefused as error:
            refused = error
        finally:
            # whatever else has gone wrong, nobody waits for ever
            self._leave(download, refused is None)
            if refused is None:
                download.end.set_result(None)
            else:
                download.end.set_exception(refused)

    def _fetch_in_turn(self, download, files):
        if not self._turn.acquire(timeout=TURN_SECONDS):
            raise CardRefused("busy")
        try:
            path, size, _ = download.file
            end = time.monotonic() + BEGIN_SECONDS + size / SLOWEST
            for piece in pieces_of(files, path, size, most=size):
                download.take(piece)
                if time.monotonic() > end:
                    raise CardRefused("not_whole", path.rpartition("/")[2])
        finally:
            self._turn.release()

    def _leave(self, download, is_whole):
        """Keep what is here for the next who wants it, and let the oldest go."""
        path, gone = download.file.path, []
        with self._lock:
            if self._under_way.get(path) is not download:
                return
            del self._under_way[path]
            if is_whole and download.hold():
                gone += [self._kept.pop(path)] if path in self._kept else []
                self._kept[path] = download
            while sum(each.file.size for each in self._kept.values()) > MOST_KEPT:
                gone.append(self._kept.pop(next(iter(self._kept))))
        for each in gone:
            each.release()
