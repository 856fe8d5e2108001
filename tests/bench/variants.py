"""OctoPrints that differ in what is installed, each with a fast board of its own."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from tests.bench.board_process import BoardProcess
from tests.e2e import helpers
from tests.support import plugins
from tests.support.basedir import DISABLED_PLUGINS
from tests.support.server import OctoPrintServer

EMPTY_HOOKS = Path(plugins.__file__).with_name("empty_hooks.py")
OWN = "rrfmodel"

BARE, EMPTY, PLUGIN = "bare", "empty hooks", "plugin"

OPTIONS: dict[str, dict[str, Any]] = {
    BARE: {"settings": {"plugins": {"_disabled": [*DISABLED_PLUGINS, OWN]}}},
    EMPTY: {
        "settings": {"plugins": {"_disabled": [*DISABLED_PLUGINS, OWN]}},
        "plugin_files": (EMPTY_HOOKS,),
    },
    PLUGIN: {},
}


class Variant:
    """One OctoPrint and its board."""

    def __init__(self, name: str, server: OctoPrintServer, board: BoardProcess) -> None:
        self.name = name
        self.server = server
        self.board = board

    def connect(self) -> None:
        """Return when lines can be printed."""
        self.server.connect(self.board.link, self.board.baud or 250000)
        self.server.wait_state("Operational")
        if self.name == PLUGIN:
            helpers.wait_ready(self.server, 120)

    def disconnect(self) -> None:
        """Return when the line is closed."""
        self.server.disconnect()
        self.server.wait_disconnected()

    def processor_seconds(self) -> float:
        """Return the processor time that the threads of now have taken, to the microsecond.

        What the kernel tells of the process as a whole is counted in hundredths of a second.
        """
        total = 0
        for task in Path(f"/proc/{self._pid()}/task").iterdir():
            with contextlib.suppress(OSError):
                total += int((task / "schedstat").read_text(encoding="utf-8").split()[0])
        return total / 1e9

    def use(self, processors: set[int]) -> None:
        """Have its threads of now, and those that they will start, run there alone."""
        for task in Path(f"/proc/{self._pid()}/task").iterdir():
            with contextlib.suppress(ProcessLookupError):
                os.sched_setaffinity(int(task.name), processors)

    def memory(self) -> float:
        """Return the resident memory of OctoPrint in MB."""
        status = Path(f"/proc/{self._pid()}/status").read_text(encoding="utf-8")
        line = next(line for line in status.splitlines() if line.startswith("VmRSS"))
        return int(line.split()[1]) / 1024

    def _pid(self) -> int:
        """Return the process below the one that guards it."""
        guard = self.server.pid
        children = Path(f"/proc/{guard}/task/{guard}/children").read_text(encoding="utf-8")
        return int(children.split()[0])


@contextlib.contextmanager
def variants(
    folder: Path, names: tuple[str, ...], baud: int, machine: str = "toolchanger"
) -> Iterator[list[Variant]]:
    """Yield a started variant for each name, none of them connected."""
    with contextlib.ExitStack() as stack:
        made = []
        for number, name in enumerate(names):
            own = folder / f"{number}"
            own.mkdir(parents=True)
            board = stack.enter_context(BoardProcess(own / "rrf-fast", machine, baud))
            server = stack.enter_context(
                OctoPrintServer(
                    own / "octoprint",
                    ports_glob=f"{own}/rrf-*",
                    serial={"log": False},
                    **OPTIONS[name],
                )
            )
            made.append(Variant(name, server, board))
        yield made
