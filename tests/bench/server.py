"""A whole OctoPrint with a simulated board: sockets, requests, and what a print notices of them."""

from __future__ import annotations

import asyncio
import contextlib
import re
import statistics
import tempfile
import time
from pathlib import Path
from typing import Any

import aiohttp

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.pty import PtyBoard
from tests.bench import results
from tests.bench.timing import side_by_side
from tests.e2e import helpers
from tests.e2e.page import open_view
from tests.support.basedir import ADMIN
from tests.support.browser import CHROMIUM, FLAGS
from tests.support.server import OctoPrintServer

SUBSCRIBERS = 100
CHANGES = 80
CHANGE_SECONDS = 0.25
LATENCY_LIMIT = 100.0
REQUESTS = 200
MODEL_LIMIT = 3.0
PRINTED_LINES = 1500
MORE_SENSORS = 150

OBJECTS = {"display_status": None, "toolhead": None, "extruder": None, "heater_bed": None}

SHOWN = re.compile(rb'"displayMessage":"change (\d+)"')


class TimedBoard(Board):
    """Notes when a reply with each display message leaves."""

    def __init__(self, **options: Any) -> None:
        self.left_at: dict[int, float] = {}
        super().__init__(**options)

    def transmit(self) -> bytes:
        """Return what leaves now."""
        data = super().transmit()
        now = time.monotonic()
        for found in SHOWN.finditer(data):
            self.left_at.setdefault(int(found[1]), now)
        return data


class Listeners:
    """So many sockets that subscribed to the same, and when each change came to each."""

    def __init__(self, server: OctoPrintServer, count: int = SUBSCRIBERS) -> None:
        self._count = count
        self._address = f"{server.url}/plugin/rrfmodel/websocket"
        self.came_at: dict[int, list[float]] = {}

    async def run(self, change: Any) -> None:
        """Connect, run ``change`` meanwhile, and close."""
        headers = {"X-Api-Key": ADMIN.api_key}
        connector = aiohttp.TCPConnector(limit=0)
        async with contextlib.AsyncExitStack() as stack:
            session = await stack.enter_async_context(
                aiohttp.ClientSession(headers=headers, connector=connector)
            )
            sockets = [
                await stack.enter_async_context(session.ws_connect(self._address))
                for _ in range(self._count)
            ]
            tasks = [asyncio.create_task(self._listen(socket)) for socket in sockets]
            await change()
            for task in tasks:
                task.cancel()

    async def _listen(self, socket: aiohttp.ClientWebSocketResponse) -> None:
        call = {"method": "printer.objects.subscribe", "params": {"objects": OBJECTS}}
        await socket.send_json({"jsonrpc": "2.0", "id": 1, **call})
        async for message in socket:
            now = time.monotonic()
            found = re.search(r'"message":"change (\d+)"', message.data)
            if found and "notify_status_update" in message.data:
                self.came_at.setdefault(int(found[1]), []).append(now)


def measure() -> None:
    """Print what subscribers wait, what the model costs, and what a print loses."""
    with tempfile.TemporaryDirectory() as folder, contextlib.ExitStack() as stack:
        board = TimedBoard(machine="toolchanger", speed=20)
        link = stack.enter_context(PtyBoard(board, Path(folder) / "rrf-bench")).link
        server = stack.enter_context(
            OctoPrintServer(Path(folder) / "octoprint", ports_glob=f"{folder}/rrf-*")
        )
        server.connect(link)
        helpers.wait_ready(server)
        _latency(server, board)
        _page(server, board)
        _print(server)
        _enlarge(board)
        helpers.wait_value(server, "#sensors.analog", lambda count: count > MORE_SENSORS, 60)
        _requests(server)


def _enlarge(board: Board) -> None:
    """Give the machine as many sensors as make its model 40 kB long."""
    with board.lock:
        analog = board.data["sensors"]["analog"]
        analog += [dict(analog[0], name=f"sensor {number}") for number in range(MORE_SENSORS)]
        board.bump("sensors")


def _requests(server: OctoPrintServer) -> None:
    def ask(path: str) -> Any:
        return lambda: server.get(path).raise_for_status()

    model = "/plugin/rrfmodel/model?flags=d99vno"
    size = len(server.get(model).content) / 1000
    version, whole = side_by_side(ask("/api/version"), ask(model), rounds=REQUESTS)
    more = (statistics.median(whole) - statistics.median(version)) * 1000
    bare = statistics.median(version) * 1000
    results.tell(
        f"GET model, {size:.0f} kB, over GET /api/version",
        more,
        "ms",
        beside=f"GET /api/version {bare:.2f} ms",
        limit=MODEL_LIMIT,
    )


def _latency(server: OctoPrintServer, board: TimedBoard) -> None:
    listeners = Listeners(server)

    async def change() -> None:
        for number in range(CHANGES):
            board.execute(f'M117 "change {number}"')
            await asyncio.sleep(CHANGE_SECONDS)
        await asyncio.sleep(2)

    asyncio.run(listeners.run(change))
    waits = sorted(
        (came - board.left_at[number]) * 1000
        for number, all_of_them in listeners.came_at.items()
        for came in all_of_them
    )
    p50, p99 = waits[len(waits) // 2], waits[int(len(waits) * 0.99)]
    results.tell(
        f"change to websocket, {SUBSCRIBERS} subscribers, 99 %",
        p99,
        "ms",
        beside=f"median {p50:.1f} ms, {len(waits)} messages",
        limit=LATENCY_LIMIT,
    )


NOTE_CHANGES = """() => {
    window.seen = {};
    const look = () => {
        const found = /change (\\d+)/.exec(document.body.textContent);
        if (found && !(found[1] in window.seen)) window.seen[found[1]] = Date.now();
    };
    new MutationObserver(look).observe(document.body, {
        subtree: true,
        childList: true,
        characterData: true,
    });
}"""


def _page(server: OctoPrintServer, board: TimedBoard) -> None:
    """Tell the time from the board's reply to the text in an open page."""
    from playwright.sync_api import sync_playwright

    board.left_at.clear()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=str(CHROMIUM), args=FLAGS)
        page = browser.new_page()
        open_view(page, server, ADMIN, "machine")
        page.evaluate(NOTE_CHANGES)
        for number in range(CHANGES):
            board.execute(f'M117 "change {number}"')
            page.wait_for_timeout(CHANGE_SECONDS * 1000)
        page.wait_for_timeout(2000)
        seen = page.evaluate("() => window.seen")
        browser.close()
    began = time.time() - time.monotonic()
    waits = sorted(at - (board.left_at[int(number)] + began) * 1000 for number, at in seen.items())
    results.tell(
        "change to the page's DOM, 99 %",
        waits[int(len(waits) * 0.99)],
        "ms",
        beside=f"median {waits[len(waits) // 2]:.0f} ms, {len(waits)} changes",
    )


def _print(server: OctoPrintServer) -> None:
    server.commands("G28")
    helpers.wait_value(server, "move.axes[0].homed", True, 60)
    text = "".join(
        f"G1 X{20 + number % 2}.{number % 100:02d} F6000\n" for number in range(PRINTED_LINES)
    )
    server.upload("bench.gcode", text)

    def printed() -> float:
        started = time.monotonic()
        server.select_and_print("bench.gcode")
        server.wait_state("Printing")
        server.wait_state("Operational", 300)
        return PRINTED_LINES / (time.monotonic() - started)

    async def with_listeners() -> float:
        rates: list[float] = []

        async def change() -> None:
            rates.append(await asyncio.get_running_loop().run_in_executor(None, printed))

        await Listeners(server).run(change)
        return rates[0]

    alone, listened = [], []
    for _ in range(2):
        alone.append(printed())
        listened.append(asyncio.run(with_listeners()))
    results.tell(
        f"streamed, {SUBSCRIBERS} subscribers: lines a second",
        max(listened),
        "/s",
        beside=f"{max(alone):.0f}/s without any",
    )
