"""``GET /plugin/rrfmodel/files``: folders of the machine's card, which the model doesn't tell."""

import asyncio
import time

from flask_babel import gettext

from ..host.answers import RequestRefused
from ..rrf.wire.request import ListRequest
from .live_api import WAIT_SECONDS, LiveModelHandler

KEPT_SECONDS = 20.0
"""How long a list is good, at most: volumes whose changes the board doesn't count change too."""

MOST_KEPT = 50

MOST_PAGES = 100

LONGEST = 120
"""Longest path that the firmware takes, in bytes (3.5 Configuration.h, MaxFilenameLength)."""

NO_VOLUME = 1
NO_FOLDER = 2
"""Values of ``err`` (3.5 RepRap.cpp:1865)."""


class Folders:
    """Asks for folders, page by page, through the slot of the polls; on Tornado's loop only.

    ``await ask(request)`` gives a page. ``changes()`` is a number that is another after
    each change of the card.
    """

    def __init__(self, ask, changes):
        self._ask = ask
        self._changes = changes
        self._kept = {}
        self._asking = {}

    async def entries(self, path):
        """Return the entries of a folder; who asks at the same time shares one question."""
        kept = self._kept.get(path)
        if kept is not None:
            until, changes, entries = kept
            if time.monotonic() < until and changes == self._changes():
                return entries
        if path not in self._asking:
            task = asyncio.ensure_future(self._read(path))
            self._asking[path] = task
            task.add_done_callback(lambda task: self._asking.pop(path))
        # who gives up must not end it for the others
        return await asyncio.shield(self._asking[path])

    async def _read(self, path):
        changes = self._changes()
        found, first = [], 0
        for _ in range(MOST_PAGES):
            page = await self._ask(ListRequest(path, first))
            if page.error == NO_VOLUME:
                raise RequestRefused(409, gettext("The machine has no card there. Put one in."))
            if page.error:
                raise RequestRefused(404, gettext("The machine has no such folder."))
            found.extend(page.entries)
            if not page.entries or page.next <= first:
                break
            first = page.next
        entries = [
            {
                "name": entry.name,
                "folder": entry.is_folder,
                "size": entry.size,
                "date": entry.date,
            }
            for entry in found
        ]
        if len(self._kept) >= MOST_KEPT:
            self._kept.clear()
        self._kept[path] = (time.monotonic() + KEPT_SECONDS, changes, entries)
        return entries


def refusal_of(path):
    """Return why a folder can't be asked for, ``None`` where it can."""
    if not path.strip() or len(path.encode("utf-8")) > LONGEST:
        return gettext("The path has to have 1 to 120 bytes.")
    if not path.isprintable() or any(letter in path for letter in '";{}'):
        return gettext("The path may hold no quotes, semicolons, braces or control characters.")
    return None


class FolderHandler(LiveModelHandler):
    """Lists a folder of the card; ``folders`` are ``Folders``."""

    def initialize(self, questions, app, folders):
        """Take what Tornado hands over from the route."""
        super().initialize(questions, app)
        self._folders = folders

    async def get(self):
        """Answer with the entries; 404 for no such folder, 409 while polls are held back."""
        path = self._argument("path").rstrip("/")
        reason = refusal_of(path)
        if reason:
            self._refuse(400, reason)
            return
        reason = self._questions.refusal_of_the_card()
        if reason:
            self._refuse(409, reason)
            return
        question = asyncio.wait_for(self._folders.entries(path), WAIT_SECONDS)
        entries = await self._answer_of(question)
        if entries is not None:
            self.write({"path": path, "entries": entries})
