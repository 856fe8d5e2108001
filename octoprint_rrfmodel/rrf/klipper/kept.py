"""What the objects need and no single reply tells, kept from one reply to the next."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from typing import Any

from . import jobs
from .printer import Printer
from .values import reading
from .world import Accumulated, Host

ACTIVITIES = {
    **dict.fromkeys(
        (
            "processing",
            "simulating",
            "changingTool",
            "busy",
            "pausing",
            "resuming",
            "cancelling",
        ),
        "printing",
    ),
    "paused": "paused",
    "idle": "idle",
}
"""``state.status`` and what the machine does, as ``idle_timeout`` divides it."""


class Kept:
    """Accumulates; ``snapshot`` may be read by any thread, and is never changed.

    ``observe`` belongs after each reply, ``heard`` to each line that is none, ``forget`` to the
    end of a connection and to a reset of the board. They may come from different threads.
    """

    def __init__(self) -> None:
        self.snapshot = Accumulated()
        self._lock = threading.Lock()

    def observe(self, model: Mapping[str, Any], host: Host, now: float) -> None:
        """Take a model and the host's print as they are ``now``, seconds as ``eventtime`` has."""
        with self._lock:
            self.snapshot = accumulated(self.snapshot, Printer(model), host, now)

    def heard(self, line: str) -> None:
        """Take a line of text from the printer: how a job ended, or an error during one."""
        job = self.snapshot.job
        if jobs.told(job, line) == job:
            return
        with self._lock:
            kept = self.snapshot
            self.snapshot = kept._replace(job=jobs.told(kept.job, line))

    def forget(self) -> None:
        """Begin anew. A job that the board ran from its card has ended with an error."""
        with self._lock:
            self.snapshot = Accumulated(job=jobs.lost(self.snapshot.job))


def accumulated(kept: Accumulated, printer: Printer, host: Host, now: float) -> Accumulated:
    """Return what is kept after another reply; the same again changes nothing but the time."""
    activity = ACTIVITIES.get(printer.status, "")
    return Accumulated(
        at=now,
        activity=activity,
        since=kept.since if activity == kept.activity else now,
        extremes=_extremes(kept.extremes, printer),
        positions=printer.extruded or kept.positions,
        job=jobs.followed(
            kept.job,
            printer,
            host.job,
            kept.positions,
            0.0 if kept.at is None else now - kept.at,
        ),
    )


def _extremes(
    known: Mapping[str, tuple[float, float]], printer: Printer
) -> Mapping[str, tuple[float, float]]:
    new = {}
    for name, sensor in printer.analog.items():
        value = sensor_reading(sensor)
        if value is None:
            continue
        lowest, highest = known.get(name, (value, value))
        if name not in known or not lowest <= value <= highest:
            new[name] = (min(lowest, value), max(highest, value))
    return {**known, **new} if new else known


def sensor_reading(sensor: Mapping[str, Any]) -> float | None:
    """Return what an analog sensor reads, in °C; ``None`` where it can't be read.

    From 3.5 on a sensor says in a word whether it works.
    """
    is_well = sensor.get("state", "ok") in ("ok", None)
    return reading(sensor.get("lastReading")) if is_well else None
