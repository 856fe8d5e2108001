"""View: the print that the board runs from its card."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

PRINTING = ("processing", "pausing", "paused", "resuming", "cancelling")
"""Values of ``state.status`` while a job is there (3.5 RepRap.cpp:2391); not of a simulation."""


WITHOUT_JOB = ("starting", "halted", "simulating", "changingTool", "busy", "idle")
"""Values of ``state.status`` that say that none is there: each that a job has comes before
``changingTool`` (3.5 RepRap.cpp:2391). Not among them: ``off``, which a job may outlast."""


class CardJob(NamedTuple):
    """The file being printed, paused or about to end; all empty where there is none."""

    status: str = ""
    path: str = ""
    size: int = 0
    position: int = 0
    """Bytes that were read."""

    @property
    def is_active(self) -> bool:
        """Whether there is a job."""
        return bool(self.status)

    @property
    def is_paused(self) -> bool:
        """Whether it stands still and can be resumed or cancelled."""
        return self.status == "paused"


def card_job(model: Mapping[str, Any]) -> CardJob:
    """Return the job that the model tells of.

    A file that is only selected counts for nothing: ``job.file`` has it, the status doesn't.
    """
    status = _object(model.get("state")).get("status")
    if status not in PRINTING:
        return CardJob()
    job = _object(model.get("job"))
    file = _object(job.get("file"))
    path = file.get("fileName")
    return CardJob(
        status,
        path if isinstance(path, str) else "",
        _count(file.get("size")),
        _count(job.get("filePosition")),
    )


def board_job(model: Mapping[str, Any]) -> CardJob:
    """Return what the board runs by itself, be it a print or only a simulation of one."""
    status = _object(model.get("state")).get("status")
    return CardJob("simulating") if status == "simulating" else card_job(model)


def progress(model: Mapping[str, Any]) -> float | None:
    """Return how much of the file was read, 0 to 1; ``None`` where no size is known.

    ``M408`` tells no size but the part itself: percent in S4, a fraction in S0 and S1 (3.5
    RepRap.cpp:1131-1856).
    """
    job = _object(model.get("job"))
    size: Any = _object(job.get("file")).get("size")
    position: Any = job.get("filePosition")
    if _is_number(size) and _is_number(position) and size > 0:
        return _part(position / size)
    legacy = _object(model.get("m408"))
    percent: Any = legacy.get("fractionPrinted")
    fraction: Any = legacy.get("fraction_printed")
    if _is_number(percent):
        return _part(percent / 100)
    return _part(fraction) if _is_number(fraction) else None


def _is_number(value: Any) -> bool:
    """Return whether it can be calculated with; an integer too long for that is none."""
    return type(value) in (int, float) and abs(value) < 1e18


def _part(value: float) -> float:
    return min(max(value, 0.0), 1.0)


def _object(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, Mapping) else {}


def _count(value: Any) -> int:
    return value if type(value) is int else 0
