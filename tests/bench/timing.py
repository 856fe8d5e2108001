"""Two or more things timed in turn, so that a change of the machine's speed meets them all."""

from __future__ import annotations

import statistics
import time
from typing import Callable

ROUNDS = 60


def side_by_side(*functions: Callable[[], None], rounds: int = ROUNDS) -> list[list[float]]:
    """Return the seconds of each call of each function, called in turn after one warm-up."""
    times: list[list[float]] = [[] for _ in functions]
    for function in functions:
        function()
    for _ in range(rounds):
        for function, own in zip(functions, times):
            start = time.perf_counter()
            function()
            own.append(time.perf_counter() - start)
    return times


def median_ratio(times: list[float], base: list[float]) -> float:
    """Return the median of the ratios round by round."""
    return statistics.median(a / b for a, b in zip(times, base))
