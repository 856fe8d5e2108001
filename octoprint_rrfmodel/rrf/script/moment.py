"""One moment of the machine, as scripts are understood in it."""

from __future__ import annotations

from ..klipper.macro_names import macro_names
from ..klipper.query import seen
from ..klipper.world import World
from ..views.machine import Machine
from .steps import At


def at_moment(world: World, machine: Machine | None = None) -> At:
    """Return the moment that a world is; without ``machine`` as if nothing had happened since."""
    macros = {name.upper(): path for name, path in macro_names(world.host.macros).items()}
    return At(seen(world), machine or Machine(world.model), macros)
