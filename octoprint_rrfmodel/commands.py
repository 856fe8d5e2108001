"""``POST /api/plugin/rrfmodel``: commands to the plugin, each with the permission that it needs."""

from typing import Callable, NamedTuple

from flask_babel import gettext
from octoprint.access.permissions import Permissions

from .api import refusal


class Command(NamedTuple):
    """One line of the table."""

    permission: str
    run: Callable[[], object]
    refusal: Callable[[], object] = lambda: None
    """Why the printer's state forbids it, ``None`` where it doesn't."""


class PluginCommands:
    """Runs commands; none of them waits for the printer."""

    def __init__(self, recovery, fix_settings, fix_profile, restore):
        self._commands = {
            "recover": Command("PLUGIN_RRFMODEL_CONTROL", recovery.start, recovery.refusal),
            "fix_settings": Command("SETTINGS", fix_settings),
            "restore_settings": Command("SETTINGS", restore),
            "fix_profile": Command("SETTINGS", fix_profile),
        }

    def names(self):
        """Return the commands and the parameters that each has to have."""
        return {name: [] for name in self._commands}

    def run(self, name):
        """Run a command; return the answer of one that is refused, ``None`` for 204."""
        command = self._commands[name]
        if not getattr(Permissions, command.permission).can():
            return refusal(403, gettext("You may not do that. Ask an administrator."))
        why = command.refusal()
        if why:
            return refusal(409, why)
        command.run()
        return None
