"""A board made of the evaluator: it answers requests from a model that tests change."""

import copy
import re

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.model.m409 import AXES_SHOWN, answer
from octoprint_rrfmodel.rrf.wire.line import NO_BUFFERS, find_reply
from octoprint_rrfmodel.rrf.wire.reply import MalformedReply
from octoprint_rrfmodel.rrf.wire.request import ModelRequest

from .strategies import compact

STEP = re.compile(r"([^.\[\]]+)|\[([0-9]+)\]")

SEQS = (
    "boards",
    "directories",
    "fans",
    "global",
    "heat",
    "inputs",
    "job",
    "ledStrips",
    "move",
    "network",
    "sensors",
    "spindles",
    "state",
    "tools",
    "volumes",
)


def counters():
    """Return the counters of a board that has just started."""
    return {**dict.fromkeys(SEQS, 0), "volChanges": [0]}


def machine(axes=3):
    """Return a model with each top-level key, small enough to read in a failure's report."""
    return {
        "boards": [{"mcuTemp": {"current": 30.5, "max": 31.0, "min": 20.0}, "name": "Mini"}],
        "directories": {"filaments": "0:/filaments", "system": "0:/sys/"},
        "fans": [{"actualValue": 0, "name": "", "thermostatic": {"lowTemperature": 40}}, None],
        "global": {"mine": [1, {"a": None}]},
        "heat": {
            "bedHeaters": [0, -1],
            "heaters": [
                {"active": 60.0, "current": 59.9, "max": 120.0, "model": {"pid": {"p": 1.5}}},
                {"active": 0, "current": 21.0, "max": 285.0, "model": {"pid": {"p": 2.5}}},
            ],
        },
        "inputs": [{"lineNumber": 0, "name": "USB", "state": "idle"}],
        "job": {"build": None, "file": {"fileName": None}, "filePosition": None},
        "ledStrips": [],
        "limits": {"axes": 10, "heaters": 32},
        "move": {
            "axes": [
                {"homed": False, "letter": letter, "machinePosition": 0.5}
                for letter in "XYZUVWABCDabcd"[:axes]
            ],
            "currentMove": {"requestedSpeed": 0},
            "extruders": [{"factor": 1.0, "position": 0}],
            "kinematics": {"name": "cartesian"},
            "speedFactor": 1.0,
        },
        "network": {"interfaces": [{"actualIP": None, "type": "wifi"}], "name": "printer"},
        "sensors": {"analog": [{"lastReading": 59.9, "type": "thermistor"}, None]},
        "seqs": counters(),
        "spindles": [],
        "state": {
            "currentTool": -1,
            "displayMessage": "",
            "messageBox": None,
            "status": "idle",
            "upTime": 100,
        },
        "tools": [
            {"active": [0], "name": "", "number": 0, "retraction": {"length": 2.0}},
            {"active": [0], "name": "a", "number": 1, "retraction": {"length": 3.0}},
        ],
        "volumes": [{"freeSpace": 5, "mounted": True, "path": "0:/"}],
    }


def reply_text(request, reply):
    """Return an answer as the board prints it."""
    assert (reply["key"], reply["flags"]) == (request.key, request.flags)
    return compact(reply)


class Board:
    """Answers ``M409`` from ``model``.

    ``room`` is the length of the longest answer, ``rooms`` that of single keys. ``ignored`` are
    flags that this firmware doesn't know. ``from_host`` are keys that an SBC answers, without
    flags.
    """

    def __init__(
        self, model=None, room=10240, rooms=None, axes_shown=AXES_SHOWN, ignored="", from_host=()
    ):
        self.model = machine() if model is None else model
        self.room = room
        self.rooms = rooms or {}
        self.axes_shown = axes_shown
        self.ignored = ignored
        self.from_host = from_host
        self.asked = []

    def reply(self, request):
        """Return the text of the answer, ``None`` for a command that isn't known."""
        if not isinstance(request, ModelRequest):
            return None
        self.asked.append(request)
        known = "".join(letter for letter in request.flags if letter not in self.ignored)
        reply = answer(self.model, request.key, known, firmware=True, axes_shown=self.axes_shown)
        reply["flags"] = request.flags
        text = reply_text(request, reply)
        room = self.rooms.get(request.key, self.room)
        if len(text) > room:
            return NO_BUFFERS
        if request.key in self.from_host:
            del reply["flags"]
            return compact(reply)
        return text

    def set(self, path, value):
        """Change a member, and the counter of its key unless the member is live anyway."""
        self.model = copy.deepcopy(self.model)
        *parents, last = [name or int(index) for name, index in STEP.findall(path)]
        place = self.model
        for step in parents:
            place = place[step]
        place[last] = value
        self.bump(path.partition(".")[0].partition("[")[0])

    def bump(self, key):
        """Say that a key changed; the counters have 16 bits."""
        if key in self.model["seqs"]:
            self.model["seqs"][key] = (self.model["seqs"][key] + 1) % 65536

    def reset(self, **changes):
        """Begin anew with counters at zero, as after a reset."""
        self.model = copy.deepcopy(self.model)
        self.model["seqs"] = counters()
        self.model["state"].update(upTime=0, **changes)

    def keys_asked(self, since=0):
        """Return what was asked for, in order, without the flags."""
        return [request.key for request in self.asked[since:]]


def serve(follower, board, requests=1):
    """Answer so many requests as they come; return the last ``Taken``."""
    taken = None
    for _ in range(requests):
        taken = follower.take(board.reply(follower.next_request()))
    return taken


def feed(follower, line):
    """Give a follower a line; return whether it was read."""
    found = find_reply(line)
    if found is None:
        return False
    try:
        return follower.take(found.reply) is not None
    except MalformedReply:
        return False


def following(board, most=60):
    """Return a follower that has fetched everything from the board."""
    follower = Follower()
    for _ in range(most):
        serve(follower, board)
        if follower.ready and not follower.behind:
            return follower
    raise AssertionError(f"not ready after {most} requests: {board.keys_asked()}")
