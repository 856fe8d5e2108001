"""Feed all targets for so many minutes and print how many inputs each has had.

``make fuzz MINUTES=10``, or ``python -m tests.fuzz --minutes 1 --only frame``. Each start of
Atheris takes some seconds more. Fails where something was found; that is in ``.artifacts/fuzz``
then, and ``--again FILE`` feeds it once more.
"""

import argparse
import contextlib
import importlib.util
import pickle
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import octoprint.filemanager  # noqa: F401, OctoPrint 2.0 can't be imported from any side

from tests.fuzz import run
from tests.fuzz.targets import BY_COVERAGE, BY_NAME, TARGETS
from tests.link.test_line_machine import PluginOnABadLine
from tests.rrf.follow.test_follower_machine import BoardOnABadLine
from tests.support.places import ROOT

SERVED_WEIGHT = 6
"""Shares of the time for each kind that goes to a real OctoPrint, and for each state machine: they
are slower."""

MACHINES = {"runs of the line": PluginOnABadLine, "runs of the model": BoardOnABadLine}

GROWTH_MB = 40
"""More memory than this after all requests and frames is a leak; buffers take some."""

SLOW_STOP_SECONDS = 120


def main():
    """Run what the command line says; return the exit status."""
    arguments = _parser().parse_args()
    run.watch_for_hangs()
    if arguments.again:
        return _again(arguments.again)
    first_seed = arguments.seed if arguments.seed is not None else random.randrange(10**9)
    rows = [target for target in TARGETS if arguments.only in target.name]
    served = [name for name in SERVED if arguments.only in name]
    machines = [name for name in MACHINES if arguments.only in name]
    covered = [target for target in BY_COVERAGE if arguments.only in target.name]
    shares = len(rows) + len(covered) + SERVED_WEIGHT * (len(served) + len(machines))
    if not shares:
        print(f"no target has {arguments.only!r} in its name")
        return 2
    seconds = arguments.minutes * 60 / shares
    print(f"seed {first_seed}, {seconds:.1f} s for each of {shares} shares", flush=True)
    print(f"{'target':26} {'by':12} {'inputs':>9}  found", flush=True)
    began = time.monotonic()
    found = []
    for target in rows:
        found += _told(target.name, "Hypothesis", _hypothesis(target, seconds, first_seed))
    for target in covered:
        found += _told(target.name, "Atheris", _atheris(target, seconds))
    for name in machines:
        outcome = run.with_machine(name, MACHINES[name], seconds * SERVED_WEIGHT, first_seed)
        found += _told(name, "Hypothesis", outcome)
    if served:
        found += _fuzz_served(served, seconds * SERVED_WEIGHT, first_seed)
    print(f"{time.monotonic() - began:.0f} s in all", flush=True)
    for path in found:
        print(f"found {path}, run it again: {run.AGAIN} {path}")
    return 1 if found else 0


def _parser():
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--only", default="", help="part of the names of the targets to feed")
    parser.add_argument("--seed", type=int)
    parser.add_argument("--again", type=Path, help="an input that was found")
    return parser


def _told(name, way, outcome):
    inputs, found = outcome
    print(f"{name:26} {way:12} {inputs:9,}  {len(found) or ''}", flush=True)
    return list(found)


def _hypothesis(target, seconds, first_seed):
    counted = run.Counted(target.name, target.make)
    return run.with_hypothesis(counted, target.inputs, seconds, first_seed)


def _atheris(target, seconds):
    if importlib.util.find_spec("atheris") is None:
        return run.Outcome(0, ())
    before = _found_of(target)
    with tempfile.TemporaryDirectory() as folder:
        count = Path(folder) / "count"
        done = subprocess.run(
            [
                sys.executable,
                "-m",
                "tests.fuzz.covered",
                target.name,
                str(int(seconds) or 1),
                count,
            ],
            cwd=ROOT,
            capture_output=True,
            timeout=seconds + SLOW_STOP_SECONDS,
        )
        inputs = int(count.read_text()) if count.exists() else 0
    new = sorted(_found_of(target) - before)
    if done.returncode and not new:
        sys.stderr.buffer.write(done.stderr[-4000:])
        new = [f"nothing that was kept; Atheris ended with {done.returncode}"]
    return run.Outcome(inputs, tuple(new))


def _found_of(target):
    return {str(path) for path in run.FOUND.glob(f"{run.file_name(target.name)}-*.pickle")}


##~~ a real OctoPrint

SERVED = ("requests", "frames", "requests described")


@contextlib.contextmanager
def _served():
    from octoprint_rrfmodel.simulator.board import Board
    from octoprint_rrfmodel.simulator.pty import PtyBoard
    from tests.e2e import helpers
    from tests.fuzz.served import Served
    from tests.support.server import OctoPrintServer

    with tempfile.TemporaryDirectory() as folder:
        board = PtyBoard(Board("toolchanger", speed=20), Path(folder) / "rrf")
        server = OctoPrintServer(Path(folder) / "octoprint", ports_glob=f"{folder}/rrf*")
        with board:
            server.start()
            try:
                helpers.connect(server, board)
                served = Served(server, board)
                try:
                    yield served
                finally:
                    served.close()
            finally:
                server.stop()


def _fuzz_served(names, seconds, first_seed):
    from tests.fuzz.described import cases
    from tests.fuzz.served import REQUESTS, SERVED_FRAMES

    found = []
    with _served() as served:
        ways = {
            "requests": (REQUESTS, served.request),
            "frames": (SERVED_FRAMES, served.frame),
            "requests described": (cases(served.server), served.described),
        }
        before = served.size()
        for name in names:
            inputs, feed = ways[name]
            counted = run.Counted(name, lambda feed=feed: feed)
            outcome = run.with_hypothesis(counted, inputs, seconds, first_seed)
            try:
                served.look()
            except AssertionError as error:
                path = run.kept(name, "see the text", error)
                outcome = outcome._replace(found=(*outcome.found, path))
            found += _told(name, "Hypothesis", outcome)
        growth = served.size() - before
        print(f"memory of the server: {before} MB, {growth:+} MB", flush=True)
        if growth > GROWTH_MB:
            found.append(f"the server's memory has grown by {growth} MB")
    return found


def _again(path):
    name, given_input = pickle.loads(path.read_bytes())
    if name in MACHINES:
        made = run.with_machine(name, MACHINES[name], 1, int(given_input.split()[1]) - 1)
        assert not made.found, made.found
    elif name in BY_NAME:
        BY_NAME[name].make()(given_input)
    else:
        with _served() as served:
            ways = {"requests": served.request, "frames": served.frame}
            if name not in ways:
                print(f"what {name} had can only be sent by hand: {given_input}")
                return 2
            ways[name](given_input)
            time.sleep(1)
            served.look()
    print("it holds now")
    return 0


if __name__ == "__main__":
    sys.exit(main())
