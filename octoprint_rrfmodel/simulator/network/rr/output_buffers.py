"""The output buffers that an answer can have (RRF 3.5 OutputMemory.cpp)."""

from __future__ import annotations

from typing import Callable

from ...line.switches import FaultSwitches
from ...model.om import BUFFER_SIZE

ENOUGH = 20
"""Free buffers that a model waits for (3.5.2 and later)."""
IN_USE = 2
"""Buffers of the answer's own head, and of the reply that is under way on another channel."""


class OutputBuffers:
    """Tells what is free; ``pinned`` tells how many buffers wait for somebody to fetch them."""

    def __init__(self, total: int, pinned: Callable[[], int], faults: FaultSwitches):
        self._total = total
        self._pinned = pinned
        self._faults = faults

    @property
    def free(self) -> int:
        """Buffers that are free."""
        if self._faults.is_on("few_buffers"):
            return 0
        return max(0, self._total - IN_USE - self._pinned())

    def are_enough(self) -> bool:
        """Return whether a model may be asked for."""
        return self.free >= ENOUGH

    @property
    def room(self) -> int:
        """Bytes that an answer may have."""
        return self.free * BUFFER_SIZE
