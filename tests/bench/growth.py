"""How cost grows with the model and with the tools; everything in this process."""

from __future__ import annotations

import copy
import json
import statistics
import tracemalloc
from functools import partial
from typing import Any

from octoprint_rrfmodel.rrf import klipper
from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.klipper.world import Accumulated, Host, World
from octoprint_rrfmodel.rrf.model import m409
from octoprint_rrfmodel.rrf.wire.request import ModelRequest
from octoprint_rrfmodel.simulator.board import Board
from tests.bench import results
from tests.bench.timing import side_by_side

KILOBYTES = (10, 100, 1000)
TOOLS = (1, 8, 64)
REPLIES = 20


def measure() -> None:
    """Tell what a reply costs with larger and larger models, and the printer objects of tools."""
    _by_size()
    _by_tools()


def _by_size() -> None:
    before = None
    for kilobytes in KILOBYTES:
        model = _model()
        analog = model["sensors"]["analog"]
        missing = kilobytes * 1000 - len(json.dumps(model, separators=(",", ":")))
        each = len(json.dumps(analog[0], separators=(",", ":"))) + 1
        analog.extend(dict(analog[0]) for _ in range(max(0, missing // each)))
        tracemalloc.start()
        follower = _followed(model)
        memory = tracemalloc.get_traced_memory()[0] / 1e6
        tracemalloc.stop()
        texts = []
        for number in range(REPLIES):
            model["heat"]["heaters"][0]["current"] = 20 + number / 10
            texts.append(_answer(model, follower.next_request()))
        times = side_by_side(partial(_take, follower, texts), rounds=10)[0]
        micros = statistics.median(times) / REPLIES * 1e6
        beside = f"{micros / before:.1f} times the one before" if before else ""
        results.tell(
            f"model of {kilobytes} kB: a live reply into the model",
            micros,
            "us",
            beside=beside,
            memory_mb=round(memory, 2),
        )
        results.tell(f"model of {kilobytes} kB: memory of the model", memory, "MB")
        before = micros


def _by_tools() -> None:
    before, last = None, 0
    for count in TOOLS:
        model = _model()
        tool = next(filter(None, model["tools"]))
        heater = model["heat"]["heaters"][tool["heaters"][0]]
        first = len(model["heat"]["heaters"])
        model["heat"]["heaters"] += [dict(heater) for _ in range(count)]
        model["tools"] = [
            dict(copy.deepcopy(tool), number=number, heaters=[first + number], extruders=[0])
            for number in range(count)
        ]
        world = World(model, Host(True, True, True, None), Accumulated(), eventtime=1.0)
        wanted = dict.fromkeys(klipper.names(world))
        times = side_by_side(partial(klipper.status, world, wanted), rounds=20)[0]
        micros = statistics.median(times) * 1e6
        beside = f"{micros / before:.1f} times that of {last}" if before else ""
        results.tell(f"{count} tools: all printer objects", micros, "us", beside=beside)
        before, last = micros, count


def _model() -> dict[str, Any]:
    data = Board("toolchanger").data
    assert isinstance(data, dict)
    return copy.deepcopy(data)


def _followed(model: dict[str, Any]) -> Follower:
    """Return a follower that knows the whole model."""
    follower = Follower()
    while not follower.ready:
        follower.take(_answer(model, follower.next_request()))
    return follower


def _answer(model: dict[str, Any], request: Any) -> str:
    assert isinstance(request, ModelRequest)
    return json.dumps(m409.answer(model, request.key, request.flags), separators=(",", ":"))


def _take(follower: Follower, texts: list[str]) -> None:
    for text in texts:
        follower.next_request()
        follower.take(text)


if __name__ == "__main__":
    measure()
