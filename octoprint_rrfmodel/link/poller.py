"""One poll at a time: what to ask comes from the follower, when from the pace.

All of this runs on the worker thread, which calls ``tick`` and hands in what the hooks noted.
"""

import logging
import re

from ..rrf.follow.pace import Pace
from ..rrf.views.machine import Machine
from ..rrf.wire.line import NO_BUFFERS
from ..rrf.wire.reply import MalformedReply, decode_page
from .poll_slot import GONE, Poll, Queries, answer_query, fail

ANSWER_SECONDS = 10.0
"""Time that a poll has from being sent; RRF 3.5 waits for buffers before it answers."""

QUEUED_SECONDS = 30.0
"""Time after which a poll that never left OctoPrint's queue is taken for lost."""

NOT_KNOWN = re.compile(r"not supported|unsupported|unknown|bad command")
"""How firmware of various age says that it hasn't got a command."""

CARD_POLLS_BETWEEN_LIVE = 2
"""Requests about the card in a row before the model has its turn."""

STALE_POLLS = 3
"""Poll intervals without news after which the model is stale."""


class Poller:
    """Sends polls while nothing is in the way, and feeds what comes to the follower.

    ``link`` is asked whether the line is free and sends requests. ``follower`` says what to ask
    and takes replies, ``card`` the same about the card. ``known`` is noted what was applied, and
    ``replied(taken, asked_at)`` told.
    """

    def __init__(self, follower, card, link, *, known, replied, clock):
        self.follower = follower
        self._card = card
        self._card_polls = 0
        self._link = link
        self._known = known
        self._replied = replied
        self._clock = clock
        self._pace = Pace()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.polling")
        self._poll = None
        self._running = False
        self._next_at = 0.0
        self._hurries = False
        self._queries = Queries()
        self._was_query = False
        self._held_for = None
        self.query = self._queries.ask
        self.query_for = self._queries.ask_for
        self.connections = 0
        """How many there were since OctoPrint's start."""
        self.polls = 0
        self.bytes = 0

    def identified(self):
        """Begin to poll: the printer has just told that it runs RepRapFirmware."""
        self.connections += 1
        self._pace.connected(self._link.rate())
        self._running = True
        self._queries.open()
        self._next_at = self._clock()
        self._link.expects_refusal = self.follower.protocol is None

    def forgotten(self):
        """Poll no more and know nothing: the connection is gone."""
        self._running = False
        self._queries.close()
        if self._poll is not None and self._poll.query is not None:
            fail(self._poll.query, GONE)
        self._poll = self._held_for = None
        self._known.forget()
        self.follower.forget()

    def tick(self):
        """Send what is due; return the seconds until there may be something to do again."""
        if not self._running:
            return 60.0
        now = self._clock()
        if self._poll is not None:
            self._watch(now)
        # what somebody asks beside a print comes in its turn: the print's lines would wait
        is_due = now >= self._next_at or (
            len(self._queries) and not self._link.is_streaming_a_print()
        )
        if self._poll is None and is_due and not self.blocked():
            self._start_poll(now)
        self._held_for = self.blocked() or self._held_for
        if self._poll is not None or self.blocked():
            return 0.25
        return max(0.01, self._next_at - now)

    def blocked(self):
        """Return why no poll goes out: the line's reason, or ``buffers``."""
        if not self._running:
            return None
        reason = self._link.blocked()
        if reason is None and self.follower.short_of_buffers and self._clock() < self._next_at:
            reason = "buffers"
        return reason

    def why_silent(self):
        """Return what holds polls back, or has until now while the first reply is on its way."""
        return self.blocked() or (self._held_for if self.is_stale() else None)

    def interval(self):
        """Return the seconds between two polls as they go now."""
        return self._pace.wait(self._link.is_streaming_a_print())

    def is_stale(self):
        """Return whether the model is older than three poll intervals."""
        age = self._known.age()
        return age is None or age > STALE_POLLS * self.interval()

    def look(self, key=None):
        """Ask soon, and for ``key`` again, "" for all; beside a print everything in its turn."""
        if key is not None:
            self.follower.refetch(key)
        if not self._link.is_streaming_a_print():
            self.hurry()

    def hurry(self):
        """Ask as soon as may be: something has happened."""
        self._hurries = self._poll is not None
        self._next_at = self._clock()

    ##~~ what the hooks noted

    def poll_sent(self, at):
        """Note that the poll went out, and when: this note may come late."""
        if self._poll is not None and self._poll.sent_at is None:
            self._poll.sent_at = at
            self.polls += 1

    def poll_acknowledged(self):
        """Note that the board is through with the poll, whatever it has answered."""
        if self._poll is not None and self._poll.sent_at is not None:
            self._poll.acknowledged = True
            self._finish_if_over()

    def refused(self, line):
        """Note a line that says that a command isn't known, if it is about ours."""
        poll = self._poll
        is_model = poll is not None and poll.query is None and not poll.is_card
        if not is_model or not NOT_KNOWN.search(line.lower()):
            return
        if poll.request.line.split()[0] in line:
            self.follower.not_supported()
            self._end(failed=False)

    def reply(self, text):
        """Take a reply that was found on the line."""
        self.bytes += len(text)
        poll = self._poll
        if poll is None or poll.sent_at is None or poll.answered:
            return
        if text != NO_BUFFERS and not text.startswith(poll.request.begins):
            return
        if poll.is_card:
            self._take_page(poll, text)
            return
        if poll.query is not None:
            if answer_query(poll, text):
                poll.answered = True
                self._finish_if_over()
            return
        asked_at = poll.sent_at
        try:
            taken = self.follower.take(text)
        except MalformedReply as error:
            self._logger.debug("Reply not understood, asking again: %s", error)
            poll.answered = True
            self._pace.failed()
            self._finish_if_over()
            return
        if taken is None:
            return
        poll.answered = True
        self._link.expects_refusal = False
        if text == NO_BUFFERS:
            self._pace.failed()
        else:
            self._pace.answered(len(text), self._clock() - asked_at)
            self._held_for = None
            self._known.note(poll.request, asked_at)
            self._replied(taken, asked_at)
        self._finish_if_over()

    def heard(self, what):
        """Note what a line tells: that the board refused to answer, or that something happened."""
        if what == "card":
            self._card_refused()
        else:
            self.hurry()

    def _card_refused(self):
        poll = self._poll
        if poll is None or not poll.is_about_the_card or poll.sent_at is None or poll.answered:
            return
        poll.answered = True
        if poll.is_card:
            self._card.failed()
        else:
            fail(poll.query, "the printer refused")
        self._finish_if_over()

    ##~~ the poll slot

    def _start_poll(self, now):
        # turn by turn, so that the model stays fresh whoever asks
        request, query = (None, None) if self._was_query else self._queries.next()
        self._was_query = query is not None
        is_card = False
        if request is None and self._is_cards_turn():
            request = self._card.next_request()
            is_card = request is not None
        self._card_polls = self._card_polls + 1 if is_card else 0
        request = request or self.follower.next_request()
        self._poll = Poll(request, query, is_card=is_card, queued_at=now)
        self._link.ask(request)

    def _is_cards_turn(self):
        """Return whether the card may be asked about: never beside a print that is streamed."""
        return (
            self.follower.ready
            and self._card_polls < CARD_POLLS_BETWEEN_LIVE
            and not self._link.is_streaming_a_print()
            and not Machine(self.follower.store.model).is_halted
        )

    def _watch(self, now):
        """Give up a poll whose answer, or whose leaving, takes too long."""
        poll = self._poll
        if poll.answered:
            # its ok was lost; OctoPrint finds that out by itself
            if now - poll.sent_at > ANSWER_SECONDS:
                self._end(failed=False)
        elif poll.sent_at is not None:
            if now - poll.sent_at > ANSWER_SECONDS:
                self._time_out(poll)
        elif now - poll.queued_at > QUEUED_SECONDS and not self._link.blocked():
            self._time_out(poll)

    def _time_out(self, poll):
        self._held_for = None
        if poll.is_card:
            self._card.failed()
        elif poll.query is None:
            self.follower.timed_out()
        else:
            fail(poll.query, "the printer did not answer in time")
        self._end(failed=True)

    def _finish_if_over(self):
        if self._poll.is_over():
            self._end(failed=False)

    def _end(self, failed):
        if failed:
            self._pace.failed()
        self._poll = None
        wait = self._pace.wait(
            self._link.is_streaming_a_print(),
            behind=self.follower.behind or self._card.behind,
            begins=not self.follower.ready,
        )
        self._next_at = self._clock() + (0.0 if self._hurries else wait)
        self._hurries = False

    def _take_page(self, poll, text):
        """Take a page of a folder's list."""
        try:
            page = None if text == NO_BUFFERS else decode_page(text)
        except MalformedReply as error:
            self._logger.debug("List not understood, asking again: %s", error)
            page = None
        if page is None:
            # the model comes first: a card that can't be read must not slow it down
            self._card.failed()
            self._card_polls = CARD_POLLS_BETWEEN_LIVE
        elif not self._card.take(page):
            return
        else:
            self._pace.answered(len(text), self._clock() - poll.sent_at)
        poll.answered = True
        self._finish_if_over()
