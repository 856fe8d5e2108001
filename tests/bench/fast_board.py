"""A board in a process of its own that answers moves at once, and all else as the simulated board.

``python -m tests.bench.fast_board LINK [--machine M] [--baud N]`` runs until its standard input
closes, and takes commands there, a line each, with one line in return: ``mark`` begins to note what
comes, ``moves`` tells how many have come since, ``report`` all that was noted, as JSON. With
``--baud`` every byte takes its time, in both directions.
"""

from __future__ import annotations

import argparse
import json
import os
import pty
import re
import select
import sys
import time
import tty
from pathlib import Path
from typing import Any

from octoprint_rrfmodel.simulator.board import Board

MOVE = re.compile(rb"(?:N\d+ )?G[01] ")

NUMBER = re.compile(rb"N\d+ (?P<command>.*?)(?:\*\d+)?\s*")

BITS_A_BYTE = 10

TIMES = 1_000_000
"""Lines whose times are kept."""


class FastBoard:
    """Answers on a pseudo-terminal; ``baud`` is 0 for a line that takes no time."""

    def __init__(self, link: Path, machine: str, baud: int) -> None:
        self._board = Board(machine=machine)
        self._baud = baud
        self._moves = 0
        self._waiting = b""
        self._out = b""
        self._link = link
        self._commands = {"mark": self._mark, "moves": self._count, "report": self._report}
        self._mark()

    def _mark(self) -> None:
        self._noted: list[tuple[float, str, int]] = []
        self._begun = time.monotonic()

    def _count(self) -> int:
        return sum(not name for _, name, _ in self._noted)

    def _report(self) -> dict[str, Any]:
        return {"seconds": time.monotonic() - self._begun, "lines": self._noted}

    def run(self) -> None:
        """Answer until the standard input closes."""
        master, slave = pty.openpty()
        tty.setraw(slave)
        self._link.symlink_to(os.ttyname(slave))
        control = sys.stdin.fileno()
        poll = select.poll()
        poll.register(master, select.POLLIN)
        poll.register(control, select.POLLIN | select.POLLHUP)
        while True:
            ready = {number for number, _ in poll.poll(20)}
            if control in ready:
                command = sys.stdin.readline().strip()
                if not command:
                    break
                print(json.dumps(self._commands[command]()), flush=True)
            if master in ready:
                self._take(master, os.read(master, 4096))
            self._board.advance()
            unasked = self._board.transmit()
            if unasked:
                self._rest(len(unasked), time.monotonic())
                _write(master, unasked)
        self._link.unlink()

    def _take(self, master: int, data: bytes) -> None:
        *lines, self._waiting = (self._waiting + data).split(b"\n")
        for line in lines:
            began = time.monotonic()
            is_move = MOVE.match(line) is not None
            answer = b"ok\n" if is_move else self._answer(line)
            # the board itself takes no time: what it thinks is over before the line has come
            self._rest(len(line) + 1 + len(answer), began)
            if len(self._noted) < TIMES:
                # moves have no name
                name = "" if is_move else _command_of(line).decode("utf-8", "replace")
                self._noted.append((time.monotonic(), name, len(line) + 1 + len(answer)))
            _write(master, answer)

    def _answer(self, line: bytes) -> bytes:
        """Return what the simulated board says, to a line without its number."""
        board = self._board
        self._moves += 1
        with board.lock:
            # a print moves something from one answer to the next
            for number, axis in enumerate(board.data["move"]["axes"]):
                axis["userPosition"] = axis["machinePosition"] = round(
                    (self._moves * 7.13 + number) % 200, 3
                )
        board.receive(_command_of(line) + b"\n")
        answer, begun = b"", time.monotonic()
        while b"ok" not in answer and time.monotonic() - begun < 1:
            answer += board.transmit()
        return answer

    def _rest(self, length: int, began: float) -> None:
        """Wait as long as so many bytes are on the line, from a time on."""
        if self._baud:
            until = began + length * BITS_A_BYTE / self._baud
            time.sleep(max(0.0, until - time.monotonic()))


def _write(master: int, data: bytes) -> None:
    while data:
        data = data[os.write(master, data) :]


def _command_of(line: bytes) -> bytes:
    """Return a line without its number and checksum."""
    found = NUMBER.fullmatch(line)
    return found["command"] if found else line


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("link", type=Path)
    parser.add_argument("--machine", default="toolchanger")
    parser.add_argument("--baud", type=int, default=0)
    options = parser.parse_args()
    FastBoard(options.link, options.machine, options.baud).run()
