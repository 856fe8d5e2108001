"""What was measured of the server, and whether it has stayed level."""

import collections
import statistics
from typing import NamedTuple

WARM_UP = 0.2
"""Part of the run after which everything has been loaded once."""

FEWEST = 6
"""Measurements after the warm-up, for a third to have two."""


class Limit(NamedTuple):
    """How much more the last third may have than the first."""

    share: float
    beside: float

    def top(self, first):
        """Return the most that is level."""
        return first * (1 + self.share) + self.beside


LIMITS = {
    # the allocator keeps what the largest moment needed
    "memory": Limit(0.03, 6.0),
    "objects": Limit(0.02, 2000),
    "threads": Limit(0.0, 2),
    "handles": Limit(0.0, 3),
    "queues": Limit(0.0, 3),
}
"""Name of a measurement → limit; the unit is MB for memory."""

LONGEST_QUEUE = 400
"""More entries than this in any queue at any moment: somebody doesn't keep up."""


class Level(NamedTuple):
    """A measurement's median in both thirds, and what of it is level."""

    name: str
    first: float
    last: float
    top: float
    count: int

    @property
    def is_level(self):
        """Whether it has stayed level; one that has too few measurements has not risen."""
        return self.last <= self.top


def grown_kinds(samples, count=8):
    """Return the kinds of objects of which there are more in the end than after the warm-up."""
    first, last = samples[int(len(samples) * WARM_UP)]["kinds"], samples[-1]["kinds"]
    more = {kind: last[kind] - first.get(kind, 0) for kind in last}
    return sorted(more.items(), key=lambda item: -item[1])[:count]


def new_threads(samples):
    """Return the names of the threads that there are in the end and weren't after the warm-up."""
    first = collections.Counter(samples[int(len(samples) * WARM_UP)]["thread_names"])
    return sorted((collections.Counter(samples[-1]["thread_names"]) - first).elements())


def levels(samples):
    """Return the levels of measurements at rest, dictionaries of names and numbers."""
    warm = samples[int(len(samples) * WARM_UP) :]
    if len(warm) < FEWEST:
        return []
    third = len(warm) // 3
    found = []
    for name, limit in LIMITS.items():
        first = statistics.median(sample[name] for sample in warm[:third])
        last = statistics.median(sample[name] for sample in warm[-third:])
        found.append(Level(name, first, last, limit.top(first), len(warm)))
    return found
