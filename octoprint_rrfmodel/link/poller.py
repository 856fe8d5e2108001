"""One poll at a time: what to ask comes from the follower, when from the pace.

All of this runs on the worker thread, which calls ``tick`` and hands in what the hooks noted.
"""

import logging

from ..rrf.follow.pace import Pace
from ..rrf.wire.line import NO_BUFFERS
from ..rrf.wire.reply import MalformedReply
from .card_turn import CardTurn
from .poll_slot import GONE, Poll, Queries, answer_query, fail
from .poll_times import PollTimes

ANSWER_SECONDS = 10.0
"""Time that a poll has from being sent; RRF 3.5 waits for buffers before it answers."""

QUEUED_SECONDS = 30.0
"""Time after which a poll that never left OctoPrint's queue is taken for lost."""

ALARMS = frozenset(("fault", "reset"))
"""What the firmware tells by itself that is a witness to what the model says next."""

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
        self._card = CardTurn(card, follower, link)
        self._link = link
        self._known = known
        self._replied = replied
        self._clock = clock
        self._pace = Pace()
        self._times = PollTimes(follower, self._card, link, pace=self._pace)
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.polling")
        self._poll = None
        self._running = False
        self._knows_numbers = True
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
        self._knows_numbers = True
        self._next_at = self._clock()
        self._link.expects_refusal = self.follower.protocol is None

    def forgotten(self):
        """Poll no more and know nothing: the connection is gone."""
        self._running = False
        self._queries.close()
        if self._poll is not None and not self._poll.answered:
            self._count("timeouts" if self._poll.sent_at is not None else None)
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

    def asked(self):
        """Return the line of the poll that is under way, ``None`` where none is."""
        return self._poll and self._poll.request.line

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
        return self._times.interval()

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
        self._next_at = self._clock() + self._times.hurry()

    ##~~ what the hooks noted

    def poll_sent(self, at, number=None):
        """Note that the poll went out, and when: this note may come late.

        ``number`` is its line number, if it went out with one.
        """
        if self._poll is not None and self._poll.sent_at is None:
            self._poll.sent_at = at
            self._poll.number = number if self._knows_numbers else None
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
        if is_model and poll.is_refused_by(line):
            self._count("replies")
            self.follower.not_supported()
            self._end(failed=False)

    def reply(self, text, number=None):
        """Take a reply that was found on the line; ``number`` is that of the command it answers.

        One to another command than the poll isn't the poll's, whatever it looks like.
        """
        self.bytes += len(text)
        poll = self._poll
        if poll is None or poll.sent_at is None or poll.answered:
            return
        if not poll.may_be_answered_by(text, number):
            return
        if poll.is_card:
            outcome = self._card.take(text)
            if outcome == "replies":
                self._pace.answered(len(text), self._clock() - poll.sent_at)
            poll.answered = outcome is not None
            self._count(outcome)
            self._finish_if_over()
            return
        if poll.query is not None:
            if answer_query(poll, text):
                poll.answered = True
                self._count("out_of_buffers" if text == NO_BUFFERS else "replies")
                self._finish_if_over()
            return
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
        # where the whole was only tried the parts come next
        if text == NO_BUFFERS and self.follower.short_of_buffers:
            self._pace.failed()
        else:
            self._pace.answered(len(text), self._clock() - poll.sent_at, self.follower.is_amid)
        if text != NO_BUFFERS or taken.changes:
            self._held_for = None
            if taken.is_doubted:
                self.hurry()
            else:
                self._known.note(poll.request, poll.sent_at)
                self._replied(taken, poll.sent_at)
        self._finish_if_over()

    def heard(self, what):
        """Note what a line tells: that the board refused to answer, or that something happened."""
        if what == "card":
            self._card_refused()
            return
        if what in ALARMS:
            self.follower.told()
        self.hurry()

    def _card_refused(self):
        poll = self._poll
        if poll is None or not poll.is_about_the_card or poll.sent_at is None or poll.answered:
            return
        poll.answered = True
        self._count("replies")
        if poll.query is not None:
            fail(poll.query, "the printer refused")
        else:
            (self._card.failed if poll.is_card else self.follower.not_supported)()
        self._finish_if_over()

    def _count(self, outcome):
        """Count what has become of a poll; the follower counts its own."""
        if outcome is not None:
            self.follower.counters[outcome] += 1

    ##~~ the poll slot

    def _start_poll(self, now):
        # turn by turn, so that the model stays fresh whoever asks
        request, query = (None, None) if self._was_query else self._queries.next()
        self._was_query = query is not None
        is_card = False
        if request is None:
            request = None if self.follower.is_amid else self._card.request()
            is_card = request is not None
        else:
            self._card.is_over()
        self._times.choose()
        request = request or self.follower.next_request()
        self._poll = Poll(request, query, is_card=is_card, queued_at=now)
        self._link.ask(request)

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
        if poll.sent_at is None:
            self._link.give_up()
        # if only the number spoke against it, it is not what it was taken for
        self._knows_numbers = self._knows_numbers and not poll.answered_others
        if poll.is_card or poll.query is not None:
            self._count("timeouts")
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
        self._next_at = self._clock() + self._times.wait(self._hurries)
        self._hurries = False
