"""How long a line of 64 kB keeps who looks at it, of the most hostile ones that are known."""

from __future__ import annotations

import time
from typing import Any, Callable

from tests.bench import results
from tests.fuzz.hostile import LONGEST, long_lines
from tests.fuzz.targets import TARGETS

LIMIT_MS = 10.0

AGAIN = 5
"""Slowest lines of each that are timed anew: what is slow only once was the machine."""

TIMES = 5


def measure() -> None:
    """Tell the processor time of the slowest line, for each who is given lines of a board."""
    for target in TARGETS:
        if target.long is not None:
            look = target.long()
            slowest = sorted(long_lines(), key=lambda line: _milliseconds(look, line))[-AGAIN:]
            most = max(min(_milliseconds(look, line) for _ in range(TIMES)) for line in slowest)
            what = f"{target.name}: slowest line of {LONGEST / 1000:.0f} kB"
            results.tell(what, most, "ms", limit=LIMIT_MS)


def _milliseconds(look: Callable[[str], Any], line: str) -> float:
    began = time.thread_time()
    look(line)
    return (time.thread_time() - began) * 1e3


if __name__ == "__main__":
    measure()
