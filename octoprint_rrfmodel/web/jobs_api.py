"""``GET /plugin/rrfmodel/jobs``: the last prints and how they ended, kept over a restart."""

import threading
import time

from flask_babel import gettext
from octoprint.events import Events
from octoprint.filemanager import FileDestinations

from ..host.answers import answer, may_read, refusal
from ..rrf.views.board_runs import BoardRuns
from ..rrf.views.past_job import (
    ABORTED,
    CANCELLED,
    CARD,
    FINISHED,
    OCTOPRINT,
    PastJob,
    PastJobs,
    read_all,
    written,
)

OUTCOMES = {
    Events.PRINT_DONE: FINISHED,
    Events.PRINT_CANCELLED: CANCELLED,
    Events.PRINT_FAILED: ABORTED,
}


class JobHistory:
    """Notes what is printed, by whom and how it ends.

    ``model()`` is the snapshot, ``link`` the line to the board,
    ``kept`` is the file (``host.kept_json.KeptJson``). Told of the board's prints by the worker, of
    OctoPrint's by its events; ``keep()`` is run by the thread that may wait for a disk, which
    ``later()`` asks for.
    """

    def __init__(self, model, link, kept, *, later, now=time.time):
        self._model = model
        self._link = link
        self._kept = kept
        self._later = later
        self._now = now
        self._lock = threading.Lock()
        self._board = BoardRuns()
        self._streamed = None
        self._past = PastJobs()
        self._open = None
        # another one after a restart, too
        self._changes = int(now())
        self._news = []
        self._tell = None

    def attach(self, tell):
        """Have ``tell(action, job, is_over)`` called where one has begun or ended.

        By the thread that may wait; ``action`` is ``added`` or ``finished``.
        """
        self._tell = tell

    def load(self):
        """Take what was kept, before anything is noted.

        A print that OctoPrint sent ended with OctoPrint; one of the board's may go on.
        """
        kept = self._kept.read()
        if not isinstance(kept, dict):
            return
        with self._lock:
            for job in read_all(kept.get("jobs")):
                self._past.add(job)
            for job in read_all(kept.get("open")):
                if job.source == CARD:
                    self._board.resume(job)
                else:
                    self._past.add(job._replace(outcome=ABORTED))
            self._open = self._under_way()

    ##~~ a listener

    def replied(self, taken, asked_at):
        """Take what the model says after a reply."""
        self._look()

    def reset(self):
        """Take that the board began anew."""
        self._look()

    def line(self, line):
        """Take a line of text from the printer."""
        with self._lock:
            self._board.heard(line)

    def forgotten(self):
        """Note that the board isn't heard any more."""
        with self._lock:
            self._board.away()

    def _look(self):
        model, now = self._model(), self._now()
        with self._lock:
            self._take(self._board.look(model, now))

    ##~~ OctoPrint's events

    def on_event(self, event, payload):
        """Note where a print begins that OctoPrint sends, and how it ends."""
        with self._lock:
            if event == Events.PRINT_STARTED:
                is_sent = payload.get("origin") == FileDestinations.LOCAL
                if is_sent and self._link.is_rrf:
                    # one whose end nobody has told
                    lost, path = self._streamed, payload.get("path") or ""
                    self._streamed = PastJob(OCTOPRINT, path, self._now())
                    self._take([lost._replace(outcome=ABORTED)] if lost else [])
            elif event in OUTCOMES and self._streamed is not None:
                if event == Events.PRINT_FAILED and payload.get("reason") == "cancelled":
                    return  # told once more as cancelled
                job, self._streamed = self._streamed, None
                ended = job._replace(
                    ended=self._now(), outcome=OUTCOMES[event], duration=payload.get("time")
                )
                self._take([ended])

    def _under_way(self):
        found = (self._board.open, self._streamed)
        return [job for job in found if job is not None]

    def _take(self, ended):
        """Note what has ended, and have it kept if that or what is under way is news."""
        for job in ended:
            self._past.add(job)
        under_way = [job._replace(duration=None) for job in self._under_way()]
        if ended or under_way != self._open:
            self._news += [("finished", job, True) for job in ended]
            for job in under_way:
                # the board tells which file it is later than that there is a print
                if job.path and not any(map(job.is_the_same, self._open or ())):
                    self._news.append(("added", job, False))
            self._open = under_way
            self._changes += 1
            self._later()

    ##~~ the thread that may wait

    def keep(self):
        """Write down what is known now."""
        with self._lock:
            jobs, under_way = self._past.all(), self._open or []
            news, self._news = self._news, []
        self._kept.write({"jobs": list(map(written, jobs)), "open": list(map(written, under_way))})

        for each in news if self._tell else ():
            self._tell(*each)

    ##~~ any thread

    def all(self):
        """Return the prints, the last one first, each with whether it is over."""
        with self._lock:
            under_way, over = self._under_way(), self._past.latest()
        return [(job, False) for job in under_way] + [(job, True) for job in over]

    def forget(self, fits):
        """Keep those that are over no longer for which ``fits(job)`` holds; return them."""
        with self._lock:
            gone = [job for job in self._past.latest() if fits(job)]
            self._past.remove(gone)
            if gone:
                self._changes += 1
                self._later()
        return gone

    def changes(self):
        """Return another number after each change of what is told."""
        return self._changes

    def get_jobs(self):
        """Return the prints that are over, the last one first."""
        if not may_read():
            return refusal(403, gettext("You may not read the machine's model."))
        with self._lock:
            jobs = self._past.latest()
        return answer({"jobs": list(map(_told, jobs))})


def _told(job):
    return {"name": job.name, **written(job)}
