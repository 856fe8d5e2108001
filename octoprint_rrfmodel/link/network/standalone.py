"""A board by itself: ``rr_*`` (RRF 3.5 HttpResponder.cpp)."""

import json

from ...rrf.wire.line import NO_BUFFERS
from ...rrf.wire.rr import line_form, path_of, request_path
from .dialect import Dialect, Files
from .login import Busy
from .numbers_told import number_in, replies_in
from .outgoing import Outgoing

LIST_BYTES = 1024 * 1024

STOP_SECONDS = 2.0


class Standalone(Dialect):
    """Talks with a board through ``session``; it says nothing unasked, so that ``wake`` rests."""

    protocol = "rr"

    def __init__(self, session, clock, wake):
        self._session = session
        self._clock = clock
        self.commands = Outgoing(session, clock)
        self.files = StandaloneFiles(session)
        self._replies = None
        self._is_reply_due = False
        self._was_busy = False

    def enter(self):
        """There is nothing to begin."""

    def leave(self):
        """There is nothing to end."""

    def up_time(self):
        return number_in(self._session.ask(path_of("model", key="state.upTime", flags="")))

    @property
    def has_news(self):
        return self._is_reply_due

    def news(self):
        # what comes is taken away from the board, so that this isn't asked again
        self._is_reply_due = False
        text = self._session.ask(path_of("reply")).decode("utf-8", "replace")
        return [("said", text)] if text.strip() else []

    def answer(self, request, tell):
        path, asked_at = request_path(request), self._clock()
        if path is None:
            return asked_at, None
        try:
            text = line_form(request, self._session.ask(path).decode("utf-8", "replace"))
            self._was_busy = False
            self._hear_first(replies_in(request, text), tell)
        except Busy:
            text = NO_BUFFERS
            # a reply that nobody fetches may be what takes them
            self._is_reply_due, self._was_busy = not self._was_busy, True
        return asked_at, text

    def _hear_first(self, count, tell):
        """Fetch what the board has said before anybody sees what has come of it, as on a line."""
        before = self._replies
        if count is None or count == before:
            return
        self._replies = count
        # nothing has been said yet where it is 0
        if count or before:
            for news in self.news():
                tell(*news)

    def read(self, request):
        text = self._session.ask(request_path(request), most=LIST_BYTES)
        return line_form(request, text.decode("utf-8", "replace"))

    def take_at_once(self, command):
        # the line end is for what stands unfinished in front of it (3.5 GCodeInput.cpp)
        text = f"\n{command}" if command == "M112" else command
        told = self._told(path_of("gcode", gcode=text))
        return "buff" in told

    def is_halted(self):
        told = self._told(path_of("model", key="state.status", flags=""))
        return told.get("result") == "halted"

    def _told(self, path):
        return _object_of(self._session.ask(path, seconds=STOP_SECONDS))


class StandaloneFiles(Files):
    """Files by ``rr_*``, whose answers have a number for what went wrong."""

    def __init__(self, session):
        self._session = session

    def open(self, path, most):
        return self._session.open(path_of("download", name=path), most)

    def upload(self, body, path, *, size, crc, modified, told):
        target = path_of("upload", name=path, time=modified, crc32=f"{crc:08x}")
        return _is_done(self._session.upload(target, body, size, told))

    def delete(self, path):
        return self._does(path_of("delete", name=path))

    def make_folder(self, path):
        return self._does(path_of("mkdir", dir=path))

    def move(self, source, target):
        return self._does(path_of("move", old=source, new=target, deleteexisting="yes"))

    def _does(self, path):
        return _is_done(self._session.ask(path))


def _is_done(answer):
    return _object_of(answer).get("err") == 0


def _object_of(answer):
    try:
        told = json.loads(answer)
    except ValueError:
        return {}
    return told if isinstance(told, dict) else {}
