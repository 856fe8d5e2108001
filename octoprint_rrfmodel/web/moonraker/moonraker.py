"""All that is served in Moonraker's forms, put together."""

from functools import partial
from typing import Any, Callable, NamedTuple

from octoprint.events import Events, eventManager
from tornado.ioloop import IOLoop

from ...host.printer_news import PrinterNews
from ...host.streamed_job import StreamedJob
from .connection_methods import connection_methods
from .files import Files
from .gcode_store import GcodeStore
from .house_methods import house_methods
from .macro_files import MacroFiles
from .methods import Methods
from .moonraker_api import MoonrakerApi
from .own_port import OwnPort
from .printer_methods import printer_methods
from .printer_objects import PrinterObjects
from .restart_methods import restart_methods
from .scripts import GcodeScripts
from .server_methods import components_of
from .sockets import Sockets
from .tokens import OneshotTokens


class Parts(NamedTuple):
    """What others of the plugin's parts do for Moonraker's clients."""

    commands: Any
    """Commands to the machine (``control.machine_commands.MachineCommands``)."""
    samples: Callable[[float], Any]
    """Gives the samples of temperatures that are later than a time of day."""
    jobs: Any
    """The prints that are over (``web.jobs_api.JobHistory``)."""


class Moonraker:
    """Printer objects over HTTP and websocket, G-code of clients, and what was said.

    ``host`` is OctoPrint (``host.host.Host``), ``follower`` has the model, ``link`` leads to the
    board. ``notify("line", text)`` leaves a note for the worker, ``parts`` does what others do.
    """

    def __init__(self, host, follower, link, *, parts, notify, clock):
        self._host = host
        self._own_port = None
        self.job = StreamedJob()
        """OctoPrint's own job, which follows its events."""
        self.objects = PrinterObjects(
            follower, link, self.job.job, clock=clock, version=host.version
        )
        scripts = GcodeScripts(self.objects, link, parts.commands)
        self.store = GcodeStore(link, partial(notify, "line"))
        """What was said on the line; is told of each command that goes out."""
        tokens = self._tokens = OneshotTokens()
        self.sockets = Sockets(
            self.objects, lambda: methods, host.users, clock=clock, redeem=tokens.redeem
        )
        self.job.attach(self.sockets.announce)
        self.files = Files(host, link, lambda: follower.store.model, parts=parts)
        self.files.attach(self.sockets.tell, self.sockets.count)
        methods = Methods(
            (
                *printer_methods(
                    self.objects,
                    scripts,
                    self.store,
                    websocket_count=self.sockets.count,
                    components=lambda: components_of(methods),
                    refused=self.sockets.refused,
                ),
                *restart_methods(parts.commands),
                *connection_methods(),
                *house_methods(host, self.objects, self.sockets, tokens, parts),
                *self.files.rows(),
            )
        )
        scripts.attach(methods)
        self.api = MoonrakerApi(methods, tokens.redeem, self.sockets.find_user)

    def routes(self, app, folders, thumbnails, questions):
        """Return what Tornado serves itself; OctoPrint asks on the thread of Tornado's loop.

        ``app`` is OctoPrint's Flask application, ``folders`` are those of the board's card and
        ``thumbnails`` its pictures.
        """
        loop = IOLoop.current()
        macros = MacroFiles(self.objects.found_macros, loop, folders, questions=questions)
        self.objects.attach(macros.wait)
        files = self.files.routes(app, thumbnails, self._tokens.redeem)
        routes = [*self.sockets.routes(app), *files]
        self._own_port = OwnPort(loop, app, routes, sockets=self.sockets.open)
        return routes

    def start(self):
        """Begin to listen to OctoPrint, and to clients on a port of their own."""
        self.files.subscribe(eventManager())
        news = PrinterNews(
            current_data=self.job.on_printer_send_current_data, log=self.store.on_printer_add_log
        )
        self._host.printer().register_callback(news)
        self._host.users().register_login_status_listener(self.sockets)
        self._look_at_settings()

    def stop(self):
        """Leave the port."""
        if self._own_port is not None:
            self._own_port.look(False, "", 0)

    def on_event(self, event, payload):
        """Follow OctoPrint's job and the plugin's settings."""
        self.job.on_event(event, payload)
        if event == Events.SETTINGS_UPDATED:
            self._look_at_settings()

    def _look_at_settings(self):
        if self._own_port is None:
            return
        found = self._host.settings().get(["moonraker"], merged=True)
        # the dialog of settings writes numbers as text
        port = whole_of(found["port"])
        self._own_port.look(found["enabled"] is True, found["address"], port)


def whole_of(value):
    """Return a whole number, also of text; anything else as it is."""
    try:
        return int(value)
    except (TypeError, ValueError):
        return value
