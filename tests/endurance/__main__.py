"""A simulated week on each host, side by side, and a verdict.

``make endurance MINUTES=30``, or ``python -m tests.endurance --minutes 2 --host 2.0 --seed 1``. The
minutes are those of the clock; what came of them in simulated hours is told. Fails where something
was harmed, or has grown; the logs are in ``.artifacts/endurance`` then.
"""

import argparse
import json
import random
import subprocess
import sys

from tests.support.places import ROOT

from .levels import grown_kinds, levels, new_threads
from .week import KEPT, Outcome

HOSTS = ("1.11", "2.0")

WEEK_HOURS = 7 * 24


def main():
    """Run what the command line says; return the exit status."""
    given, more = _parser().parse_known_args()
    hosts = given.host or HOSTS
    seed = given.seed if given.seed is not None else random.randrange(10**6)
    print(f"seed {seed}, {given.minutes:g} minutes on OctoPrint {' and '.join(hosts)}", flush=True)
    KEPT.mkdir(parents=True, exist_ok=True)
    paths = {host: KEPT / f"{host}.json" for host in hosts}
    for path in paths.values():
        path.unlink(missing_ok=True)
    running = [_started(host, path, given.minutes, seed, more) for host, path in paths.items()]
    for process in running:
        process.wait()
    outcomes = {host: _read(path) for host, path in paths.items()}
    for host, outcome in outcomes.items():
        print(f"\nOctoPrint {host}")
        print("\n".join(f"  {row}" for row in _rows(outcome)) if outcome else "  came to nothing")
    return 0 if all(outcome and not outcome.verdict() for outcome in outcomes.values()) else 1


def _parser():
    parser = argparse.ArgumentParser(
        prog="python -m tests.endurance",
        description=__doc__,
        epilog="further options are those of tests.endurance.week",
    )
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--host", action="append", choices=HOSTS)
    parser.add_argument("--seed", type=int)
    return parser


def _started(host, path, minutes, seed, more):
    python = ROOT / ".venv" / f"octoprint-{host}" / "bin" / "python"
    options = ["--minutes", f"{minutes}", "--seed", f"{seed}", "--outcome", path, *more]
    return subprocess.Popen([python, "-m", "tests.endurance.week", *options], cwd=ROOT)


def _read(path):
    return Outcome(**json.loads(path.read_text())) if path.exists() else None


def _rows(outcome):
    """Return the lines of a host's table."""
    weeks = outcome.hours / WEEK_HOURS
    yield (
        f"{outcome.hours:.0f} simulated hours ({weeks:.2f} weeks), {outcome.printing_hours:.0f} of "
        f"them with a print, in {outcome.seconds / 60:.1f} minutes"
    )
    yield (
        f"{outcome.turns} scenes of {len(outcome.scenes)} kinds, {outcome.lines:,} streamed lines, "
        f"{sum(outcome.faults.values())} faults of {len(outcome.faults)} kinds, "
        f"{outcome.pairs} times two at once"
    )
    visits = ", ".join(f"{count} {kind}" for kind, count in sorted(outcome.visits.items()))
    yield f"visits: {visits}; {outcome.told:,} notifications to the subscriber that stays"
    longest = ", ".join(f"{name} {n}" for name, n in sorted(outcome.longest_queues.items()) if n)
    yield f"longest queues: {longest or 'none'}"
    for level in levels(outcome.samples):
        yield (
            f"{level.name:8} {level.first:10,.1f} in the first third, {level.last:10,.1f} in the "
            f"last, level is {level.top:10,.1f}: {'level' if level.is_level else 'RISEN'}"
        )
    risen = {level.name for level in levels(outcome.samples) if not level.is_level}
    if "objects" in risen:
        yield f"  kinds that have become more: {grown_kinds(outcome.samples)}"
    if "threads" in risen:
        yield f"  threads that have come: {new_threads(outcome.samples)}"
    if not levels(outcome.samples):
        yield f"too few measurements for a verdict on growth: {len(outcome.samples)}"
    for harm in outcome.harm:
        yield f"HARMED in turn {harm['turn']}, {harm['scene']} with {harm['faults']}"
        yield f"  must hold: {harm['holds']}"
        yield f"  found: {harm['error']}"
        yield f"  on {harm['board']}; logs in {harm['kept']}"
    verdict = outcome.verdict()
    yield f"seed {outcome.seed}: " + ("nothing was harmed" if not verdict else "NOT WELL")


if __name__ == "__main__":
    sys.exit(main())
