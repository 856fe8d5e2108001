"""Things that happen to the board itself: no supply, halted, restarted, pulled out."""

from __future__ import annotations

from ..clock import Clock
from ..line.switches import Incident
from .emergency import Emergency
from .power import Power
from .restart import Restart


class Outages:
    """Takes the board, or the way to it, away from the host."""

    def __init__(self, *, clock: Clock, power: Power, emergency: Emergency, restart: Restart):
        self._clock = clock
        self._power = power
        self._emergency = emergency
        self._restart = restart

    def incidents(self) -> dict[str, Incident]:
        return {
            "reset": Incident(self._reset),
            "disconnect": Incident(self._disconnect),
            "vin_off": Incident(self._power_lost, self._power.come_back),
            "halted": Incident(self._halt, self._emergency.end),
        }

    def _reset(self, after: str | None) -> None:
        self._clock.after_seconds(after, self._restart.reset)

    def _disconnect(self, seconds: str | None) -> None:
        self._restart.unplug(float(seconds or 0))

    def _power_lost(self, argument: str | None) -> None:
        self._power.fail()

    def _halt(self, argument: str | None) -> None:
        self._emergency.stop()
