"""Waiting for something to become true, with a message when it doesn't."""

from __future__ import annotations

import time
from typing import Callable, TypeVar

T = TypeVar("T")

POLL_SECONDS = 0.05


def wait_for(predicate: Callable[[], T], timeout: float = 10, what: str = "the condition") -> T:
    """Return the predicate's first true value; AssertionError with ``what`` when time is up."""
    deadline = time.monotonic() + timeout
    while True:
        value = predicate()
        if value:
            return value
        assert time.monotonic() < deadline, f"waited {timeout} s for {what}; last value {value!r}"
        time.sleep(POLL_SECONDS)
