"""From a line with a live reply to the model and what changed, against ``json.loads`` alone."""

from __future__ import annotations

import copy
import json
import random
import statistics
from typing import Any

from octoprint_rrfmodel.rrf.model.merge import patched
from octoprint_rrfmodel.rrf.wire.line import find_reply
from octoprint_rrfmodel.rrf.wire.live_reader import LiveReader
from octoprint_rrfmodel.rrf.wire.reply import decode
from octoprint_rrfmodel.simulator.board import Board
from tests.bench import results
from tests.bench.timing import median_ratio, side_by_side

REPLIES = 50
KILOBYTES = (2, 4, 10, 40)
SHARES = (0.01, 0.5)
LIMITS = {(4, 0.01): 2.0, (4, 0.5): 3.2}
"""Of a reply as most machines have it."""

ROUNDS = 30


def measure() -> None:
    """Tell the medians of both ways for each size and share of changed values."""
    for kilobytes in KILOBYTES:
        first = _live_reply(kilobytes * 1000)
        for share in SHARES:
            ours, loads = _compare(_lines(first, share))
            results.tell(
                f"a reply of {len(_text(first)) / 1000:.1f} kB, {share:.0%} changed: taken in",
                median_ratio(ours, loads),
                "times",
                beside=f"{_micros(ours):.0f} us; json.loads {_micros(loads):.0f} us",
                limit=LIMITS.get((kilobytes, share)),
            )


def _compare(lines: list[str]) -> list[list[float]]:
    """Return the times of the plugin's way and of ``json.loads`` for the same lines."""
    follow = _Follow()
    times = side_by_side(lambda: follow.take(lines), lambda: _loads(lines), rounds=ROUNDS)
    assert follow.model == json.loads(lines[-1])["result"]
    return times


class _Follow:
    """The way a live reply goes in the plugin."""

    def __init__(self) -> None:
        self.model: dict[str, Any] = {}
        self.changes: Any = None
        self._reader = LiveReader()

    def take(self, lines: list[str]) -> None:
        for line in lines:
            found = find_reply(line)
            assert found is not None
            members = self._reader.changed(found.reply)
            if members is None:
                members = decode(found.reply).result  # type: ignore[union-attr]
                self._reader.remember(found.reply)
            self.model, self.changes = patched(self.model, members)


def _loads(lines: list[str]) -> None:
    for line in lines:
        json.loads(line)


def _live_reply(length: int) -> dict[str, Any]:
    """Return a live reply of about that length: a tool changer's, with fewer or more sensors."""
    reply = json.loads(Board("toolchanger").execute('M409 K"" F"d99fin"'))
    assert isinstance(reply, dict)
    result = reply["result"]
    for key in ("inputs", "fans", "boards", "spindles"):
        if len(_text(reply)) > length:
            result.pop(key, None)
    analog = result["sensors"]["analog"]
    while len(_text(reply)) < length:
        analog.append(dict(analog[0]))
    return reply


def _lines(first: dict[str, Any], share: float) -> list[str]:
    """Return successive replies; from one to the next that share of the values changes."""
    chance = random.Random(1)
    current = first
    lines = []
    for _ in range(REPLIES):
        current = copy.deepcopy(current)
        places = list(_values(current["result"]))
        numbers = [p for p in places if type(p[0][p[1]]) in (int, float)]
        for parent, step in chance.sample(numbers, min(len(numbers), int(len(places) * share))):
            parent[step] = round(parent[step] + chance.uniform(0.01, 9), 2)
        lines.append(_text(current) + "\n")
    return lines


def _values(value: Any) -> Any:
    """Yield where each plain value stands: its parent and its member or index."""
    steps = value.items() if isinstance(value, dict) else enumerate(value)
    for step, below in steps:
        if isinstance(below, (dict, list)):
            yield from _values(below)
        else:
            yield value, step


def _text(reply: dict[str, Any]) -> str:
    return json.dumps(reply, separators=(",", ":"))


def _micros(times: list[float]) -> float:
    return statistics.median(times) / REPLIES * 1e6
