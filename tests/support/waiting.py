"""Waiting for something to become true, with a message when it doesn't."""

from __future__ import annotations

import os
import time
from typing import Callable, TypeVar

T = TypeVar("T")

POLL_SECONDS = 0.05

# a CI machine is often shared; whoever waits longer only loses time where the test fails anyway
PATIENCE = 2 if os.environ.get("CI") else 1


def wait_for(predicate: Callable[[], T], timeout: float = 10, what: str = "the condition") -> T:
    """Return the predicate's first true value; AssertionError with ``what`` when time is up.

    ``timeout`` is in seconds of a machine that does nothing else.
    """
    deadline = time.monotonic() + timeout * PATIENCE
    while True:
        value = predicate()
        if value:
            return value
        assert time.monotonic() < deadline, f"waited {timeout} s for {what}; last value {value!r}"
        time.sleep(POLL_SECONDS)
