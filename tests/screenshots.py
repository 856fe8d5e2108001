"""``python -m tests.screenshots``: the pictures of the README, from a simulated machine at work."""

import sys
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.pty import PtyBoard
from tests.support.places import ROOT

from .e2e import helpers
from .support import browser as chromium
from .support.basedir import ADMIN
from .support.server import OctoPrintServer

FOLDER = ROOT / "extras" / "screenshots"

VIEWS = ("machine", "job", "chart", "model")


def take(page, server, board):
    """Take all pictures of a machine that heats up and prints from its card."""
    for line in ("M568 P0 S205 R120 A2", "M140 S60", "G28", "T0", "M106 P0 S0.6", "M220 S110"):
        board.board.execute(line, channel="http")
    helpers.wait_value(server, "move.axes[].homed", all, 60)
    board.board.execute('M32 "square.gcode"', channel="http")
    # so that it is still printed in the last picture
    board.board.speed = 2.0
    chromium.open_octoprint(page, server, ADMIN, "/#tab_plugin_rrfmodel/chart")
    page.wait_for_timeout(25_000)
    for name in VIEWS:
        page.locator(f"[data-test=view-{name}]").click()
        page.wait_for_timeout(3_000)
        shot = page.locator("#tab_plugin_rrfmodel")
        if name == "chart":
            page.get_by_role("button", name="5 min", exact=True).click()
            page.wait_for_timeout(1_500)
        if name == "model":
            page.locator("[data-test=find]").fill("heaters")
            page.wait_for_timeout(1_500)
        shot.screenshot(path=FOLDER / f"{name}.png")
    page.locator("#sidebar_plugin_rrfmodel_wrapper").screenshot(path=FOLDER / "sidebar.png")
    board.board.execute(
        'M291 P"Which filament is loaded?" R"Filament" S4 K{"PLA","PETG","ABS"} J1 Z1',
        channel="telnet",
    )
    dialog = page.locator("#rrfmodel_box_dialog")
    dialog.wait_for(state="visible")
    page.wait_for_timeout(1_000)
    dialog.screenshot(path=FOLDER / "message_box.png")


def main():
    """Start a board, a server and a browser, and take the pictures."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        base = Path(folder)
        with PtyBoard(Board(machine="corexy", speed=5), base / "rrf-0") as board:
            server = OctoPrintServer(base / "octoprint", ports_glob=str(base / "rrf*"))
            server.start()
            try:
                helpers.connect(server, board)
                browser = playwright.chromium.launch(
                    executable_path=str(chromium.CHROMIUM), args=chromium.FLAGS
                )
                page = browser.new_page(viewport={"width": 1280, "height": 1000})
                take(page, server, board)
            finally:
                server.stop()


if __name__ == "__main__":
    sys.exit(main())
