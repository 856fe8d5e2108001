"""What lets the sockets see what is new, from whatever thread it comes."""

from octoprint.access.users import LoginStatusListener
from tornado.ioloop import IOLoop

from ...rrf.klipper import refusal
from . import jsonrpc
from .off_loop import OffLoop
from .subscribers import Subscribers
from .websocket import PrinterSocket, SocketHub

TICK_SECONDS = 1.0


class Sockets(LoginStatusListener):
    """Serves the websocket's route and hands news to Tornado's loop; a listener.

    ``objects`` gives the printer objects, ``methods()`` is the table of what can be asked,
    ``users()`` OctoPrint's user manager. ``redeem(token)`` gives whom a token stands for.
    """

    def __init__(self, objects, methods, users, *, clock, redeem):
        self._objects = objects
        self._methods = methods
        self._users = users
        self._clock = clock
        self._redeem = redeem
        self._watched = []
        self._each_second = []
        self._ticked_at = 0.0
        self._loop = None
        self._is_announced = False
        self._hub = None

    def routes(self, app):
        """Return what Tornado serves itself; OctoPrint asks on the thread of Tornado's loop."""
        self._loop = IOLoop.current()
        run = OffLoop(self._loop).run
        self._hub = SocketHub(
            self._methods(),
            self._objects.state,
            Subscribers(self._objects.world, self._loop, run),
            find_user=self.find_user,
            run=run,
            redeem=self._redeem,
        )
        return [(r"/websocket", PrinterSocket, {"hub": self._hub, "app": app})]

    def watch(self, news):
        """Have ``news()`` asked whenever anything may have changed, on the loop.

        It gives what there is to tell: names of notifications, each with its parameters.
        """
        self._watched.append(news)

    def each_second(self, method, params, permission):
        """Have those with a permission, whose clients are named, told ``params()`` each second.

        Some clients take silence for the end of a connection. Any thread calls it, and only while
        there is such a client.
        """
        self._each_second.append((method, params, permission))

    def count(self):
        """Return how many sockets are open."""
        return len(self._hub.sockets) if self._hub is not None else 0

    def open(self):
        """Return those that are open."""
        return list(self._hub.sockets) if self._hub is not None else []

    def announce(self):
        """Let the sockets see what is new; many calls before they do are one."""
        if self.count() and not self._is_announced:
            self._is_announced = True
            self._loop.add_callback(self._changed)

    def _changed(self):
        self._is_announced = False
        self._hub.changed()
        for news in self._watched:
            for method, params in news():
                self._hub.tell(jsonrpc.notification(method, params))

    ##~~ a listener

    def replied(self, taken, asked_at):
        """Let the sockets see what a reply has changed."""
        self.announce()

    def warmed(self, warmed):
        """Let the sockets see temperatures that a line has told."""
        self.announce()

    def reset(self):
        """Let the sockets see that the board began anew."""
        self.announce()

    def line(self, text):
        """Tell the sockets a line that the printer said."""
        self._on_loop("responded", text)

    def refused(self, text):
        """Tell the sockets of a script that was refused: many clients look at no answer."""
        self._on_loop("responded", refusal(text))

    def tell(self, method, params, permission):
        """Tell something to those who have one of OctoPrint's permissions; any thread."""
        self._on_loop("notify", method, params, permission)

    def forgotten(self):
        """Let the sockets see that nothing is known."""
        self.announce()

    def tick(self):
        """Let sockets see what no reply tells, and look at who still may have one."""
        due = self._ticked_at + TICK_SECONDS - self._clock()
        if due > 0:
            return due
        self._ticked_at = self._clock()
        self.announce()
        self._on_loop("look_again")
        # measured for those alone who are told
        if any(socket.is_named for socket in self.open()):
            for method, params, permission in self._each_second:
                self._on_loop("notify", method, params(), permission, True)
        return TICK_SECONDS

    ##~~ LoginStatusListener

    def on_user_logged_out(self, user, stale=False):
        self._on_loop("logged_out", user)

    def on_user_modified(self, user):
        self._on_loop("look_again")

    def _on_loop(self, name, *arguments):
        if self.count():
            self._loop.add_callback(getattr(self._hub, name), *arguments)

    def find_user(self, name):
        """Return OctoPrint's user of that name, ``None`` for nobody."""
        return self._users().find_user(name)
