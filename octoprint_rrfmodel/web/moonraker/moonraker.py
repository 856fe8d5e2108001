"""All that is served in Moonraker's forms, put together."""

from functools import partial

from ...host.streamed_job import StreamedJob
from .connection_methods import connection_methods
from .gcode_store import GcodeStore
from .methods import Methods
from .moonraker_api import MoonrakerApi
from .printer_methods import printer_methods
from .printer_objects import PrinterObjects
from .scripts import GcodeScripts
from .sockets import Sockets


class Moonraker:
    """Printer objects over HTTP and websocket, G-code of clients, and what was said.

    ``host`` is OctoPrint (``host.host.Host``), ``follower`` has the model, ``link`` leads to the
    board. ``notify("line", text)`` leaves a note for the worker, ``rate`` counts commands.
    """

    def __init__(self, host, follower, link, *, notify, rate, clock):
        self._host = host
        self.job = StreamedJob()
        """OctoPrint's own job, which follows its events."""
        self.objects = PrinterObjects(
            follower, link, self.job.job, clock=clock, version=host.version
        )
        scripts = GcodeScripts(self.objects.is_connected, link, rate)
        self.store = GcodeStore(link, partial(notify, "line"))
        """What was said on the line; is told of each command that goes out."""
        self.sockets = Sockets(self.objects, lambda: methods, host.users, clock=clock)
        self.job.attach(self.sockets.announce)
        methods = Methods(
            (
                *printer_methods(
                    self.objects, scripts, self.store, websocket_count=self.sockets.count
                ),
                *connection_methods(),
            )
        )
        self.api = MoonrakerApi(methods)

    def start(self):
        """Begin to listen to OctoPrint."""
        self._host.printer().register_callback(self.job)
        self._host.printer().register_callback(self.store)
        self._host.users().register_login_status_listener(self.sockets)
