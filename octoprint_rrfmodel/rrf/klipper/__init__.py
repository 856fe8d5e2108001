"""View: the model as Klipper's printer objects, as Moonraker serves them.

    Kept.observe(model, host, now), Kept.heard(line)     after each reply, each line of text
    World(model, host, kept.snapshot, eventtime)         one moment
    names, status, difference                            what a client gets of it

Objects and fields are as in Klipper's status reference; what they come from is in
``docs/klipper.md``.
"""

from .info import printer_info, server_info
from .kept import Kept
from .query import OBJECTS, difference, names, status, wanted_of
from .world import Accumulated, Host, HostJob, World

__all__ = [
    "OBJECTS",
    "Accumulated",
    "Host",
    "HostJob",
    "Kept",
    "World",
    "difference",
    "names",
    "printer_info",
    "server_info",
    "status",
    "wanted_of",
]
