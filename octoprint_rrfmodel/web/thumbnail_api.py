"""``GET /plugin/rrfmodel/thumbnail``: the picture in a file on the machine's card."""

import asyncio
import collections
import time

from flask_babel import gettext

from ..host.answers import RequestRefused
from ..rrf.card.listing import path_of
from ..rrf.card.thumbnail import MOST_LETTERS, best, picture, print_file
from ..rrf.follow.asked import NoFile
from ..rrf.wire.request import FileRequest, PieceRequest
from .files_api import refusal_of
from .live_api import LiveModelHandler

MOST_BYTES = 4_000_000
"""How much of pictures is kept; those that weren't asked for longest go first."""

KEPT_SECONDS = 60.0
"""How long what is known of a file is good, at most."""

MOST_FILES = 200

WAIT_SECONDS = 60.0
"""A big picture comes in some fifty pieces, between which the model has its turns."""

ATTEMPTS = 2
"""Times that a picture is fetched which comes broken: lines have no checksum here."""

SHOWN_SECONDS = 300
"""How long a page need not ask again."""


class Thumbnails:
    """Fetches pictures piece by piece through the slot of the polls; on Tornado's loop only.

    ``questions`` are ``link.questions.Questions``, ``model()`` is the snapshot.
    """

    def __init__(self, questions, model):
        self._questions = questions
        self._model = model
        self._files = {}
        self._pictures = collections.OrderedDict()
        self._fetching = {}
        # one at a time: the other places before the slot are for other questions
        self._turn = asyncio.Lock()

    async def of(self, path):
        """Return a file's picture (``rrf.card.thumbnail.Picture``); raise ``RequestRefused``.

        Who asks at the same time for the same shares the answer.
        """
        file = self._known(path)
        key = self._key(path, file) if file else None
        if key in self._pictures:
            self._pictures.move_to_end(key)
            return self._shown(self._pictures[key])
        if path not in self._fetching:
            reason = self._questions.refusal_of_the_card()
            if reason:
                raise RequestRefused(409, reason)
            task = asyncio.ensure_future(asyncio.wait_for(self._fetch(path, file), WAIT_SECONDS))
            self._fetching[path] = task
            task.add_done_callback(lambda _: self._fetching.pop(path))
        return self._shown(await asyncio.shield(self._fetching[path]))

    async def facts(self, path):
        """Return what the board has read from a file (``PrintFile``); ``RequestRefused``."""
        file = self._known(path)
        if file is None:
            reason = self._questions.refusal_of_the_card()
            if reason:
                raise RequestRefused(409, reason)
            async with self._turn:
                file = self._known(path) or await self._file(path)
        return file

    def _key(self, path, file):
        """Return what tells a picture from others, those of other machines too."""
        return (self._questions.connections(), path.lower(), *file[:2])

    @staticmethod
    def _shown(found):
        if found is None:
            raise RequestRefused(404, gettext("This file has no picture that can be shown."))
        return found

    def _known(self, path):
        """Return what is known of a file without asking, ``None`` for nothing."""
        printed = (self._model().get("job") or {}).get("file") or {}
        if str(printed.get("fileName", "")).lower() == path.lower():
            return print_file(printed)
        kept = self._files.get(path)
        if kept is None:
            return None
        until, changes, file = kept
        is_good = time.monotonic() < until and changes == self._questions.changes_of_the_card()
        return file if is_good else None

    async def _fetch(self, path, file):
        async with self._turn:
            file = file or await self._file(path)
            key = self._key(path, file)
            if key not in self._pictures:
                thumbnail = best(file.thumbnails)
                found = await self._picture(path, thumbnail) if thumbnail else None
                self._keep(key, found)
            return self._pictures[key]

    async def _file(self, path):
        changes = self._questions.changes_of_the_card()
        file = await self._questions.ask_about_the_card(FileRequest(path))
        if file is NoFile:
            raise RequestRefused(404, gettext("The machine has no such file."))
        if len(self._files) >= MOST_FILES:
            self._files.clear()
        self._files[path] = (time.monotonic() + KEPT_SECONDS, changes, file)
        return file

    async def _picture(self, path, thumbnail):
        """Return the picture, ``None`` where what the file has there is none."""
        for _ in range(ATTEMPTS):
            letters = await self._letters(path, thumbnail)
            # QOI takes its time in plain Python
            found = await asyncio.get_running_loop().run_in_executor(None, picture, letters)
            if found is not None:
                return found
        return None

    async def _letters(self, path, thumbnail):
        """Return the picture's base64 text, as far as the board tells it."""
        letters, offset = "", thumbnail.offset
        while len(letters) <= MOST_LETTERS:
            piece = await self._questions.ask_about_the_card(PieceRequest(path, offset))
            letters += piece.data
            if piece.error or piece.next <= offset:
                break
            offset = piece.next
        return letters

    def _keep(self, key, found):
        # that a file has none is worth knowing, too
        self._pictures[key] = found
        size = sum(len(each.data) for each in self._pictures.values() if each)
        while size > MOST_BYTES or len(self._pictures) > MOST_FILES:
            _, gone = self._pictures.popitem(last=False)
            size -= len(gone.data) if gone else 0


_NONE = object()
"""Instead of a picture where there is none."""


class ThumbnailHandler(LiveModelHandler):
    """Answers with the picture itself; ``thumbnails`` are ``Thumbnails``."""

    def initialize(self, questions, app, thumbnails):
        """Take what Tornado hands over from the route."""
        super().initialize(questions, app)
        self._thumbnails = thumbnails

    async def get(self):
        """Answer with the picture, 404 where there is none; Tornado makes the ETag."""
        name = self._argument("path")
        path = path_of(name)
        reason = refusal_of(name) or refusal_of(path)
        if reason:
            self._refuse(400, reason)
            return
        picture_of = self._if_any if self._argument("if_any") else self._thumbnails.of
        found = await self._answer_of(picture_of(path))
        if found is _NONE:
            self.set_status(204)
            self.finish()
        elif found is not None:
            self.set_header("Content-Type", found.kind)
            self.set_header("X-Content-Type-Options", "nosniff")
            self.set_header("Cache-Control", f"private, max-age={SHOWN_SECONDS}")
            self.finish(found.data)

    async def _if_any(self, path):
        """Return the picture or ``_NONE``: in a list of files many have none."""
        try:
            return await self._thumbnails.of(path)
        except RequestRefused:
            return _NONE
