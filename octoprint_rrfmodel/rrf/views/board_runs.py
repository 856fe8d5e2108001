"""The prints and simulations that the board runs from its card, from their beginning to their end.

How a print has ended is told as the events tell it; of one that ended while nobody heard the board
nothing is guessed. A run is the same over a lost connection, and over a restart of the host, where
file and beginning fit.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from .event_facts import Facts, ending, facts_of
from .events import CANCELLED, COMPLETE, end_of
from .job import PRINTING, WITHOUT_JOB
from .machine import mapping
from .past_job import ABORTED, CARD, FINISHED, SIMULATED, PastJob
from .past_job import CANCELLED as WAS_CANCELLED

SIMULATING = "simulating"

SIMULATION_ENDED = re.compile(r"^File .* will print in ")
"""What is said at the end of a simulation (3.5 GCodes.cpp, StopPrint)."""

OUTCOMES = {COMPLETE: FINISHED, CANCELLED: WAS_CANCELLED}

SAME_SECONDS = 300.0
"""By how much two runs of a file have to have begun apart to be two: clocks are set meanwhile."""


class Run(NamedTuple):
    """What is under way."""

    began: float
    """Unix time."""
    path: str = ""
    """On the card; told later than that there is a run."""
    duration: float | None = None
    is_simulation: bool = False
    number: int = 0
    """Of a print, as the facts count them."""
    heard: str = ""
    """How a simulation has ended, where the firmware has said so."""

    @property
    def entry(self) -> PastJob:
        """The run as an entry whose end isn't known."""
        return PastJob(CARD, self.path, self.began, duration=self.duration)


class BoardRuns:
    """Follows one board; ``now`` is the time of day in seconds. Outlives connections."""

    def __init__(self) -> None:
        self.run: Run | None = None
        self._facts = Facts()
        self._resumed: PastJob | None = None
        self._settling: PastJob | None = None
        self._was_away = False

    def resume(self, run: PastJob | None) -> None:
        """Take the run that was under way when the host ended."""
        self._resumed = run

    @property
    def open(self) -> PastJob | None:
        """The run under way as an entry, ``None`` where there is none."""
        if self._resumed is not None:
            return self._resumed
        return self.run.entry if self.run is not None else None

    def away(self) -> None:
        """Note that the board isn't heard any more."""
        self._was_away = True

    def heard(self, line: str) -> None:
        """Take a line from the printer, which may say that something has ended."""
        self._facts = self._facts.heard(line)
        if self.run is None or not self.run.is_simulation:
            return
        found = ending(line)
        if found:
            self.run = self.run._replace(heard=found["how"])
        elif SIMULATION_ENDED.match(line):
            self.run = self.run._replace(heard=SIMULATED)

    def look(self, model: Mapping[str, Any], now: float) -> list[PastJob]:
        """Take what a model tells; return what has ended, and what is known better by now.

        An entry of the same beginning and file takes the place of what was told before.
        """
        before, self._facts = self._facts, facts_of(model, self._facts)
        status = mapping(model.get("state")).get("status")
        if status not in PRINTING and status not in WITHOUT_JOB:
            return []
        found = []
        simulates = status == SIMULATING or (
            self.run is not None and self.run.is_simulation and status in PRINTING
        )
        job = self._facts.job
        number = 0 if simulates or job is None else job.number
        goes_on = self.run is not None and (simulates or number) and self.run.number == number
        if self.run is not None and not goes_on:
            found.append(self._end(self.run, before, model, now))
        if simulates or number:
            self._follow(model, now, simulates, number, bool(goes_on))
        found += self._resume(model, now)
        found += self._settle(model)
        self._was_away = False
        return found

    def _follow(
        self, model: Mapping[str, Any], now: float, simulates: bool, number: int, goes_on: bool
    ) -> None:
        job = mapping(model.get("job"))
        duration = _real(job.get("duration"))
        if not goes_on:
            self._settling = None
            self.run = Run(now, is_simulation=simulates, number=number)
        assert self.run is not None
        told = mapping(job.get("file")).get("fileName")
        if not simulates and self._facts.job is not None:
            told, duration = self._facts.job.file, self._facts.job.duration
        path = told if isinstance(told, str) and told else self.run.path
        began = self.run.began
        if duration and self.run.duration is None and not simulates:
            # it may have begun before anybody looked
            began = min(began, now - duration - _known(job, "pauseDuration"))
        duration = self.run.duration if duration is None else duration
        self.run = self.run._replace(path=path, began=began, duration=duration)

    def _end(self, run: Run, before: Facts, model: Mapping[str, Any], now: float) -> PastJob:
        self.run = None
        ended = run.entry._replace(ended=now, outcome=self._outcome(run, before))
        if ended.outcome in (FINISHED, SIMULATED):
            self._settling = ended
        return ended

    def _outcome(self, run: Run, before: Facts) -> str | None:
        heard = run.heard or (before.job.heard if before.job is not None else "")
        if heard in ("Finished", "Cancelled"):
            return FINISHED if heard == "Finished" else WAS_CANCELLED
        if self._facts.was_reset:
            return ABORTED
        if heard != SIMULATED and self._was_away:
            return None
        if run.is_simulation:
            is_left = before.status in ("pausing", "paused", "cancelling")
            return WAS_CANCELLED if is_left and heard != SIMULATED else SIMULATED
        assert before.job is not None
        return OUTCOMES.get(end_of(before.job, self._facts), ABORTED)

    def _resume(self, model: Mapping[str, Any], now: float) -> list[PastJob]:
        """Find out what has become of the run of before the host's restart."""
        resumed = self._resumed
        # M408 tells of no job where there is none
        if resumed is None or not ("job" in model or "m408" in model):
            return []
        run = self.run
        if run is not None and not run.path:
            return []
        self._resumed = None
        is_it = run is not None and run.path == resumed.path
        if run is not None and is_it and abs(run.began - resumed.began) <= SAME_SECONDS:
            self.run = run._replace(began=resumed.began)
            return []
        job = mapping(model.get("job"))
        is_it = run is None and job.get("lastFileName") == resumed.path
        duration = _known(job, "lastDuration") if is_it else 0.0
        return [resumed._replace(ended=None, outcome=None, duration=duration or resumed.duration)]

    def _settle(self, model: Mapping[str, Any]) -> list[PastJob]:
        """Take how long it lasted as the board tells it, a little later than the end."""
        ended = self._settling
        if ended is None:
            return []
        job = mapping(model.get("job"))
        duration = _known(job, "lastDuration")
        is_it = job.get("lastFileName") == ended.path and duration >= (ended.duration or 0.0)
        if not is_it or duration == ended.duration:
            return []
        # goes on to look: that may have been how long the same file took before
        self._settling, told = ended, ended._replace(duration=duration)
        return [told]


def _known(job: Mapping[str, Any], name: str) -> float:
    return _real(job.get(name)) or 0.0


def _real(value: Any) -> float | None:
    return float(value) if type(value) in (int, float) and 0 <= value < 1e9 else None
