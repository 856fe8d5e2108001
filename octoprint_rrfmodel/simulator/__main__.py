"""``python -m octoprint_rrfmodel.simulator``: a board on a terminal, on the network or on both."""

from __future__ import annotations

import argparse
import signal
import sys
import threading
from typing import Callable, NamedTuple

from . import captured, replay
from .board import Board
from .faults import FAULTS, UnknownFault, parse_fault
from .firmware import VERSIONS, UnknownFirmware, firmware_called
from .machines import MACHINES, UnknownMachine, machine_called

DEFAULT_FIRMWARE = "3.5.3"
BAD_USAGE = 2
LOCAL = "127.0.0.1"
MOST_PORT = 65535


def listing() -> str:
    """Return what ``--list`` prints: machines, firmware versions and faults."""
    lines = ["Machines:"]
    lines += [f"  {name:14} {machine.summary}" for name, machine in MACHINES.items()]
    lines += ["", "Firmware versions:"]
    lines += [f"  {name:14} reports {item.version}" for name, item in VERSIONS.items()]
    lines += ["", "Faults (NAME or NAME:ARGUMENT):"]
    lines += [f"  {name:14} {fault.summary}" for name, fault in FAULTS.items()]
    return "\n".join(lines)


def parser() -> argparse.ArgumentParser:
    result = argparse.ArgumentParser(
        prog="python -m octoprint_rrfmodel.simulator",
        description="A simulated RepRapFirmware board on a pseudo-terminal, the network or both.",
    )
    what = result.add_mutually_exclusive_group()
    result.add_argument("--link", metavar="PATH", help="where to link the pseudo-terminal")
    result.add_argument(
        "--http", metavar="[HOST:]PORT", help="where to serve its web interface (0: any port)"
    )
    result.add_argument(
        "--sbc", action="store_true", help="with --http: behind a single-board computer"
    )
    result.add_argument("--password", metavar="P", help="with --http: the board's password")
    what.add_argument("--machine", metavar="NAME", help="which machine to be (cartesian)")
    what.add_argument("--model", metavar="FILE", help="serve the object model in this file")
    what.add_argument("--replay", metavar="BUNDLE", help="be the machine of this support bundle")
    result.add_argument("--firmware", metavar="VERSION", help=f"({DEFAULT_FIRMWARE})")
    result.add_argument(
        "--speed", metavar="N", type=float, default=1.0, help="simulated seconds per second (1)"
    )
    result.add_argument(
        "--fault", metavar="NAME[:ARG]", action="append", default=[], help="may be repeated"
    )
    result.add_argument("--list", action="store_true", help="machines, versions and faults")
    return result


def board_of(options: argparse.Namespace) -> Board:
    """Return the board that the options describe."""
    firmware = options.firmware
    for fault in options.fault:
        parse_fault(fault)
    if options.replay is not None:
        recorded = replay.load(options.replay)
        options.sbc = options.sbc or (recorded.is_behind_computer and options.http is not None)
        return recorded.board(firmware, faults=options.fault, speed=options.speed)
    model = None
    if options.model is not None:
        model = captured.load(options.model)
        firmware = firmware or captured.firmware_of(model)
    firmware = firmware or DEFAULT_FIRMWARE
    firmware_called(firmware)
    machine = options.machine or "cartesian"
    machine_called(machine)
    return Board(machine, firmware, model=model, faults=options.fault, speed=options.speed)


def main(arguments: list[str] | None = None) -> int:
    """Run until SIGTERM or SIGINT; return the exit code."""
    options = parser().parse_args(arguments)
    if options.list:
        print(listing())
        return 0
    try:
        if options.link is None and options.http is None:
            raise ValueError("--link PATH or --http PORT is needed, or --list")
        if options.http is None and (options.sbc or options.password is not None):
            raise ValueError("--sbc and --password are for --http")
        address = None if options.http is None else address_of(options.http)
        if not options.speed > 0:
            raise ValueError("--speed takes a number above 0")
        board = board_of(options)
    except (UnknownMachine, UnknownFirmware, UnknownFault, captured.UnreadableModel) as problem:
        return _refused(str(problem))
    except ValueError as problem:
        return _refused(str(problem))
    board.network_access.password = options.password or ""
    faces: list[Face] = []
    try:
        if options.link is not None:
            faces.append(terminal_at(board, options.link))
        if address is not None:
            faces.append(network_at(board, address, behind_computer=options.sbc))
    except OSError as problem:
        for face in faces:
            face.stop()
        return _refused(str(problem))
    return run(faces)


def _refused(problem: str) -> int:
    print(f"error: {problem}", file=sys.stderr)
    return BAD_USAGE


def address_of(text: str) -> tuple[str, int]:
    """Return host and port of ``[HOST:]PORT``."""
    host, _, port = text.rpartition(":")
    if not port.isdecimal() or int(port) > MOST_PORT:
        raise ValueError(f"--http takes [HOST:]PORT, not {text!r}")
    return host or LOCAL, int(port)


class Face(NamedTuple):
    """A way to the board that has been opened."""

    where: str
    stop: Callable[[], None]
    error: Callable[[], BaseException | None] = lambda: None
    """Returns what has ended it, if anything."""


def terminal_at(board: Board, link: str) -> Face:
    """Open a pseudo-terminal that is linked there."""
    from .pty import PtyBoard

    terminal = PtyBoard(board, link)
    try:
        terminal.start()
    except OSError as problem:
        raise OSError(f"cannot open a terminal at {link}: {problem}") from problem
    return Face(link, terminal.stop, lambda: terminal.error)


def network_at(board: Board, address: tuple[str, int], *, behind_computer: bool) -> Face:
    """Serve the board at an address."""
    from .network.http_board import HttpBoard
    from .network.sbc_board import SbcBoard

    host, port = address
    try:
        served = (SbcBoard if behind_computer else HttpBoard)(board, host, port)
    except OSError as problem:
        raise OSError(f"cannot serve at {host}:{port}: {problem}") from problem
    served.start()
    return Face(served.url, served.stop)


def run(faces: list[Face]) -> int:
    """Serve a board until a signal comes."""
    ended = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: ended.set())
    try:
        for face in faces:
            print(f"ready {face.where}", flush=True)
        while not ended.wait(0.2):
            for face in faces:
                if face.error() is not None:
                    print(f"error: {face.error()!r}", file=sys.stderr)
                    return 1
    finally:
        for face in faces:
            face.stop()
    return 0


if __name__ == "__main__":
    sys.exit(main())
