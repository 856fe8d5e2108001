"""A simulated week with a board on the network, in OctoPrint 2.0, and a verdict.

``make endurance-network MINUTES=10``. The minutes are those of the clock, in which the board's time
goes by three thousand times as fast. Fails where something was harmed or has grown, or where the
board was asked more often than three times a second.
"""

import argparse
import contextlib
import random
import shutil
import sys
import tempfile
import time
import traceback
from collections import Counter
from pathlib import Path

from tests.support import plugins
from tests.support.basedir import ADMIN
from tests.support.places import ROOT
from tests.support.push import PushListener
from tests.support.server import OctoPrintServer

from .levels import grown_kinds, levels, new_threads
from .network_rig import MOST_A_SECOND, NetworkRig, busiest
from .picture import Picture
from .scenes_network import SCENES

KEPT = ROOT / ".artifacts" / "endurance-network"

GAUGES = Path(plugins.__file__).with_name("gauges.py")

SHORT_HISTORY = {"temperature": {"cutoff": 1}}

SPEED = 3000.0

MACHINE, FIRMWARE = "toolchanger", "3.5.3"

MOST_HARM = 3


class NetworkWeek:
    """A server with its board; ``run`` goes through it and ``verdict`` says how it was."""

    def __init__(self, seed, speed=SPEED):
        self._seed, self._speed = seed, speed
        self.scenes = Counter()
        self.samples, self.harm = [], []
        self.hours = self.seconds = 0.0
        self.requests = self.mean_rate = self.busiest_rate = self.own_rate = 0.0
        self.quiet_rates = []
        self.resets = 0

    def run(self, seconds, most=None):
        """Go through scenes until the time is over, or through so many at most."""
        with contextlib.ExitStack() as stack:
            rig = self._set_up(stack)
            began, first = time.monotonic(), len(rig.face.asked)
            while time.monotonic() - began < seconds and len(self.harm) < MOST_HARM:
                if most is not None and self.turns >= most:
                    break
                self._turn(rig)
            self.seconds = time.monotonic() - began
            asked = rig.face.asked[first:]
            self.requests, self.mean_rate = len(asked), len(asked) / self.seconds
            self.busiest_rate, self.quiet_rates = busiest(asked), rig.quiet_rates
            self.own_rate = busiest(rig.face.of_itself)
            self.hours = rig.board.clock.now / 3600
            with contextlib.suppress(Exception):
                self.resets = rig.status()["resets"]
        return self

    @property
    def turns(self):
        """How many scenes there were."""
        return sum(self.scenes.values())

    def _set_up(self, stack):
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        server = OctoPrintServer(folder, settings=SHORT_HISTORY, plugin_files=(GAUGES,))
        rig = NetworkRig(server, MACHINE, FIRMWARE, self._speed)
        stack.enter_context(server)
        stack.enter_context(rig.face)
        rig.connect()
        rig.push = stack.enter_context(PushListener(server, ADMIN))
        rig.picture = stack.enter_context(Picture(server))
        return rig

    def _turn(self, rig):
        round_, place = divmod(self.turns, len(SCENES))
        deck = list(SCENES)
        random.Random(f"{self._seed} round {round_}").shuffle(deck)
        scene, began = deck[place], time.monotonic()
        rig.begin(random.Random(f"{self._seed} turn {self.turns}"))
        self.scenes[scene.__name__] += 1
        try:
            scene(rig)
            rig.clear_faults()
            rig.at(None)
            rig.at_rest()
            self._measure(rig)
        except Exception as error:
            self._harmed(rig, scene, error)
        print(f"{self.turns:4} {scene.__name__:20} {time.monotonic() - began:5.1f} s", flush=True)

    def _measure(self, rig):
        response = rig.server.get("/api/plugin/gauges", params={"rest": 1})
        assert response.status_code == 200, response.text
        found = response.json()
        self.samples.append({**found, "queues": sum(found["queues"].values())})

    def _harmed(self, rig, scene, error):
        self.harm.append(f"turn {self.turns}, {scene.__name__}: {str(error)[:1500] or error!r}")
        print(f"HARMED {self.harm[-1]}", flush=True)
        kept = KEPT / f"seed-{self._seed}-turn-{self.turns}"
        shutil.rmtree(kept, ignore_errors=True)
        kept.mkdir(parents=True)
        text = "".join(traceback.format_exception(type(error), error, error.__traceback__))
        (kept / "harm.txt").write_text(text)
        for path in (rig.server.basedir / "logs").glob("*.log*"):
            shutil.copy(path, kept)
        # what comes next shall find a machine that is well
        rig.clear_faults()
        rig.at(None)
        with contextlib.suppress(Exception):
            rig.server.post("/api/job", json={"command": "cancel"})
            rig.connect()

    def verdict(self):
        """Return sentences about what isn't as it should be; none is well."""
        found = list(self.harm)
        found += [
            f"{level.name} has risen from {level.first:g} to {level.last:g}, level is {level.top:g}"
            for level in levels(self.samples)
            if not level.is_level
        ]
        if self.own_rate > MOST_A_SECOND:
            found.append(f"{self.own_rate:.1f} questions a second within ten seconds")
        return found

    def rows(self):
        """Return the lines of a table."""
        weeks = self.hours / (7 * 24)
        yield f"{self.hours:.0f} simulated hours ({weeks:.2f} weeks) in {self.seconds / 60:.1f} min"
        kinds = ", ".join(f"{count} {name}" for name, count in sorted(self.scenes.items()))
        yield f"{self.turns} scenes, {self.resets} resets: {kinds}"
        most = max(self.quiet_rates, default=0.0)
        yield (
            f"{self.requests:.0f} requests, {self.mean_rate:.2f} a second; {most:.2f} at most "
            f"while nobody did anything; in the ten seconds with the most "
            f"{self.own_rate:.1f}, with commands {self.busiest_rate:.1f}"
        )
        for level in levels(self.samples):
            yield (
                f"{level.name:8} {level.first:10,.1f} in the first third, {level.last:10,.1f} in "
                f"the last, level is {level.top:10,.1f}: {'level' if level.is_level else 'RISEN'}"
            )
        if levels(self.samples):
            yield f"kinds of objects that have become more: {grown_kinds(self.samples)}"
            yield f"threads that have come: {new_threads(self.samples)}"
        else:
            yield f"too few measurements for a verdict on growth: {len(self.samples)}"


def main():
    """Run what the command line says; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m tests.endurance.network", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--seed", type=int, default=None)
    parser.add_argument("--speed", type=float, default=SPEED)
    parser.add_argument("--turns", type=int)
    given = parser.parse_args()
    seed = given.seed if given.seed is not None else random.randrange(10**6)
    print(f"seed {seed}", flush=True)
    week = NetworkWeek(seed, given.speed).run(given.minutes * 60, given.turns)
    print("\n".join(week.rows()))
    verdict = week.verdict()
    print(f"seed {seed}: " + ("; ".join(verdict) if verdict else "nothing was harmed"))
    return 1 if verdict else 0


if __name__ == "__main__":
    sys.exit(main())
