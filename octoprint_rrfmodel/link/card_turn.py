"""When the card is asked about: between the model's polls, never beside a streamed print."""

import logging

from ..rrf.views.machine import Machine
from ..rrf.wire.line import NO_BUFFERS
from ..rrf.wire.reply import MalformedReply, decode_page

POLLS_BETWEEN_LIVE = 2
"""Requests about the card in a row before the model has its turn."""


class CardTurn:
    """Hands out the card's requests in their turn, and takes the answers.

    ``card`` says what to ask and takes pages, ``follower`` follows the model, ``link`` is the line.
    """

    def __init__(self, card, follower, link):
        self._card = card
        self._follower = follower
        self._link = link
        self._in_a_row = 0
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.polling")

    @property
    def behind(self):
        """Whether more is to be asked."""
        return self._card.behind

    def request(self):
        """Return what to ask about the card now, ``None`` where it isn't its turn."""
        request = self._card.next_request() if self._may_ask() else None
        self.is_over(request is not None)
        return request

    def is_over(self, asks=False):
        """Note that another poll than the card's goes out, or with ``asks`` one of it."""
        self._in_a_row = self._in_a_row + 1 if asks else 0

    def failed(self):
        """Note that the last request brought nothing."""
        self._card.failed()

    def take(self, text):
        """Take an answer; return which counter counts it, ``None`` where it is another's."""
        outcome = "out_of_buffers"
        try:
            page = None if text == NO_BUFFERS else decode_page(text)
        except MalformedReply as error:
            self._logger.debug("List not understood, asking again: %s", error)
            page, outcome = None, "malformed"
        if page is None:
            # the model comes first: a card that can't be read must not slow it down
            self._card.failed()
            self._in_a_row = POLLS_BETWEEN_LIVE
            return outcome
        return "replies" if self._card.take(page) else None

    def _may_ask(self):
        follower = self._follower
        return (
            follower.ready
            and self._in_a_row < POLLS_BETWEEN_LIVE
            and not self._link.is_streaming_a_print()
            and not Machine(follower.store.model).is_halted
        )
