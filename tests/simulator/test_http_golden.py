"""Answers of the firmware's own HTTP code, byte for byte; set RRF_SHARED to the recordings.

What was a stand-in there says nothing of a board; :data:`FIGURES`, :data:`STAND_INS` and
:data:`TIMING` say where that was.
"""

from __future__ import annotations

import json
import re

import pytest

from tests.simulator.http_bench import http_bench

FIRMWARES = {"3.5.3+2": "3.5.3", "3.4.6+": "3.4"}
SCENARIOS = ("parse", "web", "sessions", "password", "cors", "upload", "files", "buffer", "estop")

TIMING = {("buffer", 3), ("estop", 1)}
"""Scenario and step whose ``buff`` depends on when the board's loop takes the line."""
VALUES = {("parse", 5)}
"""Steps that answer with values of the model: all but ``result`` is compared."""
FIGURES = {("upload", 9), ("files", 21)}
"""Steps that answer with what was read from a file: order and form are compared."""
STAND_INS = {("estop", 2)}
"""Steps that say nothing of a board: G4 was answered at once, and not at its end."""
STAND_IN_FIGURES = ("height", "layerHeight", "numLayers", "printTime", "filament", "generatedBy")


@pytest.fixture(scope="module")
def recorded(shared_dir):
    path = shared_dir / "golden" / "rrf-http-exchanges.json"
    if not path.is_file():
        pytest.skip(f"{path} isn't there, set RRF_SHARED")
    return json.loads(path.read_text(encoding="utf-8"))


def put_card(bench, recorded):
    """Have on the card what was there in the recordings, and nothing else."""
    card = bench.board.card
    for entry in card.entries("0:/"):
        card.delete_tree(f"0:/{entry.name}")
    for folder in ("empty", "gcodes"):
        card.make_folder(f"0:/{folder}")
    for name, content in recorded["sd"].items():
        card.store(f"0:/{name}", content.encode("latin-1"), recorded["sd_mtime"])


def without_length(text):
    return re.sub(r"Content-Length: \d+", "Content-Length: <LEN>", text)


def comparable(place, text):
    """Return an answer without what the recordings can't tell."""
    if place in TIMING:
        text = without_length(re.sub(r'"buff":\d+', '"buff":N', text))
    if place in VALUES:
        text = without_length(re.sub(r'"result":.*\}\n', '"result":VALUE}\n', text))
    if place in FIGURES:
        for name in STAND_IN_FIGURES:
            # a thumbnail's own height comes later, and isn't a stand-in
            text = re.sub(rf'"{name}":("[^"]*"|\[[^]]*\]|[^,}}]*),?', "", text, count=1)
        text = without_length(text.replace(",}", "}"))
    return text


class Replay:
    """One scenario, with the keys that are given in it."""

    def __init__(self, bench):
        self.bench = bench
        self.keys = {}

    def setup(self, step):
        access = self.bench.board.network_access
        if step["setup"] == "password":
            access.password = step["value"]
        else:
            access.allow_site(step["value"])

    def difference(self, place, step):
        """Return nothing where the board answers as the firmware did."""
        self.bench.wait(step.get("wait_ms", 0) / 1000)
        sent = step["send"]
        for name, key in self.keys.items():
            sent = sent.replace(name, key)
        said = self.bench.raw(sent.encode("latin-1"), step["from"])
        found = self._with_names(said.data.decode("latin-1"), step["recv"])
        wanted = comparable(place, step["recv"])
        found = comparable(place, found)
        end = "reset" if said.is_reset else "closed"
        if place in STAND_INS or (found, end) == (wanted, step["end"]):
            return ""
        return f"{place} {sent!r}\n  firmware {wanted!r}\n  board    {found!r} {end}"

    def _with_names(self, text, recorded):
        """Return an answer with names in the place of what is different each time."""
        name = re.search(r'"sessionKey":(<\w+>)', recorded)
        key = re.search(r'"sessionKey":(\d+)', text)
        if name and key:
            self.keys[name.group(1)] = key.group(1)
            text = text.replace(key.group(1), name.group(1))
        return without_length(text) if "<LEN>" in recorded else text


@pytest.mark.parametrize("name", SCENARIOS)
@pytest.mark.parametrize("recording", FIRMWARES)
def test_as_the_firmware(recorded, recording, name):
    (run,) = [run for run in recorded["runs"] if run["firmware"] == recording]
    (scenario,) = [scenario for scenario in run["scenarios"] if scenario["name"] == name]
    with http_bench("cartesian", FIRMWARES[recording]) as bench:
        put_card(bench, recorded)
        replay = Replay(bench)
        differences = []
        for number, step in enumerate(scenario["steps"]):
            if "setup" in step:
                replay.setup(step)
            else:
                differences.append(replay.difference((name, number), step))
    assert not any(differences), "\n".join(filter(None, differences))


def test_every_scenario_is_compared(recorded):
    """So that a recording that is added isn't left out, and what is compared can be told."""
    for run in recorded["runs"]:
        assert [scenario["name"] for scenario in run["scenarios"]] == list(SCENARIOS)
    steps = [
        (scenario["name"], number)
        for run in recorded["runs"]
        for scenario in run["scenarios"]
        for number, step in enumerate(scenario["steps"])
        if "send" in step
    ]
    assert len(steps) == 316
    assert len([step for step in steps if step in STAND_INS]) == 2
    assert {*TIMING, *VALUES, *FIGURES, *STAND_INS} <= set(steps)
