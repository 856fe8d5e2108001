"""Questions to the printer itself, from a program, a page or another plugin."""

import asyncio

from flask_babel import gettext

from ..host.answers import RequestRefused
from ..rrf.wire.request import FLAGS_LENGTH, KEY_LENGTH

ATTEMPTS = 3
"""Times that a question about the card is asked: an answer may be lost, or there be no room."""

PAUSE_SECONDS = 0.3


class Questions:
    """Hands questions to the poller, as long as the printer can be asked."""

    def __init__(self, poller, link):
        self._link = link
        self._poller = poller

    def ask(self, key, flags):
        """Return a future of the printer's own answer; raise ``TooManyQueries`` when full."""
        return self._poller.query(key, flags)

    async def ask_about_the_card(self, request):
        """Return the answer, asked for again where the board gave none; 409 beside a print."""
        for attempt in range(1, ATTEMPTS + 1):
            # one may have begun meanwhile; whatever else is in the way goes by
            reason = self.refusal_for_a_print()
            if reason:
                raise RequestRefused(409, reason)
            try:
                return await asyncio.wrap_future(self._poller.query_for(request))
            except RuntimeError:
                if attempt == ATTEMPTS:
                    raise
            await asyncio.sleep(PAUSE_SECONDS)

    def height_map(self):
        """Return a future of the mesh in use and its file, ``None`` where no file can be read."""
        return self._link.read_height_map()

    def connections(self):
        """Return a number for the connection that is there now."""
        return self._poller.connections

    def changes_of_the_card(self):
        """Return what is another after each change of the card, as far as the board counts them.

        And for another board, or the same one after a reset, which begin to count anew.
        """
        counted = self._poller.follower.store.model.get("seqs", {}).get("volChanges")
        return str((self._poller.connections, self._poller.follower.resets, counted))

    def refusal_of_the_card(self):
        """Return why nothing can be asked about the card now, ``None`` where it can."""
        if self._link.is_rrf and self._poller.follower.protocol == "M408":
            return gettext("Over USB the card can be read from RepRapFirmware 3.1 on.")
        return self.refusal_for_a_print() or self.refusal()

    def refusal_for_a_print(self):
        """Return why a print keeps the card from being asked about, ``None`` where none does."""
        if self._link.is_streaming_a_print():
            # reading a card takes its time, and the print's lines would wait
            return gettext("OctoPrint prints. Look at the machine's card afterwards.")
        return None

    def refusal(self):
        """Return why the printer can't be asked now, ``None`` where it can."""
        if not self._link.is_rrf:
            return why_empty(self._link)
        if self._poller.follower.protocol == "M408":
            return gettext("This firmware has no M409 and can't be asked for a key.")
        if self._poller.blocked():
            return gettext("The printer is busy and can't be asked now. Try again later.")
        return None


def why_empty(link):
    """Return why no model is known."""
    if not link.is_operational:
        return gettext("No printer is connected, so no model is known. Connect it first.")
    if not link.is_rrf:
        return gettext("The connected printer has not said that it runs RepRapFirmware.")
    return gettext("The printer has not told its model yet. Try again in a few seconds.")


def refusal_to_send(key, flags):
    """Return why a key and flags can't be sent to the printer, ``None`` where they can."""
    if len(key) > KEY_LENGTH:
        return gettext("The key is longer than the 100 characters that the firmware takes.")
    if len(flags) > FLAGS_LENGTH:
        return gettext("The flags are longer than the 20 characters that the firmware takes.")
    if not (key + flags).isprintable() or not (key + flags).isascii():
        return gettext("Key and flags may hold only printable ASCII characters.")
    if ";" in key + flags:
        return gettext("Key and flags may hold no semicolon: G-code takes it for a comment.")
    return None
