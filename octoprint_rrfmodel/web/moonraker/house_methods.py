"""The methods about the server, the computer and who is asking, put together."""

import time

from octoprint.webcams import get_webcams

from ...rrf import klipper
from .access_methods import access_methods
from .computer import Statistics
from .database import Database
from .database_methods import database_methods
from .machine_methods import machine_methods
from .power import PowerDevices
from .server_methods import server_methods
from .webcams import webcam

READ = "PLUGIN_RRFMODEL_READ"


def house_methods(host, objects, sockets, tokens, parts):
    """Return the rows; ``sockets`` are told what is news of the power devices.

    ``host`` is OctoPrint, ``objects`` gives the printer objects, ``tokens`` issues what stands for
    a user once, ``parts`` are those of the plugin that others ask for (``moonraker.Parts``).
    """

    def webcams():
        is_on = host.settings().global_get_boolean(["webcam", "webcamEnabled"])
        found = [webcam(each, is_on) for each in get_webcams(host.plugins()).values()]
        return [each for each in found if each is not None]

    def temperature_store():
        now = time.time()
        samples = parts.samples(now - klipper.STORE_SECONDS)
        return klipper.temperature_store(objects.world(), samples, now)

    def print_state():
        return objects.query({"print_stats": ["state"]})["status"]["print_stats"]["state"]

    def throttled():
        helpers = host.plugins().get_helpers("pi_support", "get_throttled") or {}
        state = helpers["get_throttled"]() if "get_throttled" in helpers else None
        return getattr(state, "raw_value", None)

    power = PowerDevices(
        objects.model, parts.commands.command, host.plugins, print_state=print_state
    )
    sockets.watch(power.news)
    statistics = Statistics(throttled)
    sockets.each_second("notify_proc_stat_update", lambda: [statistics.news(sockets.count())], READ)
    return (
        *server_methods(webcams, temperature_store),
        *database_methods(Database(host.folder)),
        *machine_methods(power, statistics, websocket_count=sockets.count),
        *access_methods(tokens),
    )
