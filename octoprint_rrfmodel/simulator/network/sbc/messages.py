"""What the machine says, as the model's ``messages``."""

from __future__ import annotations

import re
from typing import Any, Callable

from ...clock import Clock

LIFE_SECONDS = 60.0
"""A message that nobody has fetched is dropped then."""
_KINDS = {"Warning: ": 1, "Error: ": 2}
_KIND = re.compile(r"(Warning: |Error: )?(.*)", re.DOTALL)


class Messages:
    """Messages of the last minute; ``seconds`` gives real time."""

    def __init__(self, clock: Clock, seconds: Callable[[], float]):
        self._clock = clock
        self._seconds = seconds
        self._entries: list[tuple[float, dict[str, Any]]] = []

    def add(self, text: str) -> None:
        """Keep what has been said; what is empty isn't a message."""
        found = _KIND.match(text.rstrip("\n"))
        if found is None or not found.group(2):
            return
        entry = {
            "content": found.group(2),
            "time": self._clock.date_time(),
            "type": _KINDS.get(found.group(1) or "", 0),
        }
        self._entries.append((self._seconds(), entry))

    def recent(self) -> list[dict[str, Any]]:
        """Return those of the last minute, the oldest first."""
        since = self._seconds() - LIFE_SECONDS
        self._entries = [entry for entry in self._entries if entry[0] > since]
        return [message for _, message in self._entries]
