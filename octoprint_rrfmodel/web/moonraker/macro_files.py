"""Which macro files are on the machine's card: read once, and again when the card has changed."""

import asyncio
import concurrent.futures
import logging
import threading

FOLDER = "0:/macros"

MOST_FOLDERS = 20
MOST_FILES = 200
"""What is looked at; a folder is a question to the board, which others wait behind."""

WAIT_SECONDS = 2.0
"""How long who asks for objects waits for macros that nobody has read yet."""

PAUSE_SECONDS = 30.0
"""Between a reading that failed and the next."""


class MacroFiles:
    """Reads the names on Tornado's loop, where ``look`` is called; any other thread may ``wait``.

    ``found(paths)`` is called with what there is. ``folders`` are ``web.files_api.Folders``,
    ``questions`` knows whether the card may be asked about, and when it changes.
    """

    def __init__(self, found, loop, folders, *, questions):
        self._found = found
        self._loop = loop
        self._folders = folders
        self._questions = questions
        self._thread = threading.get_ident()
        self._known = None
        self._reading = None
        self._not_before = 0.0
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.macros")

    def wait(self):
        """Have the macros looked for if they may have changed, and wait a little for them."""
        if threading.get_ident() == self._thread or not self._is_due():
            return
        try:
            look = asyncio.run_coroutine_threadsafe(self._look(), self._loop.asyncio_loop)
            look.result(WAIT_SECONDS)
        except (concurrent.futures.TimeoutError, RuntimeError):
            return  # they come later

    def _is_due(self):
        return (
            self._questions.changes_of_the_card() != self._known
            and self._questions.refusal_of_the_card() is None
        )

    async def _look(self):
        if self._reading is None:
            # another may have looked since it was found to be due
            if not self._is_due() or self._loop.time() < self._not_before:
                return
            self._reading = asyncio.ensure_future(self._read())
        # who gives up must not end it for the others
        await asyncio.shield(self._reading)

    async def _read(self):
        changes = self._questions.changes_of_the_card()
        try:
            self._found(tuple(await self._files()))
            self._known = changes
        except Exception as error:
            # no card, no such folder, a print that has begun, an answer that was lost
            self._not_before = self._loop.time() + PAUSE_SECONDS
            self._logger.info("Could not read the macros: %s", error)
        finally:
            self._reading = None

    async def _files(self):
        found, folders = [], [FOLDER]
        for folder in folders:
            for entry in await self._folders.entries(folder):
                path = f"{folder}/{entry['name']}"
                if not entry["folder"]:
                    found.append(path)
                elif len(folders) < MOST_FOLDERS:
                    folders.append(path)
        return sorted(found)[:MOST_FILES]
