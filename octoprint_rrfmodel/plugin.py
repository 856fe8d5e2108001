"""The plugin as OctoPrint sees it: answers its mixins and computes nothing."""

import octoprint.plugin
from flask_babel import gettext
from octoprint.access.permissions import Permissions
from octoprint.events import eventManager

from .assembly import Assembly
from .host.host import Host
from .host.notes import DISABLED_PLUGIN
from .host.plugin_settings import DEFAULTS, VERSION
from .host.updates import update_check
from .web.assets import assets_of
from .web.bundle_api import BundleHandler
from .web.endpoints import Endpoints
from .web.files_api import FolderHandler, Folders
from .web.height_map_api import HeightMapHandler
from .web.live_api import LiveModelHandler
from .web.machine_files_api import MachineFileHandler, MachineFilesHandler
from .web.network_api import CONNECTOR, CONNECTOR_NAME
from .web.pages import NEEDED
from .web.thumbnail_api import ThumbnailHandler, Thumbnails

CONNECTION = (
    {
        "type": "connection_options",
        "name": CONNECTOR_NAME,
        "connector": CONNECTOR,
        "custom_bindings": True,
    },
)
"""The panel for a board on the network, in OctoPrint 2.0 alone."""


class RrfModelPlugin(
    octoprint.plugin.StartupPlugin,
    octoprint.plugin.ShutdownPlugin,
    octoprint.plugin.EventHandlerPlugin,
    octoprint.plugin.SettingsPlugin,
    octoprint.plugin.AssetPlugin,
    octoprint.plugin.TemplatePlugin,
    octoprint.plugin.SimpleApiPlugin,
    Endpoints,
):
    """RepRapFirmware's object model, live inside OctoPrint."""

    def __init__(self):
        self.parts = Assembly(
            Host(
                printer=lambda: self._printer,
                profiles=lambda: self._printer_profile_manager,
                plugins=lambda: self._plugin_manager,
                settings=lambda: self._settings,
                users=lambda: self._user_manager,
                folder=self.get_plugin_data_folder,
                version=lambda: self._plugin_version,
                fire=eventManager().fire,
                tell_pages=self._tell_pages,
                files=lambda: self._file_manager,
                path_on_disk=lambda path: self._file_manager.path_on_disk("local", path),
            )
        )
        self._api = self.parts.api
        self._moonraker = self.parts.moonraker.api
        self._history = self.parts.history
        self._jobs = self.parts.prints.jobs
        self._console = self.parts.console
        self._setup = self.parts.setup

    def _tell_pages(self, message):
        names = NEEDED.get(message["type"], ())
        needed = [Permissions.PLUGIN_RRFMODEL_READ, *(getattr(Permissions, name) for name in names)]
        self._plugin_manager.send_plugin_message(self._identifier, message, permissions=needed)

    ##~~ OctoPrintPlugin

    def initialize(self):
        for network in self.parts.networks:
            network.register()

    def on_plugin_pending_uninstall(self):
        self.parts.setup.restore_all()

    def on_plugin_disabled(self):
        self.parts.setup.restore_all()

    ##~~ StartupPlugin, ShutdownPlugin

    def on_startup(self, host, port):
        self.parts.other_plugins.register(self)

    def on_after_startup(self):
        self.parts.start()

    def on_shutdown(self):
        self.parts.stop()

    ##~~ EventHandlerPlugin

    def on_event(self, event, payload):
        if event == DISABLED_PLUGIN and payload["id"] == self._identifier:
            self.parts.setup.restore_all()
        self.parts.on_event(event, payload)

    ##~~ SettingsPlugin

    def get_settings_defaults(self):
        return DEFAULTS

    def get_settings_version(self):
        return VERSION

    def get_settings_restricted_paths(self):
        return {"never": [["network", "passwords"], ["network", "hosts"]]}

    ##~~ AssetPlugin

    def get_assets(self):
        return assets_of(bool(self.parts.networks))

    ##~~ TemplatePlugin

    def get_template_configs(self):
        return [
            *(CONNECTION if self.parts.networks else ()),
            {
                "type": "sidebar",
                "name": gettext("RepRapFirmware"),
                "icon": "microchip",
                "custom_bindings": True,
            },
            {
                "type": "tab",
                # short, so that it finds room beside OctoPrint's own
                "name": gettext("RRF"),
                "custom_bindings": True,
                "data_bind": "visible: mayRead",
            },
            {"type": "navbar", "custom_bindings": True, "classes": ["rrfmodel-navbar"]},
            {"type": "generic", "template": "rrfmodel.jinja2", "custom_bindings": True},
            {"type": "settings", "name": gettext("RepRapFirmware"), "custom_bindings": False},
        ]

    def get_template_vars(self):
        return {"sidebar": list(DEFAULTS["sidebar"]), "has_network": bool(self.parts.networks)}

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
        return self.parts.commands.names()

    def on_api_command(self, command, data):
        return self.parts.commands.run(command, data)

    ##~~ octoprint.server.http.routes

    def routes(self, server_routes, *args, **kwargs):
        """Return what Tornado serves itself: who waits there holds up nobody."""
        from octoprint.server import app

        questions, model = self.parts.questions, self.parts.model
        live = {"questions": questions, "app": app}
        files = {**live, "files": self.parts.machine_files}
        folders = Folders(questions.ask_about_the_card, questions.changes_of_the_card)
        thumbnails = Thumbnails(questions, model)
        return [
            (r"/model/live", LiveModelHandler, live),
            (r"/heightmap", HeightMapHandler, live),
            (r"/bundle", BundleHandler, {**live, "archive": self.parts.bundle.archive}),
            (r"/machine_files", MachineFilesHandler, files),
            (r"/machine_file", MachineFileHandler, files),
            (r"/files", FolderHandler, {**live, "folders": folders}),
            (r"/thumbnail", ThumbnailHandler, {**live, "thumbnails": thumbnails}),
            *self.parts.moonraker.routes(app, folders, thumbnails, questions),
        ]

    ##~~ octoprint.plugin.softwareupdate.check_config

    def update_check(self, *args, **kwargs):
        return update_check(self._identifier, self._plugin_name, self._plugin_version)

    ##~~ octoprint.server.http.bodysize

    def body_sizes(self, current, *args, **kwargs):
        """Return how large uploads in Moonraker's form may be: as large as OctoPrint's own."""
        largest = self._settings.global_get_int(["server", "uploads", "maxSize"])
        return [("POST", r"/server/files/upload", largest)]

    ##~~ octoprint.server.api.before_request

    def before_request(self, *args, **kwargs):
        """Return what looks at each request to OctoPrint's API before it is answered."""
        return self.parts.refusals
