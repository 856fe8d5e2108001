"""How old a part of the model may become, by who needs it: the guard, somebody who looks, nobody.

The times are those aimed at; where a line hasn't the time for all of them, what is most overdue by
its own measure comes first, and the guard before all others.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

GUARD_SECONDS = 1.6
"""What the guard needs is asked for at this age, so that none of it gets older than two seconds."""


class Freshness(NamedTuple):
    """One line of a table: the ages at which a part is asked for again."""

    path: str
    """The part, and all below it; the longest that fits counts."""
    looked_at: float
    unseen: float


LIVE = (
    Freshness("", 10, 60),
    Freshness("seqs", 8, 8),
    Freshness("heat.heaters[].current", 2, 6),
    Freshness("heat.heaters[].active", 4, 15),
    Freshness("heat.heaters[].standby", 10, 60),
    Freshness("heat.heaters[].avgPwm", 5, 20),
    Freshness("boards[].drivers[].status", 8, 8),
    Freshness("boards[].vIn", 15, 20),
    Freshness("boards", 15, 60),
    Freshness("sensors.filamentMonitors[].status", 6, 6),
    Freshness("sensors.filamentMonitors", 8, 30),
    Freshness("sensors", 15, 60),
    Freshness("tools", 8, 20),
    Freshness("move.axes", 2, 30),
    Freshness("move.currentMove", 5, 60),
    Freshness("move", 12, 30),
    Freshness("job", 4, 20),
    Freshness("fans", 6, 30),
    Freshness("inputs[].state", 8, 30),
    Freshness("inputs", 20, 120),
    Freshness("spindles", 10, 120),
)
"""Of what changes all the time. The drivers and filament monitors stop a print, too; the firmware
says so in words at once."""

BOX = "state.messageBox"

GUARDED = ("state.status", "state.upTime", BOX, "heat.heaters[].state")
"""What the guard must know: the machine's state, resets, questions, heaters' faults."""

FREE_GUARD_SECONDS = 2.5
"""The same where no print is streamed that it would have to pause."""

OPEN_BOX_SECONDS = 5.0
"""The age at which a box that is open is looked at again: it is long, and waits for a person."""

CHANGED = (
    Freshness("", 30, 30),
    Freshness("state", 5, 5),
    Freshness("move.axes[].homed", 2, 2),
    Freshness("move.axes[].babystep", 3, 10),
    Freshness("move.speedFactor", 3, 5),
    Freshness("move.extruders[].factor", 3, 10),
    Freshness("tools", 10, 20),
)
"""Of what has a counter, from the change on."""

DECIDING_SECONDS = 5
"""What is aimed at to be known sooner than this after a change decides about commands."""


def is_guarded(path: str) -> bool:
    """Return whether the guard needs a live part, or something in it.

    >>> is_guarded("state"), is_guarded("state.upTime"), is_guarded("state.time")
    (True, True, False)
    """
    return any(is_below(path, guarded) or is_below(guarded, path) for guarded in GUARDED)


def is_below(path: str, above: str) -> bool:
    """Return whether a path is another, or a part of it."""
    return not above or path == above or path.startswith((f"{above}.", f"{above}["))


@lru_cache(maxsize=1024)
def above(path: str) -> tuple[str, ...]:
    """Return what a path is a part of, and the path itself.

    >>> above("heat.heaters[].state")
    ('', 'heat', 'heat.heaters', 'heat.heaters[]', 'heat.heaters[].state')
    """
    ends = [at for at, letter in enumerate(path) if letter in ".["]
    return tuple(dict.fromkeys(("", *(path[:at] for at in ends), path)))


def freshness_of(path: str, table: tuple[Freshness, ...]) -> Freshness:
    """Return the line of a table that counts for a part."""
    rows = [row for row in table if is_below(path, row.path)]
    return max(rows, key=lambda row: len(row.path))
