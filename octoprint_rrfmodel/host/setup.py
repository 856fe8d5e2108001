"""What is to be set up for a machine: OctoPrint's settings, the printer profile, the first run."""

from flask_babel import gettext
from octoprint.access.permissions import Permissions

from ..rrf.gcode.commands.parameters import shown
from ..web.model_api import answer, refusal
from .command_texts import command_text

SEEN = ["wizard_seen"]


class Setup:
    """Tells what there is to set up, and writes what somebody has chosen of it.

    ``settings`` are ``OctoPrintSettings``, ``profile`` is the ``PrinterProfile``, ``own()`` are
    the plugin's settings. ``is_ready()`` says whether the machine has told its whole model,
    ``prints()`` whether OctoPrint or the machine has a print, paused or not.
    """

    def __init__(self, settings, profile, own, is_ready, prints):
        self._settings = settings
        self._profile = profile
        self._own = own
        self._is_ready = is_ready
        self._prints = prints

    def is_first_run(self):
        """Return whether nobody has been led through this since the plugin was installed."""
        seen = self._own().get_boolean(SEEN)
        return not seen and self._is_ready() and not self._prints()

    def get_setup(self):
        """Return all of it; the differences are empty while no whole model is known."""
        if not Permissions.SETTINGS.can():
            return refusal(403, gettext("You may not see OctoPrint's settings."))
        return answer(
            {
                "first_run": self.is_first_run(),
                "ready": self._is_ready(),
                "settings": self._settings.table(),
                "profile": self._profile.differences() if self._is_ready() else [],
            }
        )

    def fix_profile(self, parameters):
        """Write the fields that are named, or all; else only raise the number of extruders."""
        fields, takes_all = parameters.get("fields"), parameters.get("all", False)
        is_list = isinstance(fields, list) and all(isinstance(name, str) for name in fields)
        if fields is not None and not is_list:
            return 400, gettext("fields has to be a list of names of fields.")
        if not isinstance(takes_all, bool):
            return 400, command_text("not_a_truth_value", {"parameter": "all"})
        if self._prints():
            return 409, gettext("Something is being printed. Change the profile afterwards.")
        if fields is None and not takes_all:
            self._profile.fix()
            return None
        if not self._is_ready():
            return 409, gettext("The machine has not told its whole model yet. Try again soon.")
        if takes_all:
            fields = [row["field"] for row in self._profile.differences()]
        unknown = self._profile.write(fields)
        if unknown:
            field = shown(unknown[0])
            return 400, gettext("The machine says nothing of the field %(field)s.", field=field)
        return None

    def restore(self, parameters):
        """Set back what was changed of OctoPrint's own; a print goes by it."""
        if self._prints():
            return 409, gettext("Something is being printed. Set it back afterwards.")
        self._settings.restore()
        self._profile.restore()
        return None

    def wizard_done(self, parameters):
        """Note that somebody has been led through, and wants no more of it."""
        self._own().set_boolean(SEEN, True)
        self._own().save()
