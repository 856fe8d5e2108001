"""What is to be set up for a machine: OctoPrint's settings, the printer profile, the first run."""

from flask_babel import gettext
from octoprint.access.permissions import Permissions

from ..rrf.gcode.commands.parameters import shown
from .answers import answer, refusal
from .command_texts import command_text
from .journal import Journal
from .octoprint_settings import OctoPrintSettings
from .own_thread import on_a_thread_of_its_own
from .printer_profile import PrinterProfile

SEEN = ["wizard_seen"]


class Setup:
    """Tells what there is to set up, and writes what somebody has chosen of it.

    ``host`` is OctoPrint (``host.host.Host``), ``link`` the line to the board, ``known`` what it
    has told (``link.known.Known``).
    """

    def __init__(self, host, link, known):
        self._own = host.settings
        self.settings = OctoPrintSettings(
            host.settings, Journal(self._base, host.folder, "changed_settings.json")
        )
        self._profile = PrinterProfile(
            host.profiles,
            link.profile,
            known.model,
            changes=Journal(self._base, host.folder, "changed_profiles.json"),
        )
        self._link = link
        self._known = known
        self._seen = None

    def _base(self):
        return self._own().global_get_basefolder("base")

    def problems(self):
        """Return the codes of the warnings that are due."""
        # what OctoPrint's settings say of lines means nothing to a board on the network
        is_line = self._link.kind == "serial"
        codes = list(self.settings.missing) if is_line else []
        if is_line and self.settings.awaits_connection():
            codes.append("settings_reconnect")
        code = self._profile.problem()
        return [*codes, code] if code else codes

    def restore_all(self):
        """Set back what was changed of OctoPrint's own, as when the plugin will be gone."""
        self.settings.restore()
        self._profile.restore()

    def _is_ready(self):
        return self._link.is_rrf and self._known.is_ready()

    def _prints(self):
        machine = self._known.machine()
        return self._link.has_a_print() or machine.prints or machine.status == "paused"

    def is_first_run(self):
        """Return whether nobody has been led through this since the plugin was installed."""
        return not self._is_seen() and self._is_ready() and not self._prints()

    def _is_seen(self):
        # the state tells it several times a second, and OctoPrint's settings take their time
        if self._seen is None:
            self._seen = self._own().get_boolean(SEEN)
        return self._seen

    def identified(self):
        """Look at what is missing for the board that is there now (a listener)."""
        self._seen = None
        self.settings.connected()

    def look(self):
        """Look again at what may be set otherwise now: OctoPrint's settings have changed."""
        self._seen = None
        self.settings.look()

    def get_setup(self):
        """Return all of it; the differences are empty while no whole model is known."""
        if not Permissions.SETTINGS.can():
            return refusal(403, gettext("You may not see OctoPrint's settings."))
        return answer(
            {
                "first_run": self.is_first_run(),
                "ready": self._is_ready(),
                "settings": self.settings.table(),
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
        self.restore_all()
        return None

    def reconnect(self, parameters):
        """Connect to the same board again, for what OctoPrint looks at only then."""
        if self._prints():
            return 409, gettext("Something is being printed. Connect again afterwards.")
        if not self._link.can_restart:
            return 409, gettext(
                "No printer with RepRapFirmware was connected yet. Connect it first."
            )
        on_a_thread_of_its_own(self._link.reconnect, name="rrfmodel.reconnect")
        return None

    def wizard_done(self, parameters):
        """Note that somebody has been led through, and wants no more of it."""
        self._own().set_boolean(SEEN, True)
        self._seen = None
        self._own().save()
