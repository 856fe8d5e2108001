"""A computer in front of a board: ``/machine`` (Duet Software Framework, DSF).

Its model comes by a websocket, and the poller's questions are answered from what that has told:
it and the follower know no difference.
"""

import collections
import json
import time
import zlib
from http.client import HTTPException
from urllib.parse import urlencode

from ...rrf.model.m409 import answer as answered
from ...rrf.wire import machine
from ...rrf.wire.machine import machine_path
from ...rrf.wire.request import FileRequest, ListRequest, ModelRequest, PieceRequest
from .codes import Codes, run
from .dialect import Dialect, Files
from .model_feed import ModelFeed
from .transport import PIECE, NotConnected, Unreachable

ANSWER_BYTES = 8 * 1024 * 1024
"""Of a list, or of what is read from a file with its pictures."""

ANSWER_SECONDS = 10.0

STOP_SECONDS = 2.0

FRESH_SECONDS = 2.5
"""Time for which the model is as it was told: the computer tells no more where nothing changes."""

CARD_SECONDS = 60.0
"""After which the card is looked at again: nothing tells that others have changed it."""

HALT_SECONDS = 0.5
"""Time that the model has to show that the board stands."""

LOOK_SECONDS = 0.05

FOUND, CREATED, DONE, MISSING = 200, 201, 204, 404


class Sbc(Dialect):
    """Talks with a computer through ``session``; ``wake()`` where it has something to say."""

    protocol = "dsf"

    # it reads the board four times a second, and so do its websockets
    settle_seconds = 1.0

    def __init__(self, session, clock, wake):
        self._session = session
        self._clock = clock
        self._wake = wake
        self._news = collections.deque()
        self._feed = ModelFeed(session, clock, wake)
        session.is_held = lambda: self._feed.is_open
        self._card_at = 0.0
        self.commands = Codes(session, clock, self._came)
        self.files = SbcFiles(session)

    def enter(self):
        self._feed.open()
        self._card_at = self._clock()

    def leave(self):
        self._feed.close()

    def up_time(self):
        up_time = self._state().get("upTime")
        return up_time if type(up_time) is int else None

    @property
    def has_news(self):
        return bool(self._news) or self._feed.has_messages

    def news(self):
        found = [("said", text) for text in self._feed.taken_messages()]
        while self._news:
            found.append(self._news.popleft())
        return found

    def _came(self, *news):
        """Take what has come of a command, on its thread."""
        self._news.extend(news)
        self._wake()

    @property
    def is_executing(self):
        return self.commands.is_executing

    def answer(self, request, tell):
        if not isinstance(request, ModelRequest):
            return self._clock(), self.read(request)
        now = self._clock()
        if now - self._card_at >= CARD_SECONDS and self._feed.is_open:
            self._card_at = now
            self._feed.look_at_card()
        model, said = self._feed.take()
        for text in said:
            tell("said", text)
        text = json.dumps(answered(model, request.key, request.flags), separators=(",", ":"))
        is_fresh = now - self._feed.heard_at < FRESH_SECONDS
        return (now if is_fresh else self._feed.heard_at), text

    def costs(self, request):
        return not isinstance(request, ModelRequest)

    def read(self, request):
        """Return an answer about files, in the form that a board has; ``None`` for other ones."""
        if isinstance(request, ListRequest):
            text = self._text_of(machine_path("directory", request.folder))
            if text is None:
                return machine.no_folder(request.folder)
            return machine.page_form(request.folder, text)
        if isinstance(request, FileRequest):
            text = self._text_of(machine_path("fileinfo", request.path))
            if text is None:
                return machine.no_file(request.path)
            return machine.info_form(request.path, text)
        if isinstance(request, PieceRequest):
            path = machine_path("fileinfo", request.path, readThumbnailContent="true")
            return machine.piece_form(request.path, request.offset, self._text_of(path) or "")
        return None

    def _text_of(self, path):
        """Return what is answered, ``None`` where there is no such thing."""
        answer = self._session.get(path, seconds=ANSWER_SECONDS, most=ANSWER_BYTES)
        return None if answer.status == MISSING else answer.body.decode("utf-8", "replace")

    def take_at_once(self, command):
        try:
            answer = run(self._session, command, end=time.monotonic() + STOP_SECONDS)
        except NotConnected:
            return False
        except Unreachable:
            # a stop may end its own answer, and a restart is not to be sent twice
            return True
        return answer.status == FOUND

    def is_halted(self):
        end = time.monotonic() + HALT_SECONDS
        while self._feed.is_open and time.monotonic() < end:
            if self._state().get("status") == "halted":
                return True
            time.sleep(LOOK_SECONDS)
        return self._asked_state().get("status") == "halted"

    def _state(self):
        return _object_of(self._feed.model.get("state"))

    def _asked_state(self):
        answer = self._session.get(machine_path("status"), seconds=STOP_SECONDS, most=ANSWER_BYTES)
        try:
            return _object_of(_object_of(json.loads(answer.body)).get("state"))
        except (ValueError, RecursionError):
            return {}


def _object_of(value):
    return value if isinstance(value, dict) else {}


class SbcFiles(Files):
    """Changes files through the computer, which has no checksums: what it has got is read back.

    Its dates say nothing: before 3.4.4 it doesn't keep the one that it is given.
    """

    is_proof = True

    def __init__(self, session):
        self._session = session

    def open(self, path, most):
        return self._session.open(machine_path("file", path), most)

    def upload(self, body, path, *, size, crc, modified, told):
        headers = {"Content-Length": str(size), "Content-Type": "application/octet-stream"}
        target = machine_path("file", path, timeModified=modified)
        answer = self._session.send("PUT", target, headers, body, most=ANSWER_BYTES, told=told)
        return answer.status == CREATED and self._crc_of(path, size, told) == crc

    def _crc_of(self, path, size, told):
        """Return the checksum of a file as the card has it, ``None`` where it hasn't that size."""
        crc, count = 0, 0
        with self.open(path, size + 1) as response:
            try:
                while response.status == FOUND and (piece := response.read(PIECE)):
                    crc, count = zlib.crc32(piece, crc), count + len(piece)
                    # it may be called off until the end
                    told(size)
            except (OSError, ValueError, HTTPException) as error:
                raise Unreachable("the connection was lost") from error
        return crc if count == size else None

    def delete(self, path):
        return self._does("DELETE", machine_path("file", path))

    def make_folder(self, path):
        return self._does("PUT", machine_path("directory", path))

    def move(self, source, target):
        form = urlencode({"from": source, "to": target, "force": "true"}).encode()
        kind = {"Content-Type": "application/x-www-form-urlencoded"}
        return self._does("POST", machine.MOVE, form, kind)

    def _does(self, method, path, body=b"", kind=None):
        headers = {"Content-Length": str(len(body)), **(kind or {})}
        end = time.monotonic() + ANSWER_SECONDS
        answer = self._session.send(method, path, headers, body or None, most=ANSWER_BYTES, end=end)
        return answer.status in (FOUND, CREATED, DONE)
