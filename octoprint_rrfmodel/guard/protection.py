"""What watches over prints, the connection and OctoPrint's settings, put together."""

from functools import partial

from octoprint.events import Events

from ..control.machine_commands import MachineCommands
from ..host.journal import Changes
from ..host.octoprint_settings import OctoPrintSettings
from ..host.printer_profile import PrinterProfile
from ..host.request_checks import RequestChecks
from ..host.setup import Setup
from ..link.serial.recovery import Recovery
from ..rrf.views.machine import Machine
from ..web.commands_api import PluginCommands
from .print_guard import PrintGuard
from .unanswerable_box import UnanswerableBox
from .warning_list import Advice

PRINT_BOUNDS = (
    Events.PRINT_STARTED,
    Events.PRINT_DONE,
    Events.PRINT_FAILED,
    Events.PRINT_CANCELLED,
)
"""Where one print ends or another begins."""

NOTES = {
    Events.PRINT_PAUSED: "print_paused",
    Events.PRINT_RESUMED: "print_resumed",
    Events.SETTINGS_UPDATED: "settings_updated",
    **dict.fromkeys(PRINT_BOUNDS, "print_bound"),
}
"""Event of OctoPrint's to the note that it leaves for the worker."""

DISABLED_PLUGIN = "plugin_pluginmanager_disable_plugin"
"""The plugin manager's event for a plugin that somebody takes out of use; one that needs a
restart for that isn't told in any other way."""


class Protection:
    """Builds the parts and hands on what happens.

    ``printer()``, ``profiles()`` and ``settings()`` are OctoPrint's, ``folder()`` is the plugin's
    own. ``bridge()`` knows the connection, ``machine()`` is the view of the model,
    ``notice(code, detail)`` reaches the pages, ``is_ready()`` says
    whether the whole model is known. ``end_job`` and ``look`` are those of
    ``MachineCommands``.
    """

    def __init__(
        self,
        printer,
        profiles,
        settings,
        folder,
        bridge,
        machine,
        notice,
        end_job,
        look,
        is_ready,
        clock,
    ):
        def model():
            return machine().model

        self._model = model
        self._box = UnanswerableBox(model, clock)
        self._settings = OctoPrintSettings(settings, Changes(folder, "changed_settings.json"))
        self.guard = PrintGuard(
            printer,
            lambda: bridge().has_a_print(),
            model,
            lambda code: settings().get_boolean(["guard", code]),
            notice,
        )
        self._recovery = Recovery(
            printer,
            lambda: bridge().connection,
            lambda: profiles().get_current_or_default()["id"],
            lambda: Machine(model()).prints,
            partial(notice, "recover_failed", ""),
        )
        self._profile = PrinterProfile(
            profiles, lambda: bridge().connection, model, Changes(folder, "changed_profiles.json")
        )
        self.advice = Advice(
            model,
            lambda: bridge().is_rrf,
            lambda: printer().is_operational(),
            self.guard,
            self._recovery,
            self._settings,
            self._profile,
            self._box,
        )
        self.machine = MachineCommands(
            printer,
            profiles,
            bridge,
            machine,
            self._box,
            self._recovery,
            end_job,
            look,
            clock,
        )
        """Also called by other plugins."""
        self.setup = Setup(
            self._settings,
            self._profile,
            settings,
            lambda: bridge().is_rrf and is_ready(),
            lambda: bridge().has_a_print() or machine().prints or machine().status == "paused",
        )
        """What the settings page and the first-run wizard show."""
        self.commands = PluginCommands(
            self.machine,
            self._settings.fix,
            self.setup.fix_profile,
            self.setup.restore,
            self.setup.wizard_done,
        )
        self.refusals = [
            self.guard.refuse,
            RequestChecks(lambda: bridge().connection).refuse,
            self.commands.refuse,
        ]
        """What looks at requests to OctoPrint's API."""
        self.handlers = {
            "halted": self._recovery.halted,
            "print_paused": self.guard.paused,
            "print_resumed": self.guard.resumed,
            "print_waits": self.guard.waits_for,
            "print_bound": self.guard.ended,
            "settings_updated": self._settings.look,
        }
        """Name of a note to the worker → what is done there."""

    @staticmethod
    def note_of(event):
        """Return the note that an event of OctoPrint's is to leave, ``None`` for most."""
        return NOTES.get(event)

    def restore(self):
        """Set back what was changed of OctoPrint's own, as when the plugin will be gone."""
        self._settings.restore()
        self._profile.restore()

    ##~~ on the worker

    def identified(self):
        """Note that RepRapFirmware is at the other end."""
        self._recovery.connected()
        self._settings.look()

    def disconnecting(self):
        """Note that the connection is gone, before what is known of the board is forgotten."""
        if Machine(self._model()).is_halted:
            self._recovery.halted()
        self._box.forget()
        self.guard.ended()

    def heard(self, what):
        """Note what a line of text tells."""
        if what == "reset":
            self.guard.board_was_reset()
        elif what == "box":
            self._box.opened()

    def replied(self, asked_at):
        """Look at the model that a reply has changed."""
        self._box.answered(asked_at)
        self.guard.look()
