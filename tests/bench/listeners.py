"""How cost grows with those who listen: subscribers to printer objects, in this process."""

from __future__ import annotations

import copy
import statistics
from concurrent.futures import Future
from functools import partial
from typing import Any, Callable

from octoprint_rrfmodel.rrf import klipper
from octoprint_rrfmodel.rrf.klipper.world import Accumulated, Host, World
from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.web.moonraker.subscribers import QUIET_SECONDS, Subscribers
from tests.bench import results
from tests.bench.timing import side_by_side

COUNTS = (1, 10, 100, 500)

KINDS = {
    "who want the same": lambda number, names: names,
    "who each want something else": lambda number, names: _subset(number, names),
}


class _Loop:
    """A loop whose time a measurement sets, and that has no timers of its own."""

    now = 0.0

    def time(self) -> float:
        """Return the time that was set."""
        return self.now

    def call_at(self, when: float, function: Callable[[], None]) -> None:
        """Leave it: the next change is always after the quiet time."""


class _Listener:
    """A connection that counts its bytes."""

    def __init__(self) -> None:
        self.taken = 0

    def send(self, text: str) -> None:
        """Count what a socket would be given."""
        self.taken += len(text)


def measure() -> None:
    """Tell what one change of the model costs with more and more subscribers."""
    for kind, wanted_of in KINDS.items():
        before = None
        for count in COUNTS:
            micros = _change(count, wanted_of)
            beside = f"{micros / before:.1f} times the one before" if before else ""
            results.tell(f"{count} subscribers {kind}: one change", micros, "us", beside=beside)
            before = micros


def _subset(number: int, names: list[str]) -> list[str]:
    """Return a selection that differs from that of the other numbers up to 2 to the names."""
    return [name for place, name in enumerate(names) if (number + 1) >> place & 1]


def _change(count: int, wanted_of: Callable[[int, list[str]], list[str]]) -> float:
    """Return the microseconds that a change takes until all have been told."""
    model = copy.deepcopy(Board("toolchanger").data)
    loop = _Loop()
    world = lambda: World(  # noqa: E731
        model, Host(True, True, True, None), Accumulated(), eventtime=loop.now
    )
    subscribers = Subscribers(world, loop, _at_once)
    names = klipper.names(world())[:9]
    for number in range(count):
        wanted = dict.fromkeys(wanted_of(number, names))
        subscribers.subscribe(_Listener(), wanted, klipper.status(world(), wanted))
    change = partial(_one_change, model, loop, subscribers)
    return statistics.median(side_by_side(change, rounds=20)[0]) * 1e6


def _one_change(model: dict[str, Any], loop: _Loop, subscribers: Subscribers) -> None:
    loop.now += 2 * QUIET_SECONDS
    for heater in model["heat"]["heaters"]:
        heater["current"] = round(heater["current"] + 0.1, 1)
    subscribers.changed()


def _at_once(function: Callable[[], Any], then: Callable[[Any], None]) -> None:
    """Do what otherwise is done off the loop."""
    future: Future[Any] = Future()
    future.set_result(function())
    then(future)


if __name__ == "__main__":
    measure()
