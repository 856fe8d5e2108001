"""What an idle plugin costs: processor time, memory, and bytes on the line beside other clients."""

from __future__ import annotations

import tempfile
import time
from pathlib import Path
from typing import Any

from octoprint_rrfmodel.simulator.board import Board
from tests.bench import results
from tests.bench.board_process import Line
from tests.bench.variants import BARE, PLUGIN, Variant, variants
from tests.e2e.page import open_view
from tests.support.basedir import ADMIN
from tests.support.browser import CHROMIUM, FLAGS

SETTLED_SECONDS = 5.0
SECONDS = 40.0

MACHINES = ("toolchanger", "cartesian")

PLANS = {"PanelDue": ("d99fp", 0.5), "Duet Web Control": ("d99fno", 0.25)}
"""Flags of the live root, and the seconds between two of them."""

AROUND = len('N12345 M409 K"" F"d99fin"*123\n\n\nok\n')
"""Bytes around a reply, with no number in front where others ask."""

LIMITS = {"": 1.0, "a page": 2.0}
BYTES_LIMIT = 0.5


def measure() -> None:
    """Tell processor time without a page and with one, memory, and bytes a minute."""
    with tempfile.TemporaryDirectory() as folder:
        for machine in MACHINES:
            names = (BARE, PLUGIN) if machine == MACHINES[0] else (PLUGIN,)
            with variants(Path(folder) / machine, names, 0, machine=machine) as made:
                for variant in made:
                    _idle(variant, machine)


def _idle(variant: Variant, machine: str) -> None:
    variant.connect()
    _tell(variant, machine, "")
    if variant.name == PLUGIN:
        from playwright.sync_api import sync_playwright

        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(executable_path=str(CHROMIUM), args=FLAGS)
            open_view(browser.new_page(), variant.server, ADMIN, "machine")
            _tell(variant, machine, "a page")
            browser.close()
    results.tell(f"idle, {variant.name}, {machine}: memory", variant.memory(), "MB")
    variant.disconnect()


def _tell(variant: Variant, machine: str, watched: str) -> None:
    time.sleep(SETTLED_SECONDS)
    variant.board.mark()
    before = variant.processor_seconds()
    time.sleep(SECONDS)
    seconds, lines = variant.board.report()
    share = (variant.processor_seconds() - before) / seconds * 100
    what = f"idle, {variant.name}, {machine}{f', {watched}' if watched else ''}"
    limit = LIMITS[watched] if variant.name == PLUGIN else None
    results.tell(f"{what}: processor", share, "% a core", limit=limit)
    if variant.name == PLUGIN:
        _tell_bytes(what, machine, lines, seconds)


def _tell_bytes(what: str, machine: str, lines: list[Line], seconds: float) -> None:
    ours = sum(line.size for line in lines) * 60 / seconds
    board: Any = Board(machine)
    for name, (flags, period) in PLANS.items():
        length = len(board.execute(f'M409 F"{flags}"')) + AROUND
        theirs = length * 60 / period
        results.tell(
            f"{what}: bytes to those of {name}",
            ours / theirs,
            "times",
            beside=f"{ours / 1000:.1f} kB a minute; {theirs / 1000:.0f}",
            limit=BYTES_LIMIT,
        )


if __name__ == "__main__":
    measure()
