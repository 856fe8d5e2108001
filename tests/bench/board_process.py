"""The fast board as others use it: a process, the link it is at, and what it has noted."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any, NamedTuple

from tests.support import waiting
from tests.support.places import ROOT


class Line(NamedTuple):
    """A line that has come."""

    at: float
    name: str
    """The command; empty for a move."""
    size: int
    """Bytes of it and of its answer."""


class BoardProcess:
    """A fast board; use it with ``with``."""

    def __init__(self, link: Path, machine: str = "toolchanger", baud: int = 0) -> None:
        self.link = link
        self.baud = baud
        self._command = [sys.executable, "-m", "tests.bench.fast_board", str(link)]
        self._command += ["--machine", machine, "--baud", str(baud)]

    def __enter__(self) -> BoardProcess:
        self._process = subprocess.Popen(
            self._command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=ROOT
        )
        waiting.wait_for(self.link.is_symlink, 20, "the board")
        return self

    def __exit__(self, *exc_info: object) -> None:
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()

    def _ask(self, command: str) -> Any:
        assert self._process.stdin is not None and self._process.stdout is not None
        self._process.stdin.write(command + "\n")
        self._process.stdin.flush()
        return json.loads(self._process.stdout.readline())

    def mark(self) -> None:
        """Begin to note what comes."""
        self._ask("mark")

    def moves(self) -> int:
        """Return how many moves have come since ``mark``."""
        count = self._ask("moves")
        assert isinstance(count, int)
        return count

    def report(self) -> tuple[float, list[Line]]:
        """Return the seconds since ``mark`` and what has come."""
        told = self._ask("report")
        return told["seconds"], [Line(*line) for line in told["lines"]]
