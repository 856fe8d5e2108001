"""The USB plug: whether the port exists at the moment."""

from __future__ import annotations

from ..clock import Clock


class Plug:
    """Tells whether the board can be reached on USB, and how often it has enumerated anew."""

    def __init__(self, clock: Clock):
        self._clock = clock
        self._back_at = 0.0
        self.sessions = 0
        """How often USB has enumerated anew; a port opened before is dead."""

    @property
    def is_plugged_in(self) -> bool:
        """Whether the port exists at the moment."""
        return self._clock.now >= self._back_at

    def pull(self, seconds: float) -> None:
        """Let the port vanish for so many simulated seconds."""
        self.sessions += 1
        self._back_at = self._clock.now + seconds
