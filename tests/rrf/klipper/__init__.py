"""Worlds for the Klipper view: simulated machines, small models, and what they come to."""

import copy
import functools
import re

from octoprint_rrfmodel.rrf.follow.follower import Follower
from octoprint_rrfmodel.rrf.klipper import Accumulated, Host, HostJob, Kept, World, status
from octoprint_rrfmodel.rrf.wire.line import find_reply
from octoprint_rrfmodel.simulator.board import Board
from octoprint_rrfmodel.simulator.firmware import VERSIONS
from octoprint_rrfmodel.simulator.machines import MACHINES

MODELS = [(machine, firmware) for machine in MACHINES for firmware in VERSIONS]

HOST = Host(is_connected=True, is_ready=True, has_protocol=True, job=None)


STEP = re.compile(r"([^.\[\]]+)|\[([0-9]+)\]")


class Machine:
    """A simulated board, the model that is followed of it, and what is kept; time is ours."""

    def __init__(self, machine="cartesian", firmware="3.5.3", **options):
        self.time = 0.0
        self.board = Board(machine, firmware, clock=lambda: self.time, **options)
        self.follower = Follower()
        self.kept = Kept()
        self.host = HOST
        while not self.follower.ready or self.follower.behind:
            self.poll()

    def poll(self):
        """Ask what is to be asked next, and observe the answer."""
        said = self.send(self.follower.next_request().line)
        taken = None
        for line in said.splitlines():
            if found := find_reply(line):
                taken = self.follower.take(found.reply)
        if "unknown" in said.lower() or "not supported" in said.lower():
            self.follower.not_supported()
        if taken is not None and taken.reset:
            self.kept.forget()
        self.kept.observe(self.follower.store.model, self.host, self.time)

    def send(self, *lines):
        """Return what the board says to these lines; whatever is no reply is heard."""
        self.board.receive("".join(line + "\n" for line in lines).encode("utf-8"))
        return self._hear(self.board.transmit().decode("utf-8", "replace"))

    def wait(self, seconds, step=1.0):
        """Let time pass, asking each ``step`` seconds and once more for what has changed."""
        end = self.time + seconds
        while self.time < end:
            self.time = min(end, self.time + step)
            self._hear(self.board.transmit().decode("utf-8", "replace"))
            self.poll()
            while self.follower.behind:
                self.poll()

    def until(self, wanted, most=3600):
        """Let time pass until ``wanted`` holds for this machine."""
        end = self.time + most
        while not wanted(self):
            assert self.time < end, "that never happened"
            self.wait(1.0)

    def _hear(self, said):
        for line in said.splitlines():
            if find_reply(line) is None:
                self.kept.heard(line)
        return said

    @property
    def model(self):
        return self.follower.store.model

    @property
    def status(self):
        return self.model["state"]["status"]

    @property
    def world(self):
        return World(self.model, self.host, self.kept.snapshot, self.time)

    def get(self, name, field):
        return get(self.world, name, field)


@functools.cache
def _model_of(machine, firmware):
    return Machine(machine, firmware).model


def model_of(machine="cartesian", firmware="3.5.3"):
    """Return the model of a simulated machine as a host knows it, to be changed at will."""
    return copy.deepcopy(_model_of(machine, firmware))


def changed(model, **values):
    """Return the model with members at paths replaced; ``__`` stands for a dot."""
    model = copy.deepcopy(model)
    for path, value in values.items():
        put(model, path.replace("__", "."), value)
    return model


def put(model, path, value):
    """Set the member at ``heat.heaters[0].current``; objects on the way are made."""
    *parents, last = [name or int(index) for name, index in STEP.findall(path)]
    for step in parents:
        model = model[step] if isinstance(step, int) else model.setdefault(step, {})
    model[last] = value


def world(model=None, host=HOST, kept=None, now=1000.0):
    """Return a moment of a model in which nothing was observed before."""
    return World({} if model is None else model, host, kept or Accumulated(), now)


def host(job=None, **more):
    """Return a host with a print of its own, given as ``HostJob`` or by its members."""
    return HOST._replace(job=host_job(**job) if isinstance(job, dict) else job, **more)


def host_job(name="part.gcode", size=1000, position=0, print_time=0.0, state="printing", **more):
    """Return a print that the host streams."""
    return HostJob(name, size, position, print_time, state, **more)


def get(at, name, field):
    """Return one field of an object."""
    return status(at, {name: [field]})[name][field]


def whole(at, name):
    """Return all fields of an object."""
    return status(at, {name: None})[name]
