"""Methods about the computer, what is switched on and off, and what is refused of all that."""

from flask_babel import gettext

from ...host.answers import RequestRefused
from . import computer
from .methods import Method

CONTROL = "PLUGIN_RRFMODEL_CONTROL"

NO_UPDATES = {
    "busy": False,
    "github_rate_limit": None,
    "github_requests_remaining": None,
    "github_limit_reset_time": None,
    "version_info": {},
}
"""OctoPrint looks after updates itself."""


def machine_methods(power, statistics, *, websocket_count):
    """Return the rows; ``websocket_count()`` is the number of sockets that are open.

    ``power`` knows the power devices, ``statistics`` what the computer is doing.
    """

    def get_device(call):
        return power.state(call.text("device"))

    def post_device(call):
        return power.switch(call.text("device"), call.text("action"), call.caller)

    def states(call):
        return {name: state for each in _names(call) for name, state in power.state(each).items()}

    def switching(action):
        def switch(call):
            names = _names(call)
            # none is switched where there isn't one of them
            for name in names:
                power.state(name)
            told = [power.switch(name, action, call.caller) for name in names]
            return {name: state for each in told for name, state in each.items()}

        return switch

    return (
        Method("machine.system_info", lambda call: {"system_info": computer.system_info()}),
        Method("machine.proc_stats", lambda call: statistics.statistics(websocket_count())),
        Method("machine.update.status", lambda call: NO_UPDATES),
        Method("machine.device_power.devices", lambda call: {"devices": power.listed()}),
        Method("machine.device_power.get_device", get_device),
        Method("machine.device_power.post_device", post_device, CONTROL),
        Method("machine.device_power.status", states),
        *(
            Method(f"machine.device_power.{action}", switching(action), CONTROL, verbs=("POST",))
            for action in ("on", "off")
        ),
        *(Method(name, _refuse, CONTROL, verbs=("POST",)) for name in OCTOPRINTS),
    )


def _names(call):
    """Return the devices that a call names by its parameters; their values mean nothing."""
    if not call.params:
        raise RequestRefused(400, gettext("%(name)s is missing.", name="device"))
    return list(call.params)


OCTOPRINTS = (
    "machine.reboot",
    "machine.shutdown",
    "machine.services.restart",
    "machine.services.start",
    "machine.services.stop",
    "server.restart",
    "server.logs.rollover",
)
"""What OctoPrint does itself, by commands that its owner has set up."""


def _refuse(call):
    raise RequestRefused(403, gettext("Use the system menu of OctoPrint's own page for that."))
