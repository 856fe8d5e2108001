"""``/plugin/rrfmodel/websocket``: printer objects for those who want each change."""

from __future__ import annotations

import itertools
import logging
from functools import partial
from typing import Any, NamedTuple

import tornado.websocket
from flask_babel import gettext

from ...host.answers import RequestRefused
from ...rrf.klipper import as_said
from ..access import WithoutKeys, caller_of, caller_of_key
from ..origin import is_own
from . import jsonrpc
from .jsonrpc import INVALID_PARAMS, METHOD_NOT_FOUND, REFUSED, RpcError
from .methods import Call, run
from .printer_methods import EMERGENCY_STOP

MOST_UNSENT = 4_000_000
"""Bytes that may wait for a reader; one that lets more pile up is dropped."""

LARGEST_MESSAGE = 100_000

SHORT_MESSAGE = 1_000
"""Characters of a message that may be worked on at once if there is an emergency stop in it."""

READ = "PLUGIN_RRFMODEL_READ"

POLICY_VIOLATION = 1008
TRY_AGAIN_LATER = 1013


class PrinterSocket(WithoutKeys, tornado.websocket.WebSocketHandler):
    """One client, on Tornado's loop, where nothing waits; what it asks is worked on elsewhere.

    ``hub`` knows all sockets, ``app`` is OctoPrint's Flask application, which knows users.
    """

    _ids = itertools.count(1)

    def initialize(self, hub, app):
        """Take what Tornado hands over from the route."""
        self._hub = hub
        self._app = app
        self._unsent = 0
        self._is_dropped = self._has_token = False
        self.id = next(self._ids)
        self.caller = None
        self.is_named = False
        """Whether the client has said what it is, as all do that show a whole machine."""

    def prepare(self):
        """Let in who shows a key, a token or a session and has READ: OctoPrint checks nothing."""
        token = self.get_query_argument("token", None)
        self.caller = None if token is None else self._hub.redeem(token)
        self._has_token = self.caller is not None
        if not self._has_token:
            self.caller = self._without_token(token is not None)
        if self.caller is None or not self.caller.may_read():
            self.set_status(403)
            self.finish({"error": "You may not read the machine's model."})

    def _without_token(self, is_wrong):
        """Return who shows a key or a session; beside a token that is wrong only a key counts.

        KlipperScreen has its key in the place of a token, and as a key too.
        """
        caller = caller_of(self._app, self.request, self._hub.find_user)
        return None if is_wrong and caller is not None and caller.is_of_session else caller

    def check_origin(self, origin):
        """Return whether a page may open this: any that has a key or a token, of sessions only
        our own. A token was read by who shows it, which a page of another site can't make us do.
        """
        is_shown = self._has_token or not self.caller.is_of_session
        return is_shown or is_own(self._app, self.request, origin)

    def open(self, *args, **kwargs):
        """Begin with nothing subscribed."""
        self.set_nodelay(True)
        self._hub.opened(self)

    def act_for(self, key):
        """Do from now on what the owner of a key may; ``RequestRefused`` for who may not read."""
        caller = caller_of_key(self._app, self.request, key, self._hub.find_user)
        if caller is None or not caller.may_read():
            raise RequestRefused(403, gettext("The API key is unknown, or may not read the model."))
        self.caller = caller

    async def on_message(self, message):
        """Answer a call, or several; Tornado takes the next message when this one is answered."""
        if isinstance(message, bytes) or len(message) > LARGEST_MESSAGE:
            self.close(POLICY_VIOLATION, "Text of at most 100,000 characters, please")
            return
        work = partial(self._hub.respond, self, message)
        is_urgent = EMERGENCY_STOP in message and len(message) <= SHORT_MESSAGE
        answer = work() if is_urgent else await self._hub.run(work)
        if answer is not None:
            self._hub.answer(self, answer)

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


class Answer(NamedTuple):
    """What a message of a client's brings, worked out off the loop."""

    text: str | None
    """The answer itself, ``None`` where none is wanted."""
    subscribed: list[tuple[Any, Any]]
    """What is subscribed to with it, and the status that it tells of that."""


class Asking(NamedTuple):
    """A message that is worked on."""

    socket: PrinterSocket
    subscribed: list[tuple[Any, Any]]


class SocketHub:
    """Answers what sockets ask, and tells all of them what they didn't ask for.

    ``methods`` is the table of what can be asked (``Methods``), ``state()`` the printer's state in
    Klipper's words, ``subscribers`` keeps who wants what; ``find_user(name)`` is OctoPrint's.
    ``run(function)`` gives a future of its result, which it works out off the loop. ``redeem``
    gives whom a token stands for.
    """

    def __init__(self, methods, state, subscribers, *, find_user, run, redeem):
        self._methods = methods
        self._now = state
        self._subscribers = subscribers
        self.find_user = find_user
        self.run = run
        self.redeem = redeem
        self.sockets = set()
        """Those that are open."""
        self._state = None
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.websocket")

    def opened(self, socket):
        """Note a new client."""
        if not self.sockets:
            self._state = self._now()
        self.sockets.add(socket)

    def closed(self, socket):
        """Forget a client."""
        self.sockets.discard(socket)
        self._subscribers.unsubscribe(socket)

    def respond(self, socket, message):
        """Return the ``Answer`` to a message, off the loop; ``None`` for a socket that is gone."""
        if socket not in self.sockets:
            return None
        subscribed = []
        text = jsonrpc.respond(message, partial(self._call, Asking(socket, subscribed)))
        return Answer(text, subscribed)

    def answer(self, socket, answer):
        """Send an answer, on the loop; what is subscribed with it holds from then on."""
        if socket not in self.sockets:
            return
        for wanted, status in answer.subscribed:
            self._subscribers.subscribe(socket, wanted, status)
        if answer.text is not None:
            socket.send(answer.text)

    def _call(self, asking, method, params):
        """Return a method's result; raise ``RpcError``."""
        found = self._methods.named(method)
        if found is None:
            raise RpcError(METHOD_NOT_FOUND, f"There is no method {method[:100]}.")
        try:
            return run(found, Call(params, asking.socket.caller, asking))
        except RequestRefused as error:
            code = INVALID_PARAMS if error.status == 400 else REFUSED
            raise RpcError(code, str(error)) from None

    def changed(self):
        """Tell the sockets what is new; called after each reply and each news of OctoPrint's."""
        if not self.sockets:
            return
        state = self._now()
        if state != self._state:
            self._state = state
            method = KLIPPY_NOTIFICATIONS.get(state)
            if method:
                self.tell(jsonrpc.notification(method, []))
        self._subscribers.changed()

    def responded(self, line):
        """Tell the sockets a line that the printer said."""
        self.tell(jsonrpc.notification("notify_gcode_response", [as_said(line)]))

    def notify(self, method, params, permission, is_for_named=False):
        """Tell something to the sockets whose users have a permission.

        ``is_for_named``: to those of them alone whose clients have said what they are.
        """
        text = jsonrpc.notification(method, params)
        for socket in list(self.sockets):
            if (socket.is_named or not is_for_named) and self._may(socket, permission):
                socket.send(text)

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
            if self._may(socket, READ) is False:
                self.closed(socket)
                socket.close(POLICY_VIOLATION, "You may not read any longer")

    def _may(self, socket, permission):
        """Return whether a socket's user has a permission, ``None`` where nobody knows."""
        try:
            return socket.caller.may(permission)
        except Exception:
            # users may come and go while they are looked through; the next look tells
            self._logger.exception("Could not look up a user")
            return None

    def tell(self, text):
        """Send a notification to all."""
        for socket in list(self.sockets):
            socket.send(text)


KLIPPY_NOTIFICATIONS = {
    "ready": "notify_klippy_ready",
    "shutdown": "notify_klippy_shutdown",
    "disconnected": "notify_klippy_disconnected",
}
"""What a state of the printer is announced as; the others aren't."""
