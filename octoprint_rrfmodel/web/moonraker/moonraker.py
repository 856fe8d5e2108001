"""All that is served in Moonraker's forms, put together."""

from functools import partial
from typing import Any, Callable, NamedTuple

from octoprint.events import eventManager

from ...host.streamed_job import StreamedJob
from .connection_methods import connection_methods
from .files import Files
from .gcode_store import GcodeStore
from .house_methods import house_methods
from .methods import Methods
from .moonraker_api import MoonrakerApi
from .printer_methods import printer_methods
from .printer_objects import PrinterObjects
from .scripts import GcodeScripts
from .server_methods import components_of
from .sockets import Sockets
from .tokens import OneshotTokens


class Parts(NamedTuple):
    """What others of the plugin's parts do for Moonraker's clients."""

    rate: Any
    """Counts commands."""
    command: Callable[..., None]
    """Queues a command of the machine by its name; ``ValueError`` says why it is refused."""
    samples: Callable[[float], Any]
    """Gives the samples of temperatures that are later than a time of day."""
    run: Callable[[str, dict[str, Any]], Any]
    """Queues a command as ``command`` does; returns status and sentence of one that is refused."""
    jobs: Any
    """The prints that are over (``web.jobs_api.JobHistory``)."""


class Moonraker:
    """Printer objects over HTTP and websocket, G-code of clients, and what was said.

    ``host`` is OctoPrint (``host.host.Host``), ``follower`` has the model, ``link`` leads to the
    board. ``notify("line", text)`` leaves a note for the worker, ``parts`` does what others do.
    """

    def __init__(self, host, follower, link, *, parts, notify, clock):
        self._host = host
        self.job = StreamedJob()
        """OctoPrint's own job, which follows its events."""
        self.objects = PrinterObjects(
            follower, link, self.job.job, clock=clock, version=host.version
        )
        scripts = GcodeScripts(self.objects.is_connected, link, parts.rate)
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
                ),
                *connection_methods(),
                *house_methods(host, self.objects, self.sockets, tokens, parts),
                *self.files.rows(),
            )
        )
        self.api = MoonrakerApi(methods, tokens.redeem, self.sockets.find_user)

    def routes(self, app, thumbnails):
        """Return what Tornado serves itself; ``thumbnails`` fetches the pictures of the card."""
        files = self.files.routes(app, thumbnails, self._tokens.redeem)
        return [*self.sockets.routes(app), *files]

    def start(self):
        """Begin to listen to OctoPrint."""
        self.files.subscribe(eventManager())
        self._host.printer().register_callback(self.job)
        self._host.printer().register_callback(self.store)
        self._host.users().register_login_status_listener(self.sockets)
