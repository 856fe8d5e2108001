"""``python -m tests.screenshots``: the pictures of the README, from a simulated machine at work."""

import sys
import tempfile
from pathlib import Path

from playwright.sync_api import sync_playwright

from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.device import demo_print
from octoprint_rrfmodel.simulator.pty import PtyBoard
from tests.support.places import ROOT

from .e2e import helpers
from .support import browser as chromium
from .support.basedir import ADMIN
from .support.server import OctoPrintServer

FOLDER = ROOT / "extras" / "screenshots"

TOOLS = (1, 3)
"""Of the tool changer, that print."""

SIZE = {"width": 1280, "height": 900}

TALL = {"width": 1280, "height": 1120}

WIDE = {"width": 1920, "height": 1080}

MOST_BYTES = 200_000

VIEWS = ("machine", "chart", "console", "model")

BEGINNING_SECONDS = 300
"""Until the demo has printed some layers."""


def shoot(place, name):
    """Keep a picture of a page or an element."""
    path = FOLDER / f"{name}.png"
    place.screenshot(path=path, animations="disabled")
    size = path.stat().st_size
    print(f"{path.name}: {size // 1000} kB")
    assert size < MOST_BYTES, "too large for a repository"


SAID = (
    "M220 S110",
    "echo {move.axes[2].machinePosition}",
    "M106 P1 S0.7",
    'echo "Layer " ^ job.layer',
)
"""What a person might say in the Console."""


def set_up(server, board):
    """Connect with the settings of OctoPrint that the wizard would set."""
    helpers.connect(server, board)
    for command in ("fix_settings", "fix_profile"):
        response = server.post("/api/plugin/rrfmodel", json={"command": command, "all": True})
        assert response.ok, response.text
    helpers.disconnect(server)
    helpers.connect(server, board)


def begin(page, server, board):
    """Have the tool changer print the demo from its card, until there is something to see of it."""
    # macros are listed while the machine has nothing better to do
    chromium.open_octoprint(page, server, ADMIN, "/#tab_plugin_rrfmodel/machine")
    page.locator("[data-test=macro]").first.wait_for(timeout=60_000)
    board.board.execute("G28", channel="http")
    helpers.wait_value(server, "move.axes[].homed", all, 60)
    # slow enough for a curve
    board.board.speed = 3
    board.board.execute(f'M32 "{demo_print.NAME}"', channel="http")
    helpers.wait_value(server, "job.layer", lambda layer: bool(layer), BEGINNING_SECONDS)
    board.board.speed = 20
    helpers.wait_value(server, "job.layer", lambda layer: layer > 11, BEGINNING_SECONDS)
    # so that it is still printed in the last picture, at a pace that can be looked at
    board.board.speed = 2
    board.board.execute("M486 P2", channel="http")


def take(page):
    """Take the pictures of the tab, view by view."""
    for name in VIEWS:
        page.locator(f"[data-test=view-{name}]").click()
        page.wait_for_timeout(3_000)
        if name == "chart":
            page.get_by_role("button", name="5 min", exact=True).click()
        if name == "console":
            page.locator("[data-test=console-clear]").click()
            for text in SAID:
                page.locator("[data-test=console-input]").fill(text)
                page.keyboard.press("Enter")
                page.wait_for_timeout(1_500)
        if name == "model":
            page.locator("[data-test=find]").fill("heaters")
        look_away(page)
        shoot(page, name)


def look_away(page):
    """Leave nothing in the picture that is passing."""
    page.wait_for_timeout(2_000)
    page.evaluate("PNotify.removeAll(); window.scrollTo(0, 0)")
    page.mouse.move(0, 0)
    page.wait_for_timeout(1_000)


def take_more(page, board):
    """Take those of the wide tab, the sidebar and a message box."""
    page.evaluate("window.scrollTo(0, 0)")
    shoot(page.locator("#sidebar_plugin_rrfmodel_wrapper"), "sidebar")
    page.locator("[data-test=wide]").click()
    # a print has more to show than the place beside OctoPrint's sidebar
    page.locator("[data-test=view-job]").click()
    page.set_viewport_size(TALL)
    look_away(page)
    shoot(page, "job")
    page.locator("[data-test=view-machine]").click()
    page.set_viewport_size(WIDE)
    look_away(page)
    shoot(page, "wide")
    page.locator("[data-test=wide]").click()
    page.set_viewport_size(SIZE)
    board.board.execute(
        'M291 P"Which filament is loaded?" R"Filament" S4 K{"PLA","PETG","ABS"} J1 Z1',
        channel="telnet",
    )
    dialog = page.locator("#rrfmodel_box_dialog")
    dialog.wait_for(state="visible")
    page.wait_for_timeout(1_000)
    shoot(dialog, "message_box")


def main():
    """Start a board, a server and a browser, and take the pictures."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        base = Path(folder)
        with PtyBoard(Board(machine="toolchanger", speed=30), base / "rrf-0") as board:
            server = OctoPrintServer(base / "octoprint", ports_glob=str(base / "rrf*"))
            demo_print.put_on(board.board.card, TOOLS)
            server.start()
            try:
                set_up(server, board)
                browser = playwright.chromium.launch(
                    executable_path=str(chromium.CHROMIUM), args=chromium.FLAGS
                )
                page = browser.new_page(viewport=SIZE)
                begin(page, server, board)
                take(page)
                take_more(page, board)
            finally:
                server.stop()


if __name__ == "__main__":
    sys.exit(main())
