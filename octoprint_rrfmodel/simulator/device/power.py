"""The motors' supply."""

from __future__ import annotations

from ..model.tree import ObjectModel
from .motion import Motion


class Power:
    """Tells whether motors and heaters have their supply."""

    def __init__(self, model: ObjectModel, motion: Motion):
        self._model = model
        self._motion = motion
        self.restart()

    def restart(self) -> None:
        self.is_on = True

    def fail(self) -> None:
        """Lose the supply: nobody knows where the axes are any more."""
        self.is_on = False
        self._model.data["boards"][0]["vIn"]["current"] = 0.2
        self._motion.lose_position()

    def come_back(self) -> None:
        self.is_on = True
        self._model.data["boards"][0]["vIn"]["current"] = 24.1
