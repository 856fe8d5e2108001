"""What the Klipper view is made of: the model, the host, and what was accumulated so far."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ..card.height_map import HeightMap

CARD = "card"
HOST = "host"

PRINTING, PAUSED, CANCELLING, ENDED = "printing", "paused", "cancelling", ""
"""Phases of a job."""


class HostJob(NamedTuple):
    """A print that the host streams."""

    name: str
    size: int | None
    """Bytes of the file."""
    position: int
    """Bytes that were sent."""
    print_time: float | None
    """Seconds without pauses."""
    state: str
    """``printing``, ``paused``, ``complete``, ``cancelled`` or ``error``."""
    message: str = ""
    """What went wrong, in the state ``error``."""


class Host(NamedTuple):
    """What the host knows of the printer and of its own print."""

    is_connected: bool
    """Whether there is a serial line."""
    is_ready: bool
    """Whether the model is complete."""
    has_protocol: bool
    """Whether ``M409`` or ``M408`` gives a model, or may yet."""
    job: HostJob | None
    is_at_work: bool = False
    """Whether the line waits for a command that the machine is busy with."""
    macros: Sequence[str] = ()
    """Names of the macro files, with or without the folder ``0:/macros/``."""
    heights: HeightMap | None = None
    """The mesh in use, where its file was read."""


class Job(NamedTuple):
    """The print under way, or the last one with the values that it ended with."""

    source: str = ""
    """``card``, ``host``; empty where there was none since the printer started."""
    phase: str = ENDED
    state: str = "standby"
    """As ``print_stats`` has it."""
    path: str = ""
    size: int = 0
    position: int = 0
    printed: float | None = None
    """Fraction, where the firmware tells that and no size (``M408``)."""
    duration: float = 0.0
    """Seconds without pauses."""
    pauses: float = 0.0
    """Seconds."""
    filament: float = 0.0
    """Millimetres, without the extrusion factor."""
    told: str = ""
    """``complete`` or ``cancelled`` once the printer has said how it ended."""
    error: str = ""
    """The last ``Error:`` reply since it began."""
    message: str = ""
    """What went wrong, once it has."""
    highest: tuple[float | None, ...] = ()
    """The furthest position of each extruder, which filament counts from."""

    @property
    def runs(self) -> bool:
        """Whether it has not ended."""
        return self.phase != ENDED

    @property
    def progress(self) -> float:
        """How much of the file was read, 0 to 1."""
        if self.size > 0:
            return min(1.0, max(0.0, self.position / self.size))
        return self.printed or 0.0


class Accumulated(NamedTuple):
    """What no single reply tells; never changed, replaced as a whole."""

    at: float | None = None
    """Time of the last reply, on the clock of ``World.eventtime``."""
    activity: str = ""
    """``printing``, ``paused``, ``idle``; empty for anything else."""
    since: float = 0.0
    """Time of the last change of ``activity``."""
    extremes: Mapping[str, tuple[float, float]] = {}
    """Lowest and highest reading of each analog sensor since the connection."""
    positions: tuple[float | None, ...] = ()
    """Of the extruders, in millimetres."""
    job: Job = Job()


class World(NamedTuple):
    """One moment, as the objects are computed from it."""

    model: Mapping[str, Any]
    host: Host
    kept: Accumulated
    eventtime: float
    """Seconds on any clock that doesn't go back; the same as ``Kept.observe`` is given."""
