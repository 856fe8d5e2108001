"""Past prints as Moonraker's clients are told of them (Moonraker 0.9, external_api/history)."""

from __future__ import annotations

import zlib
from collections.abc import Iterable
from typing import Any

from ..views.past_job import ABORTED, CANCELLED, CARD, FINISHED, SIMULATED, PastJob

STATUSES = {
    FINISHED: "completed",
    SIMULATED: "completed",
    CANCELLED: "cancelled",
    ABORTED: "error",
    None: "interrupted",
}
"""How a print has ended, and Moonraker's word for it; nobody saw the end of the last one."""

UNDER_WAY = "in_progress"

CARD_ROOT = "printer"
"""The root that a file of the card is told with: names without one are OctoPrint's own."""


def job_id(job: PastJob) -> str:
    """Return what tells a print from others, the same after a restart."""
    return f"{zlib.crc32(repr((job.source, job.path, job.began)).encode()):08X}"


def filename(job: PastJob) -> str:
    """Return the name by which clients ask for the file, and print it again."""
    return f"{CARD_ROOT}/{job.name}" if job.source == CARD else job.name


def told(job: PastJob, is_over: bool, metadata: dict[str, Any], exists: bool) -> dict[str, Any]:
    """Return a print; ``exists`` says whether its file is there and still the same.

    What nobody counts is 0, for clients calculate with it.
    """
    whole = None if job.ended is None else max(0.0, job.ended - job.began)
    printed = job.duration or 0.0
    return {
        "job_id": job_id(job),
        "user": None,
        "filename": filename(job),
        "exists": exists,
        "status": STATUSES[job.outcome] if is_over else UNDER_WAY,
        "start_time": job.began,
        "end_time": job.ended,
        "print_duration": printed,
        "total_duration": printed if whole is None or job.outcome == SIMULATED else whole,
        "filament_used": 0.0,
        "metadata": metadata,
        "auxiliary_data": [],
    }


def totals(jobs: Iterable[dict[str, Any]]) -> dict[str, Any]:
    """Return the sums over prints as ``told``."""
    jobs = list(jobs)
    whole = [job["total_duration"] for job in jobs]
    printed = [job["print_duration"] for job in jobs]
    return {
        "total_jobs": len(jobs),
        "total_time": sum(whole),
        "total_print_time": sum(printed),
        "total_filament_used": 0.0,
        "longest_job": max(whole, default=0.0),
        "longest_print": max(printed, default=0.0),
    }
