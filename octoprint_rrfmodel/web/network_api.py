"""Who may say where a board on the network is, and what its password is.

An address makes the host send requests, so that only who may change settings gives a new one;
others may connect again with one that such a person has used.
"""

import flask
from flask_babel import gettext
from octoprint.access.permissions import Permissions

from ..host.answers import refusal
from ..host.request_json import json_of
from ..link.network.address import address_of
from ..link.network.reasons import reason
from .commands_api import Command

ENDPOINT = "api.connectionCommand"
"""OctoPrint's view of ``POST /api/connection``."""

CONNECTOR = "rrfmodel"

CONNECTOR_NAME = "RepRapFirmware (network)"

LONGEST_PASSWORD = 100


class NetworkRequests:
    """``memory`` keeps addresses and passwords (``link.network.memory.Memory``)."""

    def __init__(self, memory):
        self._memory = memory

    def commands(self):
        """Return the plugin's commands that are about this, each with its name."""
        return [("network_password", Command("SETTINGS", self.keep_password))]

    def keep_password(self, parameters):
        """Keep a board's password (the command ``network_password``)."""
        address, password = address_of(parameters.get("host")), parameters.get("password")
        if address is None:
            return 400, reason("no_address", "")
        if not isinstance(password, str) or len(password) > LONGEST_PASSWORD:
            return 400, gettext("The password has to be a text of 100 letters at most.")
        if password and not password.isprintable():
            return 400, gettext("The password may hold no control characters.")
        self._memory.keep_password(address, password)
        return None

    ##~~ octoprint.server.api.before_request

    def refuse(self):
        """Return an answer for a connection that may not be made, ``None`` for other requests."""
        request = flask.request
        if request.endpoint != ENDPOINT or request.method != "POST":
            return None
        data = json_of(request)
        is_ours = isinstance(data, dict) and data.get("connector") == CONNECTOR
        if not is_ours or data.get("command") != "connect":
            return None
        # without the permission OctoPrint's own answer is the right one
        if not Permissions.CONNECTION.can():
            return None
        parameters = data.get("parameters")
        given = parameters if isinstance(parameters, dict) else {}
        address = address_of(given.get("host"))
        if address is None:
            return refusal(400, reason("no_address", ""))
        if Permissions.SETTINGS.can():
            self._memory.keep_host(address)
        elif address.text not in self._memory.hosts():
            return refusal(
                403,
                gettext(
                    "Only who may change settings can connect to a new address. Ask an"
                    " administrator."
                ),
            )
        return None
