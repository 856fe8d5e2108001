"""View: the print that the board runs from its card."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

PRINTING = ("processing", "pausing", "paused", "resuming", "cancelling")
"""Values of ``state.status`` while a job is there (3.5 RepRap.cpp:2391); not of a simulation."""


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


def _object(value: Any) -> Mapping[str, Any]:
    return value if isinstance(value, Mapping) else {}


def _count(value: Any) -> int:
    return value if type(value) is int else 0
