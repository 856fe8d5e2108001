"""``python -m octoprint_rrfmodel.simulator``: a simulated board on a pseudo-terminal."""

from __future__ import annotations

import argparse
import signal
import sys
import threading

from . import captured
from .board import Board
from .faults import FAULTS, UnknownFault, parse_fault
from .firmware import VERSIONS, UnknownFirmware, firmware_called
from .machines import MACHINES, UnknownMachine, machine_called

DEFAULT_FIRMWARE = "3.5.3"
BAD_USAGE = 2


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
        description="A simulated RepRapFirmware board on a pseudo-terminal.",
    )
    what = result.add_mutually_exclusive_group()
    result.add_argument("--link", metavar="PATH", help="where to link the pseudo-terminal")
    what.add_argument("--machine", metavar="NAME", help="which machine to be (cartesian)")
    what.add_argument("--model", metavar="FILE", help="serve the object model in this file")
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
    model = None
    if options.model is not None:
        model = captured.load(options.model)
        firmware = firmware or captured.firmware_of(model)
    firmware = firmware or DEFAULT_FIRMWARE
    firmware_called(firmware)
    machine = options.machine or "cartesian"
    machine_called(machine)
    for fault in options.fault:
        parse_fault(fault)
    return Board(machine, firmware, model=model, faults=options.fault, speed=options.speed)


def main(arguments: list[str] | None = None) -> int:
    """Run until SIGTERM or SIGINT; return the exit code."""
    options = parser().parse_args(arguments)
    if options.list:
        print(listing())
        return 0
    try:
        if options.link is None:
            raise ValueError("--link PATH is needed, or --list")
        if not options.speed > 0:
            raise ValueError("--speed takes a number above 0")
        board = board_of(options)
    except (UnknownMachine, UnknownFirmware, UnknownFault, captured.UnreadableModel) as problem:
        return _refused(str(problem))
    except ValueError as problem:
        return _refused(str(problem))
    return run(board, options.link)


def _refused(problem: str) -> int:
    print(f"error: {problem}", file=sys.stderr)
    return BAD_USAGE


def run(board: Board, link: str) -> int:
    """Serve the board at ``link`` until a signal comes."""
    from .pty import PtyBoard

    ended = threading.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: ended.set())
    terminal = PtyBoard(board, link)
    try:
        terminal.start()
    except OSError as problem:
        return _refused(f"cannot open a terminal at {link}: {problem}")
    try:
        print(f"ready {link}", flush=True)
        while not ended.wait(0.2):
            if terminal.error is not None:
                print(f"error: {terminal.error!r}", file=sys.stderr)
                return 1
    finally:
        terminal.stop()
    return 0


if __name__ == "__main__":
    sys.exit(main())
