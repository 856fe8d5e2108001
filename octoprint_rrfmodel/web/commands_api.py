"""``POST /api/plugin/rrfmodel``: commands to the plugin, each with the permission that it needs."""

from typing import Callable, NamedTuple

import flask
from flask_babel import gettext
from octoprint.access.permissions import Permissions

from ..host.answers import refusal
from ..host.command_texts import command_text
from ..host.request_json import json_of
from ..rrf.gcode.commands import COMMANDS
from ..rrf.gcode.commands.parameters import listed, shown

ENDPOINT = "api.pluginCommand"
"""OctoPrint's view of ``POST /api/plugin/<identifier>``."""

IDENTIFIER = "rrfmodel"

CONTROL = "PLUGIN_RRFMODEL_CONTROL"


class Command(NamedTuple):
    """One line of the table."""

    permission: str
    run: Callable[[dict], object]
    """Runs it with its parameters; returns status and sentence if it is refused."""


class PluginCommands:
    """Runs commands; none of them waits for the printer.

    ``machine`` runs those to the machine; ``setup`` changes what is OctoPrint's, and sets it
    back. ``more`` are further ones, as names with their ``Command``.
    """

    def __init__(self, machine, setup, *, more=()):
        def to_machine(name):
            return lambda parameters: machine.run(name, parameters)

        self._commands = {
            **{row.name: Command(CONTROL, to_machine(row.name)) for row in COMMANDS},
            "fix_settings": Command("SETTINGS", lambda parameters: setup.settings.fix()),
            "restore_settings": Command("SETTINGS", setup.restore),
            "fix_profile": Command("SETTINGS", setup.fix_profile),
            "reconnect": Command("CONNECTION", setup.reconnect),
            "wizard_done": Command("SETTINGS", setup.wizard_done),
            **dict(more),
        }

    def names(self):
        """Return the commands; which parameters each has to have is seen to after permissions."""
        return {name: [] for name in self._commands}

    def run(self, name, data):
        """Run a command; return the answer of one that is refused, ``None`` for 204."""
        command = self._commands[name]
        if not _may(command.permission):
            return _may_not()
        parameters = {key: value for key, value in data.items() if key != "command"}
        refused = command.run(parameters)
        return refusal(*refused) if refused else None

    ##~~ octoprint.server.api.before_request

    def refuse(self):
        """Return an answer for a request that names no command, ``None`` for others.

        OctoPrint would answer it before permissions, and some of them with an error of its own.
        """
        request = flask.request
        if request.endpoint != ENDPOINT or (request.view_args or {}).get("name") != IDENTIFIER:
            return None
        data = json_of(request)
        name = data.get("command") if isinstance(data, dict) else None
        if isinstance(name, str) and name in self._commands:
            return None
        if not _may(CONTROL):
            return _may_not()
        if not isinstance(name, str):
            return refusal(400, command_text("not_a_command", {}))
        known = {"command": shown(name), "known": listed(sorted(self._commands))}
        return refusal(400, command_text("unknown_command", known))


def _may(permission):
    return getattr(Permissions, permission).can()


def _may_not():
    return refusal(403, gettext("You may not do that. Ask an administrator."))
