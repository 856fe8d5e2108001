"""One host's week: a scene after the other until the time is over."""

import contextlib
import json
import shutil
import tempfile
import threading
import time
import traceback
from dataclasses import asdict, dataclass, field
from pathlib import Path

from tests.e2e import helpers
from tests.e2e.operations import PROFILE
from tests.support import plugins
from tests.support.basedir import ADMIN
from tests.support.places import ROOT
from tests.support.push import PushListener
from tests.support.server import OctoPrintServer

from .audience import Audience
from .levels import LONGEST_QUEUE, levels
from .picture import Picture
from .rig import MACHINES, Rig
from .scenes import BY_NAME, turn_of

KEPT = ROOT / ".artifacts" / "endurance"

GAUGES = Path(plugins.__file__).with_name("gauges.py")

SHORT_HISTORY = {"temperature": {"cutoff": 1}}
"""OctoPrint's own history of temperatures fills for 30 minutes; what else grows shall show."""

LOOK_SECONDS = 5
"""Between two looks at the queues."""

REST_EVERY = 10
"""Seconds between two measurements at rest, at the least."""

MOST_HARM = 5
"""Whoever was harmed so often has told enough."""


@dataclass
class Outcome:
    """What came of a week."""

    version: str
    seed: int
    speed: float
    turns: int = 0
    hours: float = 0.0
    printing_hours: float = 0.0
    lines: int = 0
    seconds: float = 0.0
    scenes: dict = field(default_factory=dict)
    """Name → how often."""
    faults: dict = field(default_factory=dict)
    """Name → how often."""
    pairs: int = 0
    visits: dict = field(default_factory=dict)
    told: int = 0
    """Notifications to the subscriber that stays."""
    resets: int = 0
    longest_queues: dict = field(default_factory=dict)
    samples: list = field(default_factory=list)
    harm: list = field(default_factory=list)
    """Of each: turn, scene, faults, what must hold, what was found, where the logs are."""

    def verdict(self):
        """Return sentences about what isn't as it should be; none is well."""
        found = [f"turn {each['turn']}, {each['scene']}: {each['error']}" for each in self.harm]
        found += [
            f"{level.name} has risen from {level.first:g} to {level.last:g}, level is {level.top:g}"
            for level in levels(self.samples)
            if not level.is_level
        ]
        found += [
            f"{length} entries in the queue {name}"
            for name, length in self.longest_queues.items()
            if length > LONGEST_QUEUE
        ]
        return found


class Week:
    """A server with its board and who looks at it; ``run`` goes through it."""

    def __init__(self, seed, speed, *, has_pages, names=None, machine=0):
        self._seed = seed
        self._speed = speed
        self._has_pages = has_pages
        self._names = tuple(names or BY_NAME)
        self._machine = machine
        self._rig = self._audience = None
        self._rested_at = 0.0
        self.outcome = None

    def run(self, seconds, first=0, most=None):
        """Go through turns from that one on until the time is over; return the outcome."""
        began = time.monotonic()
        with contextlib.ExitStack() as stack:
            self._set_up(stack)
            turn = first
            while time.monotonic() - began < seconds and (most is None or turn < first + most):
                self._turn(turn)
                turn += 1
                if len(self.outcome.harm) >= MOST_HARM:
                    break
            self._take_stock(began)
        return self.outcome

    def _set_up(self, stack):
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        server = OctoPrintServer(
            folder / "octoprint",
            ports_glob=f"{folder}/rrf-*",
            profile=PROFILE,
            serial=helpers.PATIENT,
            settings=SHORT_HISTORY,
            plugin_files=(GAUGES,),
        )
        self._rig = rig = Rig(server, folder, self._speed)
        self.outcome = Outcome(server.version, self._seed, self._speed)
        stack.enter_context(server)
        stack.callback(rig.unplug_for_good)
        rig.another_board(*MACHINES[self._machine])
        rig.push = stack.enter_context(PushListener(server, ADMIN))
        rig.picture = stack.enter_context(Picture(server))
        self._audience = stack.enter_context(Audience(server, self._seed, self._has_pages))
        over = threading.Event()
        looker = threading.Thread(target=self._look, args=(over,), daemon=True)
        looker.start()
        stack.callback(looker.join, 30)
        stack.callback(over.set)

    def _turn(self, turn):
        scene, companions, chance = turn_of(self._seed, turn, self._names)
        rig, outcome = self._rig, self.outcome
        before, began = rig.hours, time.monotonic()
        rig.begin(turn, scene, chance)
        texts = [companion.text(rig.speed) for companion in companions]
        try:
            for companion, text in zip(companions, texts):
                rig.inject(companion.name, text, companion.lasts)
            scene.run(rig)
            rig.clear_faults()
            rig.at(None)
            rig.at_rest(scene)
            self._look_at_audience()
        except Exception as error:
            self._harmed(scene, texts, error)
        outcome.turns += 1
        outcome.scenes[scene.name] = outcome.scenes.get(scene.name, 0) + 1
        for companion in companions:
            outcome.faults[companion.name] = outcome.faults.get(companion.name, 0) + 1
        outcome.pairs += len(companions) > 1
        outcome.printing_hours += (rig.hours - before) if scene.prints else 0
        took = time.monotonic() - began
        self._tell(f"{turn:4} {scene.name:32} {' + '.join(texts):40} {took:5.1f} s")
        if time.monotonic() - self._rested_at > REST_EVERY:
            self._measure()

    def _tell(self, text):
        print(f"{self.outcome.version:9} {text}", flush=True)

    def _look_at_audience(self):
        if self._audience.errors:
            errors, self._audience.errors = self._audience.errors, []
            raise AssertionError(f"who looked was told: {errors[:3]}")

    ##~~ measuring

    def _gauges(self, **params):
        response = self._rig.server.get("/api/plugin/gauges", params=params)
        assert response.status_code == 200, response.text
        return response.json()

    def _measure(self):
        """Measure while nobody is there."""
        with self._audience.sent_home():
            try:
                # the socket that stays is one
                self._rig.wait(lambda: self._gauges()["sockets"] <= 1, 30, "the sockets to be gone")
            except AssertionError as error:
                self._harmed(None, [], error)
            found = self._gauges(rest=1)
        found["queues"] = sum(found["queues"].values())
        self.outcome.samples.append({**found, "at": round(time.monotonic(), 1)})
        self._rested_at = time.monotonic()

    def _look(self, over):
        longest = self.outcome.longest_queues
        while not over.wait(LOOK_SECONDS):
            # a server that is busy or gone is told of by the scene
            with contextlib.suppress(Exception):
                for name, length in self._gauges()["queues"].items():
                    longest[name] = max(longest.get(name, 0), length)

    def _take_stock(self, began):
        rig, outcome = self._rig, self.outcome
        with contextlib.suppress(Exception):
            self._measure()
            outcome.resets = rig.status()["resets"]
        outcome.hours, outcome.lines = rig.hours, rig.lines
        outcome.visits, outcome.told = self._audience.visits, rig.picture.told
        outcome.seconds = time.monotonic() - began

    ##~~ harm

    def _harmed(self, scene, texts, error):
        rig, outcome = self._rig, self.outcome
        kept = KEPT / f"{outcome.version}-seed-{self._seed}-turn-{rig.turn}"
        harm = {
            "turn": rig.turn,
            "scene": scene.name if scene else "nobody there",
            "holds": scene.holds if scene else "who has left is forgotten",
            "faults": texts,
            "board": f"{rig.board.board.machine.summary}, {rig.board.board.firmware.version}"
            if rig.board
            else "",
            "error": str(error)[:1500] or repr(error),
            "kept": str(kept),
        }
        outcome.harm.append(harm)
        self._tell(f"HARMED {harm['scene']} {texts}: {harm['error']}")
        shutil.rmtree(kept, ignore_errors=True)
        kept.mkdir(parents=True)
        for path in (rig.server.basedir / "logs").glob("*.log*"):
            shutil.copy(path, kept)
        text = "".join(traceback.format_exception(type(error), error, error.__traceback__))
        (kept / "harm.txt").write_text(
            f"{json.dumps(harm, indent=2)}\n\n{text}\n"
            f"python -m tests.endurance.week --seed {self._seed} --speed {self._speed:g}"
            f" --first {rig.turn} --turns 1 --machine {rig.machine}\n"
        )
        if rig.board is not None:
            lines = "\n".join(f"{entry.time:12.3f} {entry.text}" for entry in rig.board.board.log)
            (kept / "board.txt").write_text(lines, "utf-8", "replace")
        if scene is not None:
            self._begin_anew()

    def _begin_anew(self):
        """What comes next shall find a machine that is well."""
        rig = self._rig
        rig.begin(rig.turn, None, None)
        try:
            if rig.server.state().startswith(("Printing", "Paus", "Resum")):
                rig.server.post("/api/job", json={"command": "cancel"})
                rig.server.wait_state("Operational", 60)
        except Exception as error:
            self._tell(f"the print could not be cancelled: {error}")
        try:
            rig.another_board(*MACHINES[0])
            rig.wait(lambda: rig.events("Connected"), 20, "OctoPrint to tell of the connection")
        except Exception as error:
            self._tell(f"there is no way on: {error}")
            self.outcome.harm += [{**self.outcome.harm[-1], "error": f"no way on: {error}"}] * (
                MOST_HARM
            )


def main():
    """Go through the week that the command line says; the outcome goes into a file."""
    import argparse

    parser = argparse.ArgumentParser(prog="python -m tests.endurance.week", description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--speed", type=float, default=400.0)
    parser.add_argument("--minutes", type=float, default=10.0)
    parser.add_argument("--first", type=int, default=0, help="the turn to begin with")
    parser.add_argument("--turns", type=int, help="how many turns at most")
    parser.add_argument("--scene", action="append", choices=list(BY_NAME), help="only these")
    parser.add_argument("--machine", type=int, default=0, help="place in rig.MACHINES")
    parser.add_argument("--no-page", action="store_true", help="without a browser")
    parser.add_argument("--outcome", type=Path, help="where to write it")
    given = parser.parse_args()
    week = Week(
        given.seed,
        given.speed,
        has_pages=not given.no_page,
        names=given.scene,
        machine=given.machine,
    )
    outcome = week.run(given.minutes * 60, given.first, given.turns)
    if given.outcome:
        given.outcome.write_text(json.dumps(asdict(outcome)))
    for sentence in outcome.verdict():
        print(sentence)
    return 1 if outcome.verdict() else 0


if __name__ == "__main__":
    import sys

    sys.exit(main())
