"""What happened between two models, as events for those who listen.

``EVENTS`` is the table. A host shows its events to everybody, so that payloads hold numbers
and the firmware's own words; a word that isn't one of those is ``unknown``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Callable, NamedTuple

from .event_facts import Facts, Job, facts_of

Payload = dict[str, Any]

COMPLETE, CANCELLED, ERROR = "complete", "cancelled", "error"
"""How a job may have ended."""

COMPLETE_FROM = 0.99
"""Part of the file that has to have been read for a job to count as complete, where the firmware
doesn't say how it ended."""

MODEL_READY = "model_ready"
"""The event that needs no two models: whoever fetches them knows when the whole one is there."""


BOX_UNANSWERABLE = "message_box_unanswerable"
"""Another one: while such a box holds the line no model comes."""


class MachineEvent(NamedTuple):
    """One event."""

    name: str
    payload: Payload


class Row(NamedTuple):
    """One line of the table."""

    name: str
    find: Callable[[Facts, Facts], Iterator[Payload]]
    """What each time that it happened brings along."""


class Chronicle:
    """Tells what happens while one board is followed; a new connection needs a new one."""

    def __init__(self) -> None:
        self._facts = Facts()

    def look(self, model: Mapping[str, Any]) -> list[MachineEvent]:
        """Return what has happened since the model before."""
        before, self._facts = self._facts, facts_of(model, self._facts)
        return events_between(before, self._facts)

    def heard(self, line: str) -> None:
        """Take a line from the printer, which may say how a job has ended."""
        self._facts = self._facts.heard(line)


def events_between(before: Facts, after: Facts) -> list[MachineEvent]:
    """Return what happened in between, in the order of the table.

    What isn't known before is no news, but for a heater's fault and an open box: somebody has to
    see to those, also where they are older than the connection.
    """
    return [
        MachineEvent(row.name, payload) for row in EVENTS for payload in row.find(before, after)
    ]


def _reset(before: Facts, after: Facts) -> Iterator[Payload]:
    if after.was_reset:
        yield {}


def _changed(name: str) -> Callable[[Facts, Facts], Iterator[Payload]]:
    def find(before: Facts, after: Facts) -> Iterator[Payload]:
        old, new = getattr(before, name), getattr(after, name)
        if old is not None and old != new:
            yield {"old": old, "new": new}

    return find


def _job_finished(before: Facts, after: Facts) -> Iterator[Payload]:
    if before.job is not None and not _goes_on(before.job, after.job):
        end = end_of(before.job, after)
        yield {
            "duration": before.job.duration,
            "cancelled": end != COMPLETE,
            "error": end == ERROR,
        }


def _job_started(before: Facts, after: Facts) -> Iterator[Payload]:
    if before.status is not None and after.job and not _goes_on(after.job, before.job):
        yield {}


def _goes_on(job: Job, other: Job | None) -> bool:
    return other is not None and job.number == other.number


def end_of(job: Job, after: Facts) -> str:
    """Return how a job has ended: by what the firmware said, else by what can be seen of it."""
    if job.heard:
        return COMPLETE if job.heard == "Finished" else CANCELLED
    if job.was_cancelling:
        return CANCELLED
    if after.was_reset or after.status == "halted":
        return ERROR
    if job.status in ("pausing", "paused"):
        return CANCELLED
    return COMPLETE if job.progress is not None and job.progress >= COMPLETE_FROM else ERROR


def _layer(before: Facts, after: Facts) -> Iterator[Payload]:
    if before.layer is not None and after.layer and after.layer != before.layer:
        yield {"layer": after.layer, "total": after.layers}


def _faults(before: Facts, after: Facts) -> Iterator[Payload]:
    known = frozenset() if after.was_reset else before.faults
    for heater in sorted(after.faults - known):
        yield {"heater": heater}


def _filament(before: Facts, after: Facts) -> Iterator[Payload]:
    for extruder, status in after.monitors.items():
        # an error that is there from the beginning may only mean that nothing is loaded
        if status and before.monitors.get(extruder, status) != status and not after.was_reset:
            yield {"extruder": extruder, "status": status}


def _closed(before: Facts, after: Facts) -> Iterator[Payload]:
    if before.box is not None and not _stays_open(before, after):
        yield before.box._asdict()


def _opened(before: Facts, after: Facts) -> Iterator[Payload]:
    if after.box is not None and not _stays_open(before, after):
        yield after.box._asdict()


def _stays_open(before: Facts, after: Facts) -> bool:
    if before.box is None or after.box is None or after.was_reset:
        return False
    return before.box.seq == after.box.seq


EVENTS = (
    Row("firmware_reset", _reset),
    Row("status_changed", _changed("status")),
    Row("job_finished", _job_finished),
    Row("job_started", _job_started),
    Row("layer_changed", _layer),
    Row("tool_changed", _changed("tool")),
    Row("heater_fault", _faults),
    Row("filament_error", _filament),
    Row("message_box_closed", _closed),
    Row("message_box_opened", _opened),
)

NAMES = (MODEL_READY, BOX_UNANSWERABLE, *(row.name for row in EVENTS))
"""The names of all events."""
