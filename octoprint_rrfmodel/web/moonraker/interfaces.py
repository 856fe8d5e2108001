"""Everything that serves the model to others, put together."""

from functools import partial

from octoprint.access.users import LoginStatusListener
from tornado.ioloop import IOLoop

from ...host.streamed_job import HostJobs
from ...integrations.octoprint_events import MachineEvents
from ...integrations.plugin_subscribers import UPDATED_HOOK, Audience
from .gcode_store import GcodeStore
from .moonraker_api import MoonrakerApi
from .printer_objects import PrinterObjects
from .scripts import GcodeScripts
from .subscribers import Subscribers
from .websocket import PrinterSocket, SocketHub

TICK_SECONDS = 1.0


class Interfaces(LoginStatusListener):
    """Printer objects over HTTP and websocket, events, and what other plugins are told.

    ``host`` is OctoPrint (``host.Host``), ``follower`` has the model, ``bridge`` knows the
    connection, ``rate`` counts commands. ``notify("said", line)`` lets the worker call
    ``heard(line)``, ``notify("send", lines, tags, force)`` send.
    """

    def __init__(self, host, follower, bridge, rate, notify, clock):
        self._host = host
        self._follower = follower
        self._model = follower.store.model
        self._events = MachineEvents(host.fire)
        self.audience = Audience(lambda: list(host.plugins().get_hooks(UPDATED_HOOK).values()))
        self._bridge = bridge
        self._notify = notify
        self._clock = clock
        self._ticked_at = 0.0
        self._loop = None
        self._is_announced = False
        self._hub = None
        self._jobs = HostJobs(self._announce)
        self.store = GcodeStore(lambda: bridge.is_rrf, bridge.has_polled, self._responded)
        self._scripts = GcodeScripts(self._is_connected, partial(notify, "send"), rate)
        self.objects = PrinterObjects(
            follower,
            self._is_connected,
            self._jobs.job,
            clock,
            host.version,
        )
        self.moonraker = MoonrakerApi(
            self.objects,
            self._scripts,
            self.store,
            lambda: len(self._sockets()),
        )

    def start(self):
        """Begin to listen to OctoPrint."""
        self._host.printer().register_callback(self._jobs)
        self._host.printer().register_callback(self.store)
        self._host.users().register_login_status_listener(self)
        self.audience.start()

    def stop(self):
        """Tell other plugins no more."""
        self.audience.stop()

    def routes(self, app):
        """Return what Tornado serves itself; OctoPrint asks on the thread of Tornado's loop."""
        self._loop = IOLoop.current()
        subscribers = Subscribers(self.objects.world, self._loop)
        self._hub = SocketHub(self.objects, self._scripts, subscribers, self._find_user)
        return [(r"/websocket", PrinterSocket, {"hub": self._hub, "app": app})]

    def on_event(self, event, payload):
        """Follow OctoPrint's own jobs."""
        self._jobs.on_event(event, payload)

    ##~~ on the worker

    def replied(self, taken):
        """Take what a reply did (``rrf.follower.Taken``)."""
        if taken.reset:
            self.objects.forget()
        self.objects.replied()
        self._events.replied(self._follower.store.model, self._follower.ready)
        self._tell(taken.changes)
        self._announce()

    def heard(self, line):
        """Take a line of text from the printer."""
        self.objects.heard(line)
        self._events.heard(line)

    def forgotten(self):
        """Note that nothing is known any longer."""
        self.objects.forget()
        self._events.forget()
        self._tell({})
        self._announce()

    def _tell(self, changes):
        before, self._model = self._model, self._follower.store.model
        # a reset or the end of a connection empties the model
        keys = changes if self._model else before
        if keys:
            self.audience.changed(before, self._model, keys)

    def tick(self):
        """Let sockets see what no reply tells, and look at who still may have one."""
        due = self._ticked_at + TICK_SECONDS - self._clock()
        if due > 0:
            return due
        self._ticked_at = self._clock()
        self._announce()
        self._on_loop("look_again")
        return TICK_SECONDS

    ##~~ LoginStatusListener

    def on_user_logged_out(self, user, stale=False):
        self._on_loop("logged_out", user)

    def on_user_modified(self, user):
        self._on_loop("look_again")

    ##~~ to Tornado's loop

    def _announce(self):
        """Let the sockets see what is new; many calls before they do are one."""
        if self._sockets() and not self._is_announced:
            self._is_announced = True
            self._loop.add_callback(self._changed)

    def _changed(self):
        self._is_announced = False
        self._hub.changed()

    def _responded(self, line):
        self._notify("said", line)
        self._on_loop("responded", line)

    def _on_loop(self, name, *arguments):
        if self._sockets():
            self._loop.add_callback(getattr(self._hub, name), *arguments)

    def _sockets(self):
        return self._hub.sockets if self._hub is not None else ()

    def _find_user(self, name):
        return self._host.users().find_user(name)

    def _is_connected(self):
        return self._host.printer().is_operational() and self._bridge.is_rrf
