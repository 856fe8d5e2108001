"""A plugin that gives the restart of a board other times than it has: ``POST`` them by name."""

import octoprint.plugin

from octoprint_rrfmodel.link.serial import restart

__plugin_name__ = "Times of the restart"
__plugin_pythoncompat__ = ">=3.9,<4"

NAMES = ("SENDING_SECONDS", "RETURN_SECONDS")
USUAL = {name: getattr(restart, name) for name in NAMES}


class RecoveryTimes(octoprint.plugin.SimpleApiPlugin):
    def is_api_protected(self):
        return True

    def get_api_commands(self):
        return {"set": []}

    def on_api_command(self, command, data):
        for name in NAMES:
            setattr(restart, name, data.get(name, USUAL[name]))


__plugin_implementation__ = RecoveryTimes()
