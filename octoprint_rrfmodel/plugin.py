"""The plugin as OctoPrint sees it: answers its mixins, wires the parts, computes nothing."""

import time
from functools import partial

import flask
import octoprint.plugin
from flask_babel import gettext
from octoprint.access.permissions import Permissions
from octoprint.events import Events, eventManager

from .api import ModelApi
from .comm import POLL_TAG, CommBridge
from .display import Display
from .notices import notice_text
from .operations import OperationTranslator
from .polling import Poller
from .protection import DISABLED_PLUGIN, Protection
from .push import ModelPush
from .rrf.card import CardPlan
from .rrf.follower import Follower
from .rrf.machine import Machine
from .rrf.temperatures import temperatures
from .sdcard import SdCard
from .sdjob import SdJob
from .sdupload import UploadRefusal
from .settings import DEFAULTS, VERSION
from .simulated_port import SimulatedPort
from .status import PluginStatus
from .terminal import TerminalFilter
from .unsendable import UnsendableCommands
from .worker import Worker


class RrfModelPlugin(
    octoprint.plugin.StartupPlugin,
    octoprint.plugin.ShutdownPlugin,
    octoprint.plugin.EventHandlerPlugin,
    octoprint.plugin.SettingsPlugin,
    octoprint.plugin.AssetPlugin,
    octoprint.plugin.TemplatePlugin,
    octoprint.plugin.SimpleApiPlugin,
    octoprint.plugin.BlueprintPlugin,
):
    """RepRapFirmware's object model, live inside OctoPrint."""

    def __init__(self):
        clock = time.monotonic
        self._protection = Protection(
            lambda: self._printer,
            lambda: self._printer_profile_manager,
            lambda: self._settings,
            self.get_plugin_data_folder,
            lambda: self.bridge,
            self._machine,
            self._notice,
            lambda: self._card.end_job(),
            lambda key: self._worker.notify("look", key),
            clock,
        )
        self._worker = Worker(
            {
                "identified": self._on_identified,
                "disconnected": self._on_disconnected,
                "poll_sent": lambda: self._poller.poll_sent(),
                "status_sent": lambda: self._poller.status_sent(),
                "reply": lambda text: self._poller.reply(text),
                "refused": lambda line: self._poller.refused(line),
                "refused_operation": self._notice,
                "heard": self._on_heard,
                "look": lambda key: self._poller.hurry(key),
                **self._protection.handlers,
            },
            [lambda: self._poller.tick(), lambda: self._push.tick()],
        )
        self._follower = Follower()
        refused = partial(self._worker.notify, "refused_operation")
        self._operations = OperationTranslator(self._machine, self._is_translated, refused)
        self._unsendable = UnsendableCommands(self._machine, self._is_translated, refused)
        self.display = Display(
            lambda: self.bridge.connection, self._known_temperatures, eventManager().fire
        )
        self._card = SdCard(
            CardPlan(),
            SdJob(self._model, self._is_current, lambda line: self._printer.commands(line), clock),
            lambda: self.bridge.connection,
            self._model,
            self._operations.translate,
            lambda row: self._settings.get_boolean(["replies", row]),
        )
        self.bridge = CommBridge(
            self._worker.notify,
            self._card.translate,
            self._card,
            self.display.show_target,
            self._unsendable.instead,
            self._protection.guard.handles,
            clock,
        )
        self.uploads = UploadRefusal(lambda: self.bridge.is_rrf)
        self._poller = Poller(
            self._follower, self._card, self.bridge, self._send, self._on_reply, clock
        )
        self._status = PluginStatus(
            lambda: self._plugin_version,
            self.bridge,
            self._poller,
            self._follower,
            lambda: self._printer.is_operational(),
            self._protection.advice,
            clock,
        )
        self._push = ModelPush(self._tell_pages, self._model, self._status, clock)
        self._api = ModelApi(self._model, self._status)
        self.terminal = TerminalFilter(
            lambda: self.bridge.has_polled_at_all() and self._settings.get_boolean(["hide_polls"]),
            self.bridge.has_polled,
        )
        self.simulated_port = SimulatedPort(lambda: self._settings.get(["simulator"], merged=True))

    ##~~ OctoPrintPlugin

    def on_plugin_pending_uninstall(self):
        self._protection.restore()

    def on_plugin_disabled(self):
        self._protection.restore()

    ##~~ StartupPlugin, ShutdownPlugin

    def on_after_startup(self):
        self._worker.start()

    def on_shutdown(self):
        self._worker.stop()

    ##~~ EventHandlerPlugin

    def on_event(self, event, payload):
        # events come late: by now another connection may be up, which brings its own beginning
        if event == Events.DISCONNECTED and not self._printer.is_operational():
            self.bridge.forget()
            self._worker.notify("disconnected")
        if event == DISABLED_PLUGIN and payload["id"] == self._identifier:
            self._protection.restore()
        note = self._protection.note_of(event)
        if note and self.bridge.is_rrf:
            self._worker.notify(note)

    ##~~ SettingsPlugin

    def get_settings_defaults(self):
        return DEFAULTS

    def get_settings_version(self):
        return VERSION

    ##~~ TemplatePlugin

    def get_template_configs(self):
        return [
            {
                "type": "sidebar",
                "name": gettext("RepRapFirmware"),
                "icon": "microchip",
                "custom_bindings": True,
            },
            {"type": "settings", "name": gettext("RepRapFirmware"), "custom_bindings": False},
        ]

    def get_template_vars(self):
        return {group: list(DEFAULTS[group]) for group in ("operations", "replies")}

    def is_template_autoescaped(self):
        return True

    ##~~ SimpleApiPlugin

    def is_api_protected(self):
        return False  # READ may be granted to guests; the answer checks it

    def is_api_adminonly(self):
        return False

    def on_api_get(self, request):
        return self._api.get_status()

    def get_api_commands(self):
        return self._protection.commands.names()

    def on_api_command(self, command, data):
        return self._protection.commands.run(command, data)

    ##~~ BlueprintPlugin

    def is_blueprint_protected(self):
        return False  # READ may be granted to guests; each endpoint checks it

    def is_blueprint_csrf_protected(self):
        return True

    @octoprint.plugin.BlueprintPlugin.route("/status", methods=["GET"])
    def get_status(self):
        return self._api.get_status()

    @octoprint.plugin.BlueprintPlugin.route("/model", methods=["GET"])
    def get_model(self):
        return self._api.get_model(flask.request.args)

    ##~~ octoprint.server.http.routes

    def routes(self, server_routes, *args, **kwargs):
        """Return what Tornado serves itself, since it waits for the printer."""
        from octoprint.server import app

        from .live import LiveModelHandler

        parts = {"query": self._poller.query, "refusal": self._why_not_now, "app": app}
        return [(r"/model/live", LiveModelHandler, parts)]

    def _why_not_now(self):
        if not self.bridge.is_rrf:
            return self._api.why_empty()
        if self._follower.protocol == "M408":
            return gettext("This firmware has no M409 and can't be asked for a key.")
        if self._poller.blocked():
            return gettext("The printer is busy and can't be asked now. Try again later.")
        return None

    ##~~ octoprint.server.api.before_request

    def before_request(self, *args, **kwargs):
        """Return what looks at each request to OctoPrint's API before it is answered."""
        return [self.uploads.refuse, *self._protection.refusals]

    ##~~ from the hooks' parts to OctoPrint

    def on_firmware_info(self, comm, firmware_name, data, *args, **kwargs):
        """Keep what the firmware says of itself, and find out whether it is RepRapFirmware."""
        self._status.reported(data)
        self.bridge.on_firmware_info(comm, firmware_name, data)

    def _model(self):
        return self._follower.store.model

    def _send(self, line):
        self._printer.commands(line, tags={POLL_TAG})

    def _tell_pages(self, message):
        self._plugin_manager.send_plugin_message(
            self._identifier, message, permissions=[Permissions.PLUGIN_RRFMODEL_READ]
        )

    def _is_current(self):
        return self._poller.asked_at > self.bridge.settled_at and not self._follower.behind

    def _machine(self):
        return Machine(self._model(), self._is_current())

    def _is_translated(self, row):
        return self._settings.get_boolean(["operations", row])

    def _notice(self, code, detail):
        self._tell_pages({"type": "notice", "code": code, "text": notice_text(code, detail)})

    def _known_temperatures(self):
        model = self._model()
        known = temperatures(model) if "heat" in model else None
        knows_targets = self._poller.asked_at > self.bridge.target_command_at
        return known, not self._poller.is_stale(), knows_targets

    def _on_reply(self, taken, asked_at):
        if taken.reset:
            self._push.forgotten()
            self._protection.guard.board_was_reset()
            return
        self._push.changed(taken.changes)
        self._card.on_news()
        tool = self._model().get("state", {}).get("currentTool")
        # a reply asked for before OctoPrint's own last tool command says nothing about it
        if isinstance(tool, int) and asked_at > self.bridge.tool_command_at:
            self.display.follow_tool(tool)
        self._protection.replied(asked_at)

    def _on_heard(self, what):
        if what == "card":
            self._poller.card_refused()
            return
        self._protection.heard(what)
        self._poller.hurry()

    def _on_identified(self):
        self._on_disconnected()
        self._card.identified()
        self._protection.identified()
        self._poller.start()

    def _on_disconnected(self):
        self._protection.disconnecting()
        self._poller.stop()
        self._push.forgotten()
