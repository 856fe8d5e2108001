"""Waiting for something to become true, with a message when it doesn't."""

from __future__ import annotations

import os
import time
from typing import Callable, TypeVar

T = TypeVar("T")

# the one who waits takes time from what it waits for, hence seldom where it takes long anyway,
# and seldom too where it takes long to look: a board is looked at at once, a server is asked
SHORTEST_PAUSE = 0.005
LONGEST_PAUSE = 0.5
PAUSE_SHARE = 0.16
LOOK_SHARE = 10

# a CI machine is often shared; whoever waits longer only loses time where the test fails anyway
PATIENCE = 2 if os.environ.get("CI") else 1

# a test that fails must not hold up all others for a quarter of an hour
MOST_SECONDS = 300


def within(seconds: float) -> float:
    """Return how long something may take now that takes so long on a machine that is idle.

    Where more wants to run than there are processors, each gets its share only.
    """
    patient = seconds * PATIENCE
    share = os.getloadavg()[0] / (os.cpu_count() or 1)
    return max(patient, min(patient * share, MOST_SECONDS))


def wait_for(predicate: Callable[[], T], timeout: float = 10, what: str = "the condition") -> T:
    """Return the predicate's first true value; AssertionError with ``what`` when time is up.

    ``timeout`` is in seconds of a machine that does nothing else.
    """
    started = time.monotonic()
    while True:
        looked = time.monotonic()
        value = predicate()
        if value:
            return value
        now = time.monotonic()
        waited = now - started
        assert waited < within(timeout), f"waited {timeout} s for {what}; last value {value!r}"
        pause = max(waited * PAUSE_SHARE, (now - looked) * LOOK_SHARE, SHORTEST_PAUSE)
        time.sleep(min(pause, LONGEST_PAUSE))
