"""OctoPrint's download of a file of the card, which waits for the board without holding up anybody.

OctoPrint 2.0 reads a printer's file on Tornado's loop, and between two pieces it lets nobody else
have a turn. So a handler of the same name stands in front: it has the file brought here, whole, and
then lets OctoPrint's own send it. ``offer`` has to come before OctoPrint makes its routes, which is
the case while plugins are initialized.
"""

import asyncio
import logging

import octoprint.server.util.tornado as served

from .card_refused import CardRefused
from .reasons import card_sentence

NAME = "StorageFileDownloadHandler"

STORAGE = "printer"

STALE = ("gone", "not_whole")
"""Refusals that a list which isn't true any more may be the cause of."""

STATUSES = {"gone": 404, "busy": 409, "stopped": 409, "no_room": 507}
"""Of refusals; any other is the board's not answering."""


def offer(card):
    """Let downloads from OctoPrint's storage of the printer wait for the board's ``card``."""
    theirs = getattr(served, NAME, None)
    if theirs is None:
        # what isn't here yet is refused then
        logging.getLogger("octoprint.plugins.rrfmodel.network").warning(
            "This OctoPrint has no %s; files of boards on the network can't be downloaded", NAME
        )
        return
    of_octoprint = getattr(theirs, "of_octoprint", theirs)
    setattr(served, NAME, handler_of(of_octoprint, card))


def handler_of(theirs, card):
    """Return OctoPrint's handler with the wait in front of it."""

    class WaitingHandler(theirs):
        of_octoprint = theirs
        _awaited = None

        async def get(self, storage, path, include_body=True):
            file = card.file_of(path) if storage == STORAGE and include_body else None
            if file is None:
                await super().get(storage, path, include_body)
                return
            if self._access_validation is not None:
                self._access_validation(self.request)
            try:
                self._awaited = card.downloads.want(file)
                await asyncio.shield(asyncio.wrap_future(self._awaited.end))
                await super().get(storage, path, include_body)
            except CardRefused as refused:
                self._refuse(refused)
            finally:
                self._release()

        def _refuse(self, refused):
            if refused.code in STALE:
                card.refresh()
            self.set_status(STATUSES.get(refused.code, 504))
            self.finish({"error": card_sentence(refused)})

        def _release(self):
            awaited, self._awaited = self._awaited, None
            if awaited is not None:
                awaited.release()

        def on_connection_close(self):
            # who has gone away wants nothing any more
            self._release()
            super().on_connection_close()

    return WaitingHandler
