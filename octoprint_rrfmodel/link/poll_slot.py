"""What is known of the one poll that may be under way, and of the questions that wait for it."""

import collections
import concurrent.futures
import re
import threading

from ..rrf.follow.asked import answer_to
from ..rrf.wire.line import NO_BUFFERS
from ..rrf.wire.reply import MalformedReply
from ..rrf.wire.request import (
    FileRequest,
    JobFileRequest,
    ListRequest,
    ModelRequest,
    PieceRequest,
)

ABOUT_THE_CARD = (ListRequest, FileRequest, PieceRequest, JobFileRequest)
"""Requests that the board refuses with ``Error: M20: ...`` and the like."""

NOT_KNOWN = re.compile(r"not supported|unsupported|unknown|bad command")
"""How firmware of various age says that it hasn't got a command."""

MOST_QUERIES = 4
"""Questions to the printer that may wait for the one poll slot."""


class TooManyQueries(Exception):
    """As many questions as may wait for the slot are waiting."""


class Poll:
    """A request, from OctoPrint's queue to its answer and its acknowledgement."""

    def __init__(self, request, query, *, is_card, queued_at):
        self.request = request
        self.query = query
        self.is_card = is_card
        self.queued_at = queued_at
        self.sent_at = None
        self.number = None
        """Line number that it went out with, if with any."""
        self.answered_others = False
        """Whether a reply that looked like its own told another number."""
        self.acknowledged = False
        self.answered = False
        self.is_about_the_card = isinstance(request, ABOUT_THE_CARD)

    def may_be_answered_by(self, text, number):
        """Return whether a reply is of the kind asked for, and to this command if it says so."""
        if text != NO_BUFFERS and not text.startswith(self.request.begins):
            return False
        if None in (number, self.number) or number == self.number:
            return True
        self.answered_others = True
        return False

    def is_refused_by(self, line):
        """Return whether a line says that the firmware hasn't got the command."""
        return NOT_KNOWN.search(line.lower()) is not None and self.request.line.split()[0] in line

    def is_over(self):
        """Return whether the next poll may leave."""
        return self.answered and self.acknowledged


class Queries:
    """Questions that wait for the slot; any thread may ask while there is a printer."""

    def __init__(self):
        self._waiting = collections.deque()
        self._lock = threading.Lock()
        self._is_open = False

    def __len__(self):
        """Return how many wait."""
        return len(self._waiting)

    def open(self):
        """Take questions: there is a printer."""
        self._is_open = True

    def close(self):
        """Take no more, and fail those that wait."""
        with self._lock:
            self._is_open = False
            waiting = list(self._waiting)
            self._waiting.clear()
        for _, future in waiting:
            fail(future, GONE)

    def ask(self, key, flags):
        """Return a future of the printer's own answer; raise ``TooManyQueries`` when full."""
        return self.ask_for(ModelRequest(key, flags))

    def ask_for(self, request):
        """Return a future of what ``rrf.follow.asked`` makes of the answer."""
        future = concurrent.futures.Future()
        with self._lock:
            if self._is_open and len(self._waiting) >= MOST_QUERIES:
                raise TooManyQueries
            if self._is_open:
                self._waiting.append((request, future))
                return future
        fail(future, GONE)
        return future

    def next(self):
        """Return the next request with its future, ``(None, None)`` where nobody waits."""
        while self._waiting:
            request, future = self._waiting.popleft()
            if future.set_running_or_notify_cancel():
                return request, future
        return None, None


GONE = "the printer was disconnected"


def fail(future, reason):
    """Let a future fail, if it isn't done."""
    if not future.done():
        future.set_exception(RuntimeError(reason))


def answer_query(poll, text):
    """Give a reply to who asked; return whether it is the answer."""
    try:
        answer = answer_to(poll.request, text)
    except MalformedReply as error:
        fail(poll.query, str(error))
        return True
    if answer is not None:
        poll.query.set_result(answer)
    return answer is not None
