"""Machines to command, and what comes of it."""

import copy
import functools
import re

from octoprint_rrfmodel.rrf.gcode.commands import Refusal, Situation, translate
from octoprint_rrfmodel.rrf.views.machine import Machine

from .simulated import Simulated

FREE = Situation(
    is_connected=True,
    is_rrf=True,
    octoprint_prints=False,
    octoprint_is_paused=False,
    answers_boxes=True,
)
"""Nothing on the host's side forbids anything."""

STEP = re.compile(r"([^.\[\]]+)|\[([0-9]+)\]")

VERSIONS = ("2.05", "3.3", "3.4", "3.5.1", "3.5.3", "3.6", "3.7")

READY = {
    # homed, hot and with its tool, which is when most is allowed
    "move.axes": lambda axes: [{**axis, "homed": True} for axis in axes],
    "heat.heaters": lambda heaters: [{**heater, "current": 220.0} for heater in heaters],
    "state.currentTool": lambda number: 0,
}


@functools.cache
def known(kind, firmware):
    """Return the model that a simulated board of that kind tells."""
    return Simulated(kind, firmware).model()


def with_members(model, members):
    """Return a copy of a model with other members, by path; a function gets what was there."""
    changed = copy.deepcopy(model)
    for path, value in members.items():
        *parents, last = [name or int(index) for name, index in STEP.findall(path)]
        place = changed
        for step in parents:
            place = place[step]
        place[last] = value(place[last]) if callable(value) else value
    return changed


def on(kind="cartesian", firmware="3.5.3", is_current=True, **members):
    """Return a machine that is ready for everything, but for the members given by path."""
    tools = [tool for tool in known(kind, firmware)["tools"] if tool]
    ready = READY if tools and tools[0]["number"] == 0 else {}
    return Machine(with_members(known(kind, firmware), {**ready, **members}), is_current)


def go(name, machine=None, situation=FREE, /, **parameters):
    """Return the lines of a command, or its refusal."""
    outcome = translate(name, parameters, machine or on(), situation)
    return outcome if isinstance(outcome, Refusal) else list(outcome.lines)


def refused(name, machine=None, situation=FREE, /, **parameters):
    """Return status and code of a command that is refused."""
    outcome = go(name, machine, situation, **parameters)
    assert isinstance(outcome, Refusal), outcome
    return outcome.status, outcome.code
