"""The print under way, followed from one reply to the next: the card's, else the host's.

RepRapFirmware's model does not say why a job has ended. ``_verdict`` decides; what the printer
says in words (``ENDINGS``) comes first, and also corrects what was decided before it was heard.
"""

from __future__ import annotations

import re

from ..views.event_facts import LONGEST_ENDING
from ..wire.sentences import sentences
from .printer import Printer
from .values import number, text, whole
from .world import CANCELLING, CARD, ENDED, HOST, PAUSED, PRINTING, HostJob, Job

PHASES = {
    "processing": PRINTING,
    "simulating": PRINTING,
    "resuming": PRINTING,
    "pausing": PAUSED,
    "paused": PAUSED,
    "cancelling": CANCELLING,
}
"""Values of ``state.status`` while there is a job, and its phase (3.5 RepRap.cpp:2391)."""

COVERS_A_JOB = frozenset(("busy", "changingTool", "off"))
"""Values that say nothing of a job: it may go on behind them."""

AFTER_A_CANCEL = frozenset(("busy", "changingTool", "idle"))
"""Values that follow ``paused`` when the job was cancelled; 3.4 shows no ``cancelling`` then."""

HOST_PHASES = {"printing": PRINTING, "paused": PAUSED}
"""States of a host's print that is not over."""

STATES = {PRINTING: "printing", CANCELLING: "printing", PAUSED: "paused"}
"""``print_stats.state`` of each phase."""

ENDED_STATES = {"complete": "complete", "cancelled": "standby", "error": "error"}
"""``print_stats.state`` of each way that a job ends."""

ENDINGS = (
    ("complete", re.compile(r"Finished printing file (?P<path>.{1,260}?), print time was")),
    ("cancelled", re.compile(r"Cancelled printing file (?P<path>.{1,260}?), print time was")),
    ("complete", re.compile(r"File (?P<path>.{1,260}?) will print in \d")),
)
"""How a job ended, and the text that says so; the last is of a simulation. A path of
the firmware's has at most 120 bytes (3.5 Configuration.h, MaxFilenameLength)."""

ENDING_WORD = "print"
"""What all of them have in them; most lines don't."""

FINISHED = 0.99
"""Progress from which on a job that ended without a word has ended by itself."""

ROUNDING = 1.5
"""Seconds that a duration may seem to go back within one job."""


def followed(
    job: Job,
    printer: Printer,
    host_job: HostJob | None,
    before: tuple[float | None, ...],
    seconds: float,
) -> Job:
    """Return what has become of ``job``, or the one that has taken its place.

    ``before`` is where the extruders were at the last reply, ``seconds`` how long ago that was.
    """
    job = _card(job, printer)
    if job.runs and job.source == CARD:
        return job
    return _host(job, host_job, printer.extruded, before, seconds)


def lost(job: Job) -> Job:
    """Return a job after the board was reset or the line lost; a host's own goes on."""
    if job.source == HOST:
        return job._replace(highest=())
    return _ended(job, "error") if job.runs else Job()


def told(job: Job, line: str) -> Job:
    """Return a job after the printer has said a line."""
    line = sentences(line.strip())
    if job.runs and line.startswith("Error:"):
        job = job._replace(error=line)
    if ENDING_WORD in line and len(line) <= LONGEST_ENDING:
        for ending, pattern in ENDINGS:
            if found := pattern.search(line):
                return _told(job, ending, found.group("path"))
    return job


def _told(job: Job, ending: str, path: str) -> Job:
    is_same = not job.path or _base(job.path) == _base(path)
    if job.runs:
        return job._replace(told=ending) if job.source == CARD and is_same else job
    if job.source != CARD or not is_same:
        # one that began and ended between two replies
        job = Job(CARD, path=path)
    return _ended(job, ending)


def _base(path: str) -> str:
    """Return a file's own name; FAT makes no difference of case."""
    return path.rpartition("/")[2].lower()


def _card(job: Job, printer: Printer) -> Job:
    runs = job.runs and job.source == CARD
    phase = PHASES.get(printer.status)
    if runs and phase is None and _goes_on(job, printer):
        phase = job.phase
    if phase is not None:
        if not runs or _is_another(job, printer):
            job = Job(CARD)
        return _updated(job, printer, phase)
    if runs and printer.status:
        return _ended(job, _verdict(job, printer.status))
    return job


def _goes_on(job: Job, printer: Printer) -> bool:
    """Return whether a job may still be there behind a status that isn't one of a job."""
    if printer.status not in COVERS_A_JOB:
        return False
    # paused, then busy: the macro that cancels
    if job.phase != PRINTING and printer.status != "off":
        return False
    is_gone = printer.card.get("duration", 0) is None or printer.file.get("fileName", "") is None
    return not is_gone


def _is_another(job: Job, printer: Printer) -> bool:
    path = text(printer.file.get("fileName"))
    if path and job.path and path != job.path:
        return True
    duration = number(printer.card.get("duration"))
    return duration is not None and duration < job.duration - ROUNDING


def _updated(job: Job, printer: Printer, phase: str) -> Job:
    card, file = printer.card, printer.file

    def known(name: str, kept: float) -> float:
        value = number(card.get(name))
        return kept if value is None else value

    position = whole(card.get("filePosition"))
    return job._replace(
        phase=phase,
        state=STATES[phase],
        path=text(file.get("fileName")) or job.path,
        size=whole(file.get("size")) or job.size,
        position=job.position if position is None else position,
        printed=_printed(printer, job.printed),
        duration=known("duration", job.duration),
        pauses=known("pauseDuration", job.pauses),
        filament=known("rawExtrusion", job.filament),
    )


def _printed(printer: Printer, kept: float | None) -> float | None:
    """Return the fraction that ``M408`` tells, in S4 in percent."""
    told = printer.model.get("m408")
    fields = told if isinstance(told, dict) else {}
    percent = number(fields.get("fractionPrinted"))
    printed = number(fields.get("fraction_printed")) if percent is None else percent / 100
    return kept if printed is None or printed < 0 else min(1.0, float(printed))


def _verdict(job: Job, status: str) -> str:
    """Return how a job has ended, by what was seen of it last and the status after it."""
    if job.told:
        return job.told
    if job.phase == CANCELLING or (job.phase == PAUSED and status in AFTER_A_CANCEL):
        return "cancelled"
    if status in ("halted", "starting", "updating"):
        return "error"
    return "complete" if job.progress >= FINISHED else "error"


def _ended(job: Job, ending: str, message: str = "") -> Job:
    return job._replace(
        phase=ENDED,
        state=ENDED_STATES[ending],
        message=(message or job.error) if ending == "error" else "",
    )


def _host(
    job: Job,
    own: HostJob | None,
    extruded: tuple[float | None, ...],
    before: tuple[float | None, ...],
    seconds: float,
) -> Job:
    runs = job.runs and job.source == HOST
    if own is None:
        return _ended(job, "complete" if job.progress >= FINISHED else "error") if runs else job
    if own.state in HOST_PHASES:
        job = _streamed(job, own, extruded, before, seconds)
    elif job.source == CARD:
        # the last print was the card's; what the host still tells is of one before it
        return job
    else:
        job = _over(job, own, extruded)
    return job._replace(
        size=own.size or 0,
        duration=job.duration if own.print_time is None else max(0.0, own.print_time),
    )


def _streamed(
    job: Job,
    own: HostJob,
    extruded: tuple[float | None, ...],
    before: tuple[float | None, ...],
    seconds: float,
) -> Job:
    is_same = job.runs and job.source == HOST and job.path == own.name
    went_back = own.print_time is not None and own.print_time < job.duration - ROUNDING
    if not is_same or went_back:
        job = Job(HOST, path=own.name, highest=before or extruded)
    elif job.phase == PAUSED:
        job = job._replace(pauses=job.pauses + max(0.0, seconds))
    phase = HOST_PHASES[own.state]
    job = job._replace(phase=phase, state=STATES[phase], position=own.position)
    return _counted(job, extruded)


def _over(job: Job, own: HostJob, extruded: tuple[float | None, ...]) -> Job:
    if job.source != HOST or job.path != own.name:
        job = Job(HOST, path=own.name)
    if job.runs:
        job = _counted(job, extruded)
    # a host that has ended a print may have wound its file back
    position = own.size if own.state == "complete" and own.size else own.position
    job = job._replace(position=max(job.position, position))
    return _ended(job, own.state if own.state in ENDED_STATES else "error", own.message)


def _counted(job: Job, extruded: tuple[float | None, ...]) -> Job:
    """Count what went beyond the furthest positions: what is retracted and fed again, once."""
    fed = 0.0
    highest = list(job.highest) + [None] * (len(extruded) - len(job.highest))
    for drive, position in enumerate(extruded):
        furthest = highest[drive]
        if position is not None and (furthest is None or position > furthest):
            fed += 0.0 if furthest is None else position - furthest
            highest[drive] = position
    return job._replace(filament=job.filament + fed, highest=tuple(highest))
