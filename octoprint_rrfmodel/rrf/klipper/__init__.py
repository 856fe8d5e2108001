"""View: the model as Klipper's printer objects, as Moonraker serves them.

    Kept.observe(model, host, now), Kept.heard(line)     after each reply, each line of text
    World(model, host, kept.snapshot, eventtime)         one moment
    names, status                                        what a client gets of it
    Moment(world)                                        the same for many, and what has changed
    temperature_store                                    the last hour, for charts
    as_said, refusal                                     lines and refusals with Klipper's mark

Objects and fields are as in Klipper's status reference; what they come from is in
``docs/klipper.md``.
"""

from .info import printer_info, server_info
from .kept import Kept
from .query import OBJECTS, Moment, names, status, wanted_of
from .said import as_said, refusal
from .temperature_store import STORE_SECONDS, temperature_store
from .world import Accumulated, Host, HostJob, World

__all__ = [
    "OBJECTS",
    "STORE_SECONDS",
    "Accumulated",
    "Host",
    "HostJob",
    "Kept",
    "Moment",
    "World",
    "as_said",
    "names",
    "printer_info",
    "refusal",
    "server_info",
    "status",
    "temperature_store",
    "wanted_of",
]
