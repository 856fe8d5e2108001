"""Prints that are over: the last hundred, whoever has run them."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable
from typing import Any, NamedTuple

from .printing import GCODES

MOST = 100

CARD, OCTOPRINT = "card", "octoprint"
"""Who ran it: the board from its card, or OctoPrint, which sent it."""

FINISHED, CANCELLED, ABORTED, SIMULATED = "finished", "cancelled", "aborted", "simulated"

MOST_LETTERS = 500
"""Longest path that is kept."""


class PastJob(NamedTuple):
    """A print or simulation; ``None`` stands for what nobody has seen."""

    source: str
    path: str
    """On the card with its volume, or in OctoPrint's own folder."""
    began: float
    """Unix time, as is ``ended``."""
    ended: float | None = None
    outcome: str | None = None
    duration: float | None = None
    """Seconds without pauses; of a simulation those that the print would take."""

    @property
    def name(self) -> str:
        """The path as people know it: on the card below the folder of prints."""
        is_below = self.source == CARD and self.path.startswith(GCODES)
        return self.path[len(GCODES) :] if is_below else self.path

    def is_the_same(self, other: PastJob) -> bool:
        """Return whether both tell of one run."""
        return self[:3] == other[:3]


class PastJobs:
    """Keeps them in the order in which they ended."""

    def __init__(self) -> None:
        self._kept: deque[PastJob] = deque(maxlen=MOST)

    def add(self, job: PastJob) -> None:
        """Take one that is over, or what is known better of one that was taken."""
        for place, kept in enumerate(self._kept):
            if kept.is_the_same(job):
                self._kept[place] = job
                return
        self._kept.append(job)

    def remove(self, jobs: Iterable[PastJob]) -> None:
        """Keep some no longer."""
        for job in jobs:
            self._kept.remove(job)

    def latest(self) -> list[PastJob]:
        """Return them, the last one first."""
        return list(reversed(self._kept))

    def all(self) -> list[PastJob]:
        """Return them, the oldest first."""
        return list(self._kept)


def written(job: PastJob) -> dict[str, Any]:
    """Return a job as plain values."""
    return job._asdict()


def read(told: Any) -> PastJob | None:
    """Return the job that was written, ``None`` where it is none."""
    if not isinstance(told, dict):
        return None
    source, path, began = told.get("source"), told.get("path"), _time(told.get("began"))
    is_job = source in (CARD, OCTOPRINT) and isinstance(path, str) and began is not None
    if not is_job:
        return None
    outcome = told.get("outcome")
    is_known = outcome in (FINISHED, CANCELLED, ABORTED, SIMULATED)
    return PastJob(
        str(source),
        str(path)[:MOST_LETTERS],
        began or 0.0,
        _time(told.get("ended")),
        outcome if is_known else None,
        _time(told.get("duration")),
    )


def read_all(told: Any) -> Iterable[PastJob]:
    """Yield the jobs of a list that was written; what makes no sense is left out."""
    for each in told if isinstance(told, list) else ():
        job = read(each)
        if job is not None:
            yield job


def _time(value: Any) -> float | None:
    is_number = type(value) in (int, float) and math.isfinite(value) and value >= 0
    return float(value) if is_number else None
