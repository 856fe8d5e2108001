"""What a streamed print pays for the plugin: lines a second, processor time, and stops.

OctoPrint alone, with hooks that do nothing, and with the plugin print the same file in turn.
"""

from __future__ import annotations

import asyncio
import contextlib
import os
import statistics
import tempfile
import threading
import time
from collections.abc import Iterator
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any, Callable

from tests.bench import results
from tests.bench.board_process import Line
from tests.bench.server import Listeners
from tests.bench.variants import BARE, EMPTY, PLUGIN, Variant, variants
from tests.support import waiting
from tests.support.basedir import ADMIN

NAME = "stream.gcode"
SUBSCRIBERS = 20

SERVERS = 3
"""OctoPrints of each kind on the fast line: one and the same differs by 3 % from the next, for as
long as it runs."""

FAST = {"baud": 0, "lines": 12000, "rounds": 4}
SLOW = {"baud": 115200, "lines": 2500, "rounds": 4}
CROWDED_ROUNDS = 3

RATIO_LIMIT = 1.03
SLOW_RATIO = 0.97
STOP_LIMIT = 40.0


class Printed:
    """What one print of the file took."""

    def __init__(self, seconds: float, processor: float, lines: list[Line], count: int) -> None:
        moves = [line.at for line in lines if not line.name]
        self.rate = (len(moves) - 1) / (moves[-1] - moves[0])
        self.micros = processor / count * 1e6
        self.lines = lines
        self.seconds = seconds


def measure() -> None:
    """Print lines a second and processor time of each variant, on a fast line and a slow one."""
    with tempfile.TemporaryDirectory() as folder:
        _fast(Path(folder) / "fast")
        _slow(Path(folder) / "slow")


def _fast(folder: Path) -> None:
    found: dict[str, list[Printed]] = {}
    crowded = f"{PLUGIN}, {SUBSCRIBERS} subscribers and a page"
    with variants(folder, (BARE, EMPTY, PLUGIN) * SERVERS, FAST["baud"]) as made:
        for variant in made:
            _upload(variant, FAST["lines"])
        for number in range(FAST["rounds"]):
            for variant in made:
                found.setdefault(variant.name, []).append(_print(variant, FAST["lines"]))
            if number < CROWDED_ROUNDS:
                crowd = _print(made[-1], FAST["lines"], _watched)
                found.setdefault(crowded, []).append(crowd)
        apart = _one_core(made)
    for name, prints in found.items():
        rate = statistics.median(each.rate for each in prints)
        micros = statistics.median(each.micros for each in prints)
        ratio = _ratio(prints, found[EMPTY], "micros")
        results.tell(f"fast line, {name}: lines a second", rate, "/s")
        results.tell(
            f"fast line, {name}: processor a line",
            micros,
            "us",
            beside=f"{ratio:.3f} times empty hooks",
        )
    results.tell(
        "fast line, processor of the plugin to that of empty hooks",
        _ratio(found[PLUGIN], found[EMPTY], "micros"),
        "times",
        beside=f"{FAST['rounds']} rounds in turn with {SERVERS} of each, median",
        limit=RATIO_LIMIT,
    )
    results.tell(
        "the same where both of OctoPrint's threads share one core",
        _ratio(apart[PLUGIN], apart[EMPTY], "micros"),
        "times",
        beside=f"{apart[PLUGIN][0].micros:.0f} us; without what a turn from core to core takes",
        limit=RATIO_LIMIT,
    )


def _one_core(made: list[Variant]) -> dict[str, list[Printed]]:
    """Return prints of each variant on the first core that there is.

    On two the interpreter's lock changes hands between them, at some cost for each line.
    """
    found: dict[str, list[Printed]] = {}
    first = min(os.sched_getaffinity(0))
    for variant in made:
        variant.use({first})
    for _ in range(FAST["rounds"] // 2):
        for variant in made:
            found.setdefault(variant.name, []).append(_print(variant, FAST["lines"]))
    return found


def _slow(folder: Path) -> None:
    found: dict[str, list[Printed]] = {}
    with variants(folder, (BARE, PLUGIN), SLOW["baud"]) as made:
        for variant in made:
            _upload(variant, SLOW["lines"])
        for _ in range(SLOW["rounds"]):
            for variant in made:
                found.setdefault(variant.name, []).append(_print(variant, SLOW["lines"]))
    for name, prints in found.items():
        rate = statistics.median(each.rate for each in prints)
        results.tell(f"115200 baud, {name}: lines a second", rate, "/s")
    results.tell(
        "115200 baud, lines a second to those of OctoPrint alone",
        _ratio(found[PLUGIN], found[BARE], "rate"),
        "times",
        beside=f"{SLOW['rounds']} rounds in turn, median",
        limit=SLOW_RATIO,
        at_least=True,
    )
    _stops(found[PLUGIN])


def _stops(prints: list[Printed]) -> None:
    """Tell how long the stream stood because of polls: the time between two lines of the file."""
    usual = statistics.median(_gaps(prints, False))
    stops = sorted((gap - usual) * 1000 for gap in _gaps(prints, True))
    asked = [line for each in prints for line in _streamed(each) if line.name.startswith("M409")]
    share = sum(line.size for line in asked) * 10 / SLOW["baud"]
    results.tell("115200 baud, stop of the stream by a poll, median", stops[len(stops) // 2], "ms")
    results.tell(
        "115200 baud, the same, longest",
        stops[-1],
        "ms",
        beside=f"of {len(stops)}",
        limit=STOP_LIMIT,
    )
    results.tell(
        "115200 baud, part of the line's time for polls",
        share / sum(each.seconds for each in prints) * 100,
        "%",
        limit=3.0,
    )


def _streamed(printed: Printed) -> list[Line]:
    """Return what went over the line from the file's first line to its last.

    Before and behind those the line is free, and all that is live may come at once.
    """
    of_the_file = [number for number, line in enumerate(printed.lines) if not line.name]
    return printed.lines[of_the_file[0] : of_the_file[-1]]


def _gaps(prints: list[Printed], with_polls: bool) -> Iterator[float]:
    for each in prints:
        last, between = None, False
        for line in each.lines:
            if line.name:
                between = True
                continue
            if last is not None and between == with_polls:
                yield line.at - last
            last, between = line.at, False


def _ratio(ours: list[Printed], base: list[Printed], what: str) -> float:
    return statistics.median(getattr(a, what) / getattr(b, what) for a, b in zip(ours, base))


def _upload(variant: Variant, count: int) -> None:
    text = "".join(
        f"G1 X{20 + number % 100}.{number % 1000:03d} Y{number % 90}.125 E0.{number % 900 + 100}\n"
        for number in range(count)
    )
    variant.server.upload(NAME, text)


def _print(
    variant: Variant,
    count: int,
    during: Callable[[Variant], AbstractContextManager[None]] = contextlib.nullcontext,
) -> Printed:
    """Print the file once, on a connection of its own."""
    variant.connect()
    with during(variant):
        variant.board.mark()
        before, started = variant.processor_seconds(), time.monotonic()
        variant.server.select_and_print(NAME)
        waiting.wait_for(lambda: variant.board.moves() >= count, 300, "the last line")
        seconds, processor = time.monotonic() - started, variant.processor_seconds() - before
    variant.server.wait_state("Operational", 60)
    _, lines = variant.board.report()
    variant.disconnect()
    return Printed(seconds, processor, lines, count)


@contextlib.contextmanager
def _watched(variant: Variant) -> Iterator[None]:
    """Have subscribers and a page while it lasts."""
    from playwright.sync_api import sync_playwright

    from tests.e2e.page import open_view
    from tests.support.browser import CHROMIUM, FLAGS

    over, loop = threading.Event(), asyncio.new_event_loop()

    async def until_over() -> None:
        await loop.run_in_executor(None, over.wait)

    async def listen() -> None:
        await Listeners(variant.server, SUBSCRIBERS).run(until_over)

    def run(done: Any = None) -> None:
        loop.run_until_complete(listen())

    thread = threading.Thread(target=run)
    thread.start()
    try:
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=str(CHROMIUM), args=FLAGS)
            open_view(browser.new_page(), variant.server, ADMIN, "machine")
            yield
            browser.close()
    finally:
        over.set()
        thread.join()
        loop.close()


if __name__ == "__main__":
    measure()
