"""``/plugin/rrfmodel/websocket``: printer objects for those who want each change."""

import itertools
import logging
from functools import partial

import tornado.websocket

from ...host.answers import RequestRefused
from ...rrf import klipper
from ..access import WithoutKeys, caller_of
from ..origin import is_own
from . import jsonrpc
from .jsonrpc import INVALID_PARAMS, METHOD_NOT_FOUND, REFUSED, RpcError

MOST_UNSENT = 4_000_000
"""Bytes that may wait for a reader; one that lets more pile up is dropped."""

LARGEST_MESSAGE = 100_000

POLICY_VIOLATION = 1008
TRY_AGAIN_LATER = 1013


class PrinterSocket(WithoutKeys, tornado.websocket.WebSocketHandler):
    """One client; everything here runs on Tornado's loop and nothing waits.

    ``hub`` knows all sockets, ``app`` is OctoPrint's Flask application, which knows users.
    """

    _ids = itertools.count(1)

    def initialize(self, hub, app):
        """Take what Tornado hands over from the route."""
        self._hub = hub
        self._app = app
        self._unsent = 0
        self._is_dropped = False
        self.id = next(self._ids)
        self.caller = None

    def prepare(self):
        """Let in who shows a key or a session and has READ: OctoPrint checks nothing here."""
        self.caller = caller_of(self._app, self.request, self._hub.find_user)
        if self.caller is None or not self.caller.may_read():
            self.set_status(403)
            self.finish({"error": "You may not read the machine's model."})

    def check_origin(self, origin):
        """Return whether a page may open this: any that has a key, of sessions only our own."""
        return not self.caller.is_of_session or is_own(self._app, self.request, origin)

    def open(self, *args, **kwargs):
        """Begin with nothing subscribed."""
        self.set_nodelay(True)
        self._hub.opened(self)

    def on_message(self, message):
        """Answer a call, or several."""
        if isinstance(message, bytes) or len(message) > LARGEST_MESSAGE:
            self.close(POLICY_VIOLATION, "Text of at most 100,000 characters, please")
            return
        answer = jsonrpc.respond(message, partial(self._hub.call, self))
        if answer is not None:
            self.send(answer)

    def on_close(self):
        """Forget the client."""
        self._hub.closed(self)

    def send(self, text):
        """Send without waiting; a client that doesn't read what it was sent is dropped."""
        if self._is_dropped:
            return
        size = len(text)
        if self._unsent + size > MOST_UNSENT:
            self._is_dropped = True
            self._hub.closed(self)
            # after some seconds without an answer Tornado cuts the connection
            self.close(TRY_AGAIN_LATER, "Too slow")
            return
        try:
            written = self.write_message(text)
        except tornado.websocket.WebSocketClosedError:
            return
        self._unsent += size
        written.add_done_callback(lambda future: self._on_written(future, size))

    def _on_written(self, written, size):
        self._unsent -= size
        written.exception()  # a connection that broke is told by on_close


class SocketHub:
    """Answers what sockets ask, and tells all of them what they didn't ask for.

    ``objects`` gives and describes the printer objects, ``scripts`` sends G-code, ``subscribers``
    keeps who wants what; ``find_user(name)`` is OctoPrint's.
    """

    def __init__(self, objects, scripts, subscribers, *, find_user):
        self._objects = objects
        self._scripts = scripts
        self._subscribers = subscribers
        self.find_user = find_user
        self.sockets = set()
        """Those that are open."""
        self._state = None
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.websocket")
        self._methods = {
            "server.info": (self._server_info, "may_read"),
            "server.connection.identify": (self._identify, "may_read"),
            "printer.info": (self._printer_info, "may_read"),
            "printer.objects.list": (self._list, "may_read"),
            "printer.objects.query": (self._query, "may_read"),
            "printer.objects.subscribe": (self._subscribe, "may_read"),
            "printer.gcode.script": (self._script, "may_control"),
            "printer.emergency_stop": (self._emergency_stop, "may_control"),
        }

    def opened(self, socket):
        """Note a new client."""
        if not self.sockets:
            self._state = self._objects.state()
        self.sockets.add(socket)

    def closed(self, socket):
        """Forget a client."""
        self.sockets.discard(socket)
        self._subscribers.unsubscribe(socket)

    def call(self, socket, method, params):
        """Return a method's result; raise ``RpcError``."""
        if method not in self._methods:
            raise RpcError(METHOD_NOT_FOUND, f"There is no method {method[:100]}.")
        run, permission = self._methods[method]
        if permission != "may_read" and not getattr(socket.caller, permission)():
            raise RpcError(REFUSED, "You may not do that. Ask an administrator.")
        try:
            return run(socket, params)
        except RequestRefused as error:
            code = INVALID_PARAMS if error.status == 400 else REFUSED
            raise RpcError(code, str(error)) from None

    def changed(self):
        """Tell the sockets what is new; called after each reply and each news of OctoPrint's."""
        if not self.sockets:
            return
        state = self._objects.state()
        if state != self._state:
            self._state = state
            method = KLIPPY_NOTIFICATIONS.get(state)
            if method:
                self._tell(jsonrpc.notification(method, []))
        self._subscribers.changed()

    def responded(self, line):
        """Tell the sockets a line that the printer said."""
        self._tell(jsonrpc.notification("notify_gcode_response", [line]))

    def logged_out(self, user):
        """Drop the sockets of a session that has ended."""
        for socket in self.sockets:
            socket.caller.logged_out(user)
        self.look_again()

    def look_again(self):
        """Drop those that may read no longer.

        OctoPrint says nothing when a user is deleted, a key revoked, or somebody changed who has
        no session: this has to be called from time to time.
        """
        for socket in list(self.sockets):
            try:
                may_read = socket.caller.may_read()
            except Exception:
                # users may come and go while they are looked through; the next look tells
                self._logger.exception("Could not look up a user")
                continue
            if not may_read:
                self.closed(socket)
                socket.close(POLICY_VIOLATION, "You may not read any longer")

    def _tell(self, text):
        for socket in list(self.sockets):
            socket.send(text)

    ##~~ methods

    def _server_info(self, socket, params):
        return self._objects.server_info(len(self.sockets))

    def _identify(self, socket, params):
        return {"connection_id": socket.id}

    def _printer_info(self, socket, params):
        return self._objects.printer_info()

    def _list(self, socket, params):
        return {"objects": self._objects.names()}

    def _query(self, socket, params):
        return self._objects.query(_wanted(params))

    def _subscribe(self, socket, params):
        status, eventtime = self._subscribers.subscribe(socket, _wanted(params))
        return {"eventtime": eventtime, "status": status}

    def _script(self, socket, params):
        self._scripts.run(params.get("script"))
        return "ok"

    def _emergency_stop(self, socket, params):
        self._scripts.emergency_stop()
        return "ok"


KLIPPY_NOTIFICATIONS = {
    "ready": "notify_klippy_ready",
    "shutdown": "notify_klippy_shutdown",
    "disconnected": "notify_klippy_disconnected",
}
"""What a state of the printer is announced as; the others aren't."""


def _wanted(params):
    try:
        return klipper.wanted_of(params.get("objects"))
    except ValueError as error:
        raise RpcError(INVALID_PARAMS, str(error)) from None
