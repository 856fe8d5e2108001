"""What is known of the things that events are about, from one model to the next.

What is told of it elsewhere are numbers and the firmware's own words; the one text that is kept,
a job's file, only tells one job from the next.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from .filament_monitors import FEEDING
from .job import PRINTING, WITHOUT_JOB, progress
from .machine import mapping
from .state_words import MONITORS, STATUSES, known

Model = Mapping[str, Any]

_ENDED = re.compile(
    r"(?P<how>Finished|Cancelled) printing file (?P<path>.{0,260}?)(?:, print time|$)"
)

LONGEST_ENDING = 2000
"""Characters from which on a line isn't looked at: the firmware's have not a quarter of that."""


def ending(line: str) -> re.Match[str] | None:
    """Return what USB is told at the end of a job (3.5 GCodes.cpp, StopPrint).

    Group ``how`` is ``Finished`` or ``Cancelled``, ``path`` the file's.
    """
    return _ENDED.search(line) if len(line) <= LONGEST_ENDING else None


def end_told(line: str, path: str | None) -> str:
    """Return how the job of that file has ended by a line, ``Finished`` or ``Cancelled``.

    Empty for any other line; one about the job before may come when the next has begun.
    """
    found = ending(line)
    if found is None or not _is_same(found["path"], path):
        return ""
    return found["how"]


def _is_same(told: str, path: str | None) -> bool:
    """Return whether two paths are of one file, one of which may begin anywhere."""
    names = [each.rpartition("/")[2].lower() for each in (told, path or "")]
    return names[0] == names[1] or not all(names)


BACK_SECONDS = 1.0
"""By how much a job's duration has to go back to be that of another one; it is told rounded."""


class Box(NamedTuple):
    """An open message box."""

    mode: int | None
    seq: int | None


class Job(NamedTuple):
    """The job that the board runs from its card, up to now."""

    number: int
    """Counted since the connection."""
    status: str
    """The last of the words that a job has."""
    duration: float | None = None
    """Seconds, without pauses."""
    progress: float | None = None
    file: str | None = None
    was_cancelling: bool = False
    heard: str = ""
    """``Finished`` or ``Cancelled`` where the firmware has said so."""


class Facts(NamedTuple):
    """What is known; ``None`` stands for what isn't.

    What a model doesn't tell stays as it was known last, also over the refetching after a reset.
    """

    up_time: float | None = None
    begins: bool = True
    """Whether nothing of this model is known yet."""
    was_reset: bool = False
    """Whether the up-time has gone back with this model."""
    status: str | None = None
    tool: int | None = None
    box: Box | None = None
    """The open box; ``None`` also where none is open."""
    faults: frozenset[int] = frozenset()
    """Heaters that have a fault."""
    monitors: Mapping[int, str] = {}
    """What each filament monitor that is on says against feeding; empty where it feeds."""
    layer: int | None = None
    """0 where none is printed."""
    layers: int | None = None
    job: Job | None = None
    jobs: int = 0
    """How many there were, with this one."""

    def heard(self, line: str) -> Facts:
        """Return the facts after a line from the printer that may tell how the job has ended."""
        if self.job is None:
            return self
        how = end_told(line, self.job.file)
        return self._replace(job=self.job._replace(heard=how)) if how else self


def facts_of(model: Model, last: Facts) -> Facts:
    """Return what is known after this model, ``last`` having been known before."""
    state = mapping(model.get("state"))
    up_time = _number(state.get("upTime"))
    if up_time is None:
        up_time = last.up_time
    # one that goes back in a model that goes on was spoilt before: a reset empties the model
    begins = last.begins or not model
    goes_back = up_time is not None and last.up_time is not None and up_time < last.up_time
    was_reset = begins and goes_back
    if was_reset:
        last = last._replace(box=None, faults=frozenset(), monitors={}, layer=None, job=None)
    status, tool = state.get("status"), state.get("currentTool")
    job = mapping(model.get("job"))
    now = _job(model, last)
    return Facts(
        up_time=up_time,
        begins=begins and "state" not in model,
        was_reset=was_reset,
        status=known(status, STATUSES) if isinstance(status, str) else last.status,
        tool=tool if type(tool) is int else last.tool,
        box=_box(state["messageBox"]) if "messageBox" in state else last.box,
        faults=_faults(model, last.faults),
        monitors=_monitors(model, last.monitors),
        layer=_count(job["layer"]) or 0 if "layer" in job else last.layer,
        layers=_count(mapping(job.get("file")).get("numLayers")),
        job=now,
        jobs=last.jobs if now is None else now.number,
    )


def _box(value: Any) -> Box | None:
    if not isinstance(value, Mapping):
        return None
    mode, seq = value.get("mode"), value.get("seq")
    return Box(mode if type(mode) is int else None, seq if type(seq) is int else None)


def _faults(model: Model, last: frozenset[int]) -> frozenset[int]:
    heaters = mapping(model.get("heat")).get("heaters")
    if not isinstance(heaters, list):
        return last
    states = {number: mapping(heater).get("state") for number, heater in enumerate(heaters)}
    return frozenset(
        number
        for number, state in states.items()
        if state == "fault" or (state is None and number in last)
    )


def _monitors(model: Model, last: Mapping[int, str]) -> Mapping[int, str]:
    monitors = mapping(model.get("sensors")).get("filamentMonitors")
    if not isinstance(monitors, list):
        return last
    found = {}
    for number, monitor in enumerate(map(mapping, monitors)):
        status = monitor.get("status")
        # 0 is off, 1 while printing, 2 always; before 3.5 a truth value
        if monitor.get("enableMode", monitor.get("enabled")) and isinstance(status, str):
            found[number] = "" if status in FEEDING else known(status, MONITORS)
    return found


def _job(model: Model, facts: Facts) -> Job | None:
    status = mapping(model.get("state")).get("status")
    last = facts.job
    if status in WITHOUT_JOB:
        return None
    if status not in PRINTING:
        return last  # without power, or not told
    job = mapping(model.get("job"))
    file = mapping(job.get("file")).get("fileName")
    now = Job(
        facts.jobs + 1,
        status,
        _number(job.get("duration")),
        progress(model),
        file if isinstance(file, str) else None,
        was_cancelling=status == "cancelling",
    )
    if last is None or _is_another(now, last):
        return now
    return Job(
        last.number,
        status,
        last.duration if now.duration is None else now.duration,
        last.progress if now.progress is None else now.progress,
        now.file or last.file,
        now.was_cancelling or last.was_cancelling,
        last.heard,
    )


def _is_another(now: Job, last: Job) -> bool:
    """Return whether one job has ended and the next begun between two models.

    The duration alone doesn't say so: a broken digit would. Nor does the file, which is told
    later than the status.
    """
    if now.duration is None or last.duration is None:
        return False
    is_other_file = bool(now.file and last.file and now.file != last.file)
    return now.duration < last.duration - BACK_SECONDS and (bool(last.heard) or is_other_file)


def _number(value: Any) -> float | None:
    """Return a number that can be compared and written as JSON."""
    if type(value) is int:
        return value
    return value if type(value) is float and math.isfinite(value) else None


def _count(value: Any) -> int | None:
    """Return a number from 1 on; zero and nonsense are none."""
    return value if type(value) is int and value > 0 else None
