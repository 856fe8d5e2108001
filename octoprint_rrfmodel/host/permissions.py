"""Who may read the model and who may command the machine."""

from flask_babel import gettext
from octoprint.access import READONLY_GROUP, USER_GROUP


def permissions(*args, **kwargs):
    """Return the two permissions, in the form of OctoPrint's hook."""
    return [
        {
            "key": "READ",
            "name": gettext("Read the machine's model"),
            "description": gettext(
                "Allows to see what RepRapFirmware tells about the machine and its state."
            ),
            "roles": ["read"],
            "default_groups": [USER_GROUP, READONLY_GROUP],
        },
        {
            "key": "CONTROL",
            "name": gettext("Control the machine"),
            "description": gettext("Allows to command the machine through the plugin."),
            "roles": ["control"],
            "dangerous": False,
            "default_groups": [USER_GROUP],
        },
    ]
