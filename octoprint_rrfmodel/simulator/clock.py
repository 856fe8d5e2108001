"""Simulated time, and what waits for a moment in it."""

from __future__ import annotations

import datetime
from typing import Any, Callable

Condition = Callable[[], bool]

BOOT_TIME = "2024-11-05T08:00:00"
"""Where the simulated wall clock starts at every restart, until somebody tells the time."""
_BOOT = datetime.datetime.fromisoformat(BOOT_TIME)


class Clock:
    """The time a board lives in; it goes on where ``now`` is set."""

    def __init__(self) -> None:
        self.now = 0.0
        """Simulated seconds since the board was made."""
        self._booted_at = 0.0
        self._wall: datetime.datetime | None = None
        self._waiting: list[tuple[Condition, Callable[[], None]]] = []

    @property
    def up_time(self) -> float:
        """Seconds since the last restart."""
        return self.now - self._booted_at

    def restart(self) -> None:
        """Count the time since the restart anew; what waits goes on waiting."""
        self._booted_at = self.now
        self._wall = None

    def set_wall(self, moment: datetime.datetime) -> None:
        """Set the board's wall clock, which the first who tells the time does."""
        if self._wall is None:
            self._wall = moment - datetime.timedelta(seconds=self.up_time)

    def date_time(self) -> str:
        """Return the board's wall clock as the model shows it."""
        moment = (self._wall or _BOOT) + datetime.timedelta(seconds=int(self.up_time))
        return moment.isoformat()

    def after(self, seconds: float) -> Condition:
        """Return the condition that so many simulated seconds have passed from now."""
        end = self.now + seconds
        return lambda: self.now >= end

    def after_seconds(self, seconds: Any, action: Callable[[], None]) -> None:
        """Call ``action`` once, that much later."""
        self.when(self.after(float(seconds or 0)), action)

    def when(self, condition: Condition, action: Callable[[], None]) -> None:
        """Call ``action`` once, as soon as the condition holds."""
        self._waiting.append((condition, action))

    @property
    def is_awaited(self) -> bool:
        """Whether an action waits for its moment."""
        return bool(self._waiting)

    def run_due(self) -> None:
        """Call the actions whose conditions hold now."""
        if not self._waiting:
            return
        due = [entry for entry in self._waiting if entry[0]()]
        self._waiting = [entry for entry in self._waiting if entry not in due]
        for _, action in due:
            action()
