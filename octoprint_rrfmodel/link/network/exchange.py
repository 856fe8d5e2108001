"""The talk with one board, on a thread of its own: one request after the other.

Its order: a reply that waits on the board, a command, the poller's question, what can wait. Where
the board doesn't answer it tries again by itself, ever more rarely; a command is never repeated.
"""

import collections
import logging
import threading

from .dialects import DIALECTS
from .login import Busy, Refused
from .session import SessionLost
from .transport import Unreachable

FIRST_PAUSE = 0.5
LONGEST_PAUSE = 10.0
"""Seconds between two tries to reach a board: each is twice as long as the one before."""

SLOT_SECONDS = 8.5
"""Time after which a slot of somebody who has gone is free again."""

PATIENCE_WITH_SLOTS = 30.0
"""Time that a first login has where all slots are taken."""

ERRAND_SECONDS = 0.7
"""Between two things that can wait, so that the poller's questions come in between."""

FINAL = ("wrong_password",)
"""Refusals after which there is no use in going on with a board that was known already."""

GONE = "gone"
"""Why it ends where the board has not come back."""


class Exchange:
    """Talks with the board of ``session`` and tells ``news`` (``news.News``) until it is closed.

    ``patience()`` says how many seconds the board may be gone for, ``ration`` (``ration.Ration``)
    how often it is asked what can wait.
    """

    def __init__(self, session, news, clock, *, patience, ration):
        self._session = session
        self._news = news
        self._clock = clock
        self._patience = patience
        self._ration = ration
        self._changed = threading.Condition()
        self._is_open = True
        self._is_greeted = False
        self._request = None
        self._dialect = DIALECTS["rr"](session, clock, self._wake)
        self._errands = collections.deque()
        self._errand_at = 0.0
        self._away_since = None
        self._pause = FIRST_PAUSE
        self._began_at = clock()
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.network")
        self._thread = threading.Thread(target=self._run, name="rrfmodel.network", daemon=True)

    def start(self):
        """Begin to log in."""
        self._thread.start()

    def close(self):
        """Tell nothing any more from now on; the slot is given back behind the caller's back."""
        with self._changed:
            self._is_open = False
            self._changed.notify_all()

    @property
    def dialect(self):
        """How to talk with the board beside all this (``dialect.Dialect``): its files, a stop."""
        return self._dialect

    @property
    def is_away(self):
        """Whether the board doesn't answer for now."""
        return self._away_since is not None

    def ask(self, request):
        """Ask the poller's question, in place of the one before."""
        self._do(lambda: setattr(self, "_request", request))

    def give_up(self):
        """Don't ask what was not asked yet."""
        self._request = None

    def send(self, line, first=False):
        """Queue a command; ``first`` goes in front of those that wait."""
        if self.is_away or not self._is_greeted:
            self._tell("unsent", line, "away")
            return
        self._do(lambda: self._dialect.commands.add(line, first))

    def run(self, errand):
        """Queue what can wait: ``errand(dialect)``, called on this thread."""
        self._do(lambda: self._errands.append(errand))

    def waiting(self):
        """Return the commands that were not sent yet."""
        return self._dialect.commands.lines()

    def drop(self, why):
        """Send no command that was not sent yet."""
        for line in self._dialect.commands.clear():
            self._tell("unsent", line, why)

    def pause(self, seconds):
        """Wait, on whatever other thread, or until this is closed."""
        self._wait(seconds)

    def _do(self, change):
        with self._changed:
            change()
            self._changed.notify_all()

    def _wake(self):
        self._do(lambda: None)

    def _tell(self, name, *arguments):
        if self._is_open:
            getattr(self._news, name)(*arguments)

    ##~~ on the thread

    def _run(self):
        while self._is_open:
            try:
                self._go_on()
            except Exception:
                self._logger.exception("Could not talk with the board")
                self._wait(FIRST_PAUSE)
        # what keeps a session alive may be a part of the dialect
        self._session.log_out()
        self._dialect.leave()

    def _go_on(self):
        try:
            if not self._is_greeted or self.is_away:
                self._greet()
            else:
                self._next()
        except Unreachable as error:
            self._is_not_there(str(error))
        except Refused as refused:
            self._is_refused(refused.code)
        except Busy:
            self._wait(FIRST_PAUSE)
        except SessionLost:
            # it was reset: what was meant for the board as it was is nothing for it as it is
            self._logger.info("The board has forgotten the session")
            self.drop("reset")
            self._tell("lost")
            if not self._is_greeted:
                self._end("not_rrf", "")
            elif self.is_away:
                self._wait(self._pause)

    def _greet(self):
        greeting = self._session.log_in()
        if greeting.protocol != self._dialect.protocol:
            self._dialect.leave()
            self._dialect = DIALECTS[greeting.protocol](self._session, self._clock, self._wake)
        self._dialect.enter()
        if self._is_greeted:
            # it was there a moment ago, or has forgotten everything since
            asked_at = self._clock()
            up_time = self._dialect.up_time()
            self._away_since = None
            self._logger.info("The board is there again")
            self._tell("back", up_time, asked_at)
        else:
            self._is_greeted = True
            self._tell("greeted", greeting)
        self._pause = FIRST_PAUSE

    def _is_not_there(self, why):
        if not self._is_greeted:
            self._end("unreachable", why)
            return
        now = self._clock()
        if self._away_since is None:
            self._away_since = now
            self._logger.info("The board doesn't answer: %s", why)
            self.drop("away")
            self._tell("away", why)
        if now - self._away_since > self._patience():
            self._end(GONE, why)
            return
        self._wait(self._pause)
        self._pause = min(self._pause * 2, LONGEST_PAUSE)

    def _is_refused(self, code):
        if code == "no_slot" and (
            self._is_greeted or self._clock() - self._began_at < PATIENCE_WITH_SLOTS
        ):
            self._wait(SLOT_SECONDS)
        elif self._is_greeted and code not in FINAL:
            # something else answers in its place for now
            self._is_not_there(code)
        else:
            self._end(code, "")

    def _end(self, code, why):
        self._logger.info("The connection ends: %s %s", code, why)
        self._tell("ended", code, why)
        self.close()

    def _wait(self, seconds):
        end = self._clock() + seconds
        with self._changed:
            while self._is_open and (left := end - self._clock()) > 0:
                self._changed.wait(left)

    def _next(self):
        """Do what is next, or wait for something to do."""
        with self._changed:
            job = self._job()
            if job is None and self._is_open:
                self._changed.wait(self._idle_seconds())
                job = self._job()
        if job is not None and self._is_open:
            job()

    def _job(self):
        if self._dialect.has_news:
            return self._hear
        if self._dialect.commands.is_due():
            return self._send
        if self._request is not None and not self._poll_seconds():
            return self._poll
        if self._errands and not self._errand_seconds():
            return self._run_errand
        return None

    def _poll_seconds(self):
        return self._ration.wait() if self._dialect.costs(self._request) else 0.0

    def _errand_seconds(self):
        return max(0.0, self._errand_at - self._clock(), self._ration.wait(spare=1))

    def _idle_seconds(self):
        waits = [1.0]
        if self._request is not None:
            waits.append(self._poll_seconds())
        if self._errands:
            waits.append(self._errand_seconds())
        if self._dialect.commands.lines():
            waits.append(self._dialect.commands.at - self._clock())
        return max(0.01, min(waits))

    def _hear(self):
        self._ration.take_spare()
        for news in self._dialect.news():
            self._tell(*news)

    def _send(self):
        line = self._dialect.commands.next()
        if line is None:
            return
        self._ration.take_spare()
        try:
            has_it = self._dialect.commands.send(line)
        except (Unreachable, Busy):
            # nobody knows whether the board has it, and it is not to have it twice
            self._tell("unsent", line, "doubtful")
            raise
        except SessionLost:
            self._tell("unsent", line, "reset")
            raise
        if has_it:
            self._tell("sent", line)

    def _poll(self):
        request = self._request
        if self._dialect.costs(request):
            self._ration.take()
        asked_at, text = self._dialect.answer(request, self._tell)
        if self._request is request:
            self._request = None
        self._tell("polled", request, asked_at, text)

    def _run_errand(self):
        errand = self._errands.popleft()
        self._ration.take()
        try:
            errand(self._dialect)
        finally:
            self._errand_at = self._clock() + ERRAND_SECONDS
