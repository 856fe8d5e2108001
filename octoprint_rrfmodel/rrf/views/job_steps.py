"""View: what a host has to do so that the board's job is its own, from one model to the next.

The board prints by itself, so that a host's state only follows; the words are OctoPrint's.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from .event_facts import Facts, Job, end_told, facts_of
from .events import CANCELLED, COMPLETE, end_of

OPERATIONAL = "OPERATIONAL"
STARTING = "STARTING"
PRINTING = "PRINTING"
PAUSED = "PAUSED"
RESUMING = "RESUMING"
CANCELLING = "CANCELLING"
FINISHING = "FINISHING"

STATES = {
    "processing": PRINTING,
    "pausing": "PAUSING",
    "paused": PAUSED,
    "resuming": RESUMING,
    "cancelling": CANCELLING,
}
"""A host's state while ``state.status`` is so."""

ENDS = {
    COMPLETE: ((FINISHING, ""), ("", "done"), (OPERATIONAL, "")),
    CANCELLED: (("", "cancelled"), (OPERATIONAL, "")),
}
"""What follows for a job that has ended so; one that failed is as one that was cancelled."""

ENDS_TOLD = {"Finished": COMPLETE, "Cancelled": CANCELLED}

START_SECONDS = 30.0
"""Time that the board has to begin with what it was told to print."""

END_SECONDS = 60.0
"""Time after which a job that goes on as if nothing had been said is shown as going on."""

HEAR_SECONDS = 4.0
"""Time in which the board says how a job has ended that is gone; the model says that first."""

FILE_SECONDS = 6.0
"""Time in which the model may still name the file of the job before the one that has begun."""

NO_START_SECONDS = 5.0
"""The same where it was told to end it meanwhile."""


class Step(NamedTuple):
    """A state to take, or a call to make; the other one is empty."""

    state: str
    call: str = ""
    """``select`` (a file), ``started``, ``paused``, ``resumed``, ``done``, ``cancelled``;
    ``end_again`` where the board has only paused what is to be ended."""
    path: str = ""


class JobSteps:
    """Follows one board's job. ``state`` is what the host shows.

    Whoever starts or ends a job for the host says so with ``starts`` and ``ends``.
    """

    def __init__(self) -> None:
        self._facts = Facts()
        self._starts_at: float | None = None
        self._path = ""
        self._over: tuple[str | None, float] = None, 0.0
        self._ends_at: float | None = None
        self._unseen_end = ""
        self._gone: tuple[Job, Facts, float] | None = None
        self.state = OPERATIONAL

    def starts(self, path: str, now: float) -> None:
        """Note that the host has told the board to print a file."""
        self._starts_at = now
        self._path = path
        self._unseen_end = ""
        self.state = STARTING

    def ends(self, now: float) -> None:
        """Note that the host has told the board to end its job."""
        self._ends_at = now
        self.state = CANCELLING

    def heard(self, line: str) -> None:
        """Take a line from the board, which may say how the job has ended."""
        self._facts = self._facts.heard(line)
        if self._gone is not None:
            job, facts, at = self._gone
            self._gone = job._replace(heard=end_told(line, job.file) or job.heard), facts, at
        elif self._starts_at is not None:
            how = end_told(line, self._path)
            self._unseen_end = ENDS_TOLD.get(how, self._unseen_end)

    def look(self, model: Mapping[str, Any], now: float) -> list[Step]:
        """Return what to do about a model; ``state`` is the last of them."""
        before, self._facts = self._facts, facts_of(model, self._facts)
        steps = list(self._steps(before.job, self._facts, now))
        for step in steps:
            self.state = step.state or self.state
        return steps

    def _steps(self, before: Job | None, facts: Facts, now: float) -> Iterator[Step]:
        job = facts.job
        if before is not None and (job is None or job.number != before.number):
            self._gone = before, facts, now
            self._over = before.file, now
        if self._gone is not None:
            gone, then, at = self._gone
            if job is None and now - at < HEAR_SECONDS and not self._is_known_how(gone, then):
                return
            self._gone = None
            yield from self._end_steps(gone, then)
        if job is None:
            yield from self._without_job(now)
        elif self.state in (OPERATIONAL, STARTING):
            yield from self._begin_steps(job, now)
        else:
            yield from self._going_on(job, now)

    def _is_known_how(self, job: Job, facts: Facts) -> bool:
        """Return whether nothing has to be heard to know how a job has ended."""
        ends = self._ends_at is not None or job.was_cancelling or bool(job.heard)
        return ends or facts.was_reset or facts.status == "halted"

    def _end_steps(self, job: Job, facts: Facts) -> Iterator[Step]:
        if self.state == OPERATIONAL:
            return
        self._starts_at = None
        how = CANCELLED if self._ends_at is not None and not job.heard else end_of(job, facts)
        self._ends_at = None
        for state, call in ENDS.get(how, ENDS[CANCELLED]):
            yield Step(state, call)
        # for a job that begins with the same model
        self.state = OPERATIONAL

    def _without_job(self, now: float) -> Iterator[Step]:
        """End a job that was over before anybody saw it, or that the board doesn't begin."""
        if self._starts_at is None:
            return
        patience = NO_START_SECONDS if self._ends_at is not None else START_SECONDS
        if not self._unseen_end and now - self._starts_at <= patience:
            return
        self._starts_at = None
        self._ends_at = None
        if self._unseen_end == COMPLETE:
            yield Step(PRINTING)
        for state, call in ENDS[self._unseen_end or CANCELLED]:
            yield Step(state, call)

    def _begin_steps(self, job: Job, now: float) -> Iterator[Step]:
        # the status is there a reply before the file, or that of the job before is still there
        last, at = self._over
        may_be_old = self._starts_at is None and job.file == last and now - at < FILE_SECONDS
        if not job.file or may_be_old:
            return
        if self._starts_at is None:
            yield Step("", "select", job.file)
            yield Step(STARTING)
            yield Step("", "started")
        self._starts_at = None
        self.state = STARTING
        yield Step(PRINTING)
        self.state = PRINTING
        yield from self._going_on(job, now)

    def _going_on(self, job: Job, now: float) -> Iterator[Step]:
        state = STATES[job.status]
        if self._ends_at is not None and self._has_refused(job, now):
            self._ends_at = None
        if self._ends_at is not None:
            self._starts_at = None
            if state == PAUSED:
                yield Step("", "end_again")
            return
        if state == self.state:
            return
        if state == PAUSED:
            yield Step(PAUSED)
            yield Step("", "paused")
        elif state == PRINTING and self.state in (PAUSED, RESUMING):
            yield Step(PRINTING)
            yield Step("", "resumed")
        else:
            yield Step(state)

    def _has_refused(self, job: Job, now: float) -> bool:
        """Return whether the board goes on as if it hadn't been told to end its job."""
        is_late = self._ends_at is not None and now - self._ends_at > END_SECONDS
        return is_late and job.status == "processing"
