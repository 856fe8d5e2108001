"""Methods about the server: what it is made of, its webcams, the kept hour, and empty lists."""

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...rrf.klipper import STORE_SECONDS
from .gcode_store import MOST_LINES
from .methods import Method

WEBCAM = "WEBCAM"
"""OctoPrint's permission to watch webcams."""

COMPONENTS = {
    "klippy_apis": "printer.info",
    "data_store": "server.temperature_store",
    "authorization": "access.info",
    "machine": "machine.system_info",
    "proc_stats": "machine.proc_stats",
    "database": "server.database.list",
    "webcam": "server.webcams.list",
    "power": "machine.device_power.devices",
    "file_manager": "server.files.list",
    "history": "server.history.list",
}
"""Parts of Moonraker that clients look for before they show anything of it, each with the method
that tells whether it is here. Those that would have nothing to show (``update_manager``,
``job_queue``, ``announcements``, ``sensor``) are left out."""


def components_of(methods):
    """Return the components that a table of methods has."""
    return [name for name, method in COMPONENTS.items() if methods.named(method) is not None]


def server_methods(webcams, temperature_store):
    """Return the rows.

    ``webcams()`` gives OctoPrint's webcams in Moonraker's form, ``temperature_store()`` the lists
    of what is kept.
    """

    def seen(call):
        return webcams() if call.caller.may(WEBCAM) else []

    def get_webcam(call):
        # the uid counts; some clients know only names
        uid = call.text("uid", "")
        what, wanted = ("uid", uid) if uid else ("name", call.text("name", ""))
        for found in seen(call):
            if found[what] == wanted:
                return {"webcam": found}
        raise RequestRefused(404, gettext("There is no such webcam."))

    return (
        Method("server.config", lambda call: CONFIGURATION),
        Method("server.temperature_store", lambda call: temperature_store()),
        Method("server.webcams.list", lambda call: {"webcams": seen(call)}),
        Method("server.webcams.get_item", get_webcam),
        Method("server.announcements.list", lambda call: {"entries": [], "feeds": []}),
        Method("server.job_queue.status", lambda call: {"queued_jobs": [], "queue_state": "ready"}),
        Method("server.sensors.list", lambda call: {"sensors": {}}),
    )


CONFIGURATION = {
    "config": {
        "server": {},
        "data_store": {"temperature_store_size": STORE_SECONDS, "gcode_store_size": MOST_LINES},
        "file_manager": {},
        "database": {},
        "authorization": {"force_logins": False, "cors_domains": [], "trusted_clients": []},
    },
    "orig": {},
    "files": [],
}
"""What clients ask of Moonraker's configuration; no file has it."""
