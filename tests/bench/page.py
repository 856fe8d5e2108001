"""The page in Chromium: the main thread's time for one update, a sub-view at a time."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.pty import PtyBoard
from tests.bench import results
from tests.e2e import helpers
from tests.e2e.page import open_view, part
from tests.support.basedir import ADMIN
from tests.support.browser import CHROMIUM, FLAGS
from tests.support.server import OctoPrintServer

LIMIT = 8.0
LIMITS = {2000: LIMIT, 10000: 16.0}
"""Milliseconds by the number of nodes; of very many one picture in 60 a second may be missed."""
UPDATES = 200
OTHERS = ("machine", "job", "chart")

# from here on the page gets what the measurement sends it, and nothing else
ALONE = """() => {
    const core = ko.dataFor(document.querySelector("#rrfmodel_views"));
    window.takeMessage = core.onDataUpdaterPluginMessage;
    core.onDataUpdaterPluginMessage = () => undefined;
}"""

ENLARGE = """(nodes) => {
    const core = ko.dataFor(document.querySelector("#rrfmodel_views"));
    const count = (value) =>
        value && typeof value === "object"
            ? Object.values(value).reduce((sum, below) => sum + 1 + count(below), 0)
            : 0;
    const sensors = JSON.parse(JSON.stringify(core.latest.sensors));
    const sample = sensors.analog.find((sensor) => sensor);
    const missing = nodes - count(core.latest);
    const more = Math.max(0, Math.ceil(missing / (1 + count(sample))));
    for (let number = 0; number < more; number++) {
        sensors.analog.push(Object.assign({}, sample, {name: "sensor " + number}));
    }
    const status = core.status();
    const message = {type: "model", revision: 1, changed: {sensors: sensors}, status: status};
    takeMessage("rrfmodel", message);
    return count(core.latest);
}"""

# what scrolling costs is another matter
PREPARE = """async (number) => {
    const core = ko.dataFor(document.querySelector("#rrfmodel_views"));
    const tree = document.querySelector("#rrfmodel_model [role=tree]");
    const keys = ["boards", "heat", "inputs", "move", "sensors", "state", "tools"];
    const moved = (_name, value) =>
        typeof value === "number" && Math.random() < 0.3 ? value + 0.1 : value;
    const changed = Object.fromEntries(keys.map((key) => [key, core.latest[key]]));
    // the state stays: another number of resets is another machine, whose card is read anew
    const message = {type: "model", revision: number, status: core.status()};
    message.changed = JSON.parse(JSON.stringify(changed, moved));
    window.nextText = JSON.stringify(message);
    tree.scrollTop = (number * 97) % Math.max(1, tree.scrollHeight - tree.clientHeight);
    const frame = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    await frame();
    await frame();
}"""

# text to values, then whatever the page does, then its layout; by a timer, since Chromium does not
# count what is called by its developer tools
UPDATE = """() => new Promise((done) => setTimeout(() => {
    takeMessage("rrfmodel", JSON.parse(window.nextText));
    document.querySelector("#tab_plugin_rrfmodel").getBoundingClientRect();
    done();
}))"""

WORK = ("ScriptDuration", "LayoutDuration", "RecalcStyleDuration")


def measure() -> None:
    """Print the 95th percentile for a large model and a very large one."""
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        board = Board(machine="toolchanger")
        with (
            PtyBoard(board, Path(folder) / "rrf-bench") as pty,
            OctoPrintServer(Path(folder) / "octoprint", ports_glob=f"{folder}/rrf-*") as server,
        ):
            server.connect(pty.link)
            helpers.wait_ready(server)
            browser = playwright.chromium.launch(executable_path=str(CHROMIUM), args=FLAGS)
            page = browser.new_page()
            view = open_view(page, server, ADMIN, "model")
            view.get_by_text("sensors", exact=True).wait_for()
            page.evaluate(ALONE)
            for name in OTHERS:
                page.locator(f"[data-test=view-{name}]").click()
                page.wait_for_timeout(1000)
                _say(f"{name} view", _times(page), LIMIT)
            page.locator("[data-test=view-model]").click()
            for nodes, limit in LIMITS.items():
                _measure_with(page, view, nodes, limit)


def _times(page: Any) -> list[float]:
    """Return the milliseconds that each update took."""
    devtools = page.context.new_cdp_session(page)
    # processor time, so that what else the machine does counts less
    devtools.send("Performance.enable", {"timeDomain": "threadTicks"})

    def worked() -> float:
        metrics = devtools.send("Performance.getMetrics")["metrics"]
        return 1000 * sum(metric["value"] for metric in metrics if metric["name"] in WORK)

    times = []
    for number in range(UPDATES):
        page.evaluate(PREPARE, number)
        before = worked()
        page.evaluate(UPDATE)
        times.append(worked() - before)
    return times


def _measure_with(page: Any, view: Any, nodes: int, limit: float) -> None:
    found = page.evaluate(ENLARGE, nodes)
    part(view, "open-all").click()
    for what, text in (("all open", ""), ("searched", "e")):
        part(view, "find").fill(text)
        page.wait_for_timeout(500)
        _say(f"model view, {found} nodes {what}", _times(page), limit)


def _say(what: str, times: list[float], limit: float) -> None:
    times = sorted(times)
    results.tell(
        f"{what}: an update, main thread, 95 %",
        times[int(len(times) * 0.95)],
        "ms",
        beside=f"median {times[len(times) // 2]:.2f} ms",
        limit=limit,
    )


if __name__ == "__main__":
    measure()
