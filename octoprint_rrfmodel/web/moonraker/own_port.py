"""A port of its own for clients that know no prefix: their requests, handed on below the prefix."""

import logging
import re
from concurrent.futures import ThreadPoolExecutor

from octoprint.server.util.tornado import (
    CustomHTTPServer,
    GlobalHeaderTransform,
    UploadStorageFallbackHandler,
    WsgiInputContainer,
)
from octoprint.settings import settings
from octoprint.util.net import usable_trusted_proxies_from_settings
from tornado.httputil import HTTPMessageDelegate, HTTPServerConnectionDelegate
from tornado.web import Application, RequestHandler

from ..access import WithoutKeys

PREFIX = "/plugin/rrfmodel"

HERE = re.compile(r"/(?:websocket|(?:server|printer|machine|access)(?:/|\?|$))")
"""What is handed on; all else isn't there, OctoPrint's own pages least of all."""

HIGHEST_PORT = 65535

GOING_AWAY = 1001

HEADERS = {"X-Robots-Tag": "noindex, nofollow, noimageindex", "X-Content-Type-Options": "nosniff"}
"""What OctoPrint's own server adds to each answer."""

UPLOAD = r"/server/files/upload"


class NotHere(WithoutKeys, RequestHandler):
    """Answers what isn't below one of the roots that Moonraker has."""

    def prepare(self):
        """Refuse any method."""
        self.set_status(404)
        message = "Only Moonraker's own addresses are here."
        self.finish({"error": {"code": 404, "message": message}})


class _BelowPrefix(HTTPMessageDelegate):
    """One request, told as if it had been asked for below the prefix."""

    def __init__(self, request):
        self._request = request

    def headers_received(self, start_line, headers):
        if HERE.match(start_line.path):
            start_line = start_line._replace(path=PREFIX + start_line.path)
        else:
            start_line = start_line._replace(path="/")
        return self._request.headers_received(start_line, headers)

    def data_received(self, chunk):
        return self._request.data_received(chunk)

    def finish(self):
        self._request.finish()

    def on_connection_close(self):
        self._request.on_connection_close()


class _Connections(HTTPServerConnectionDelegate):
    """Hands each request to an application, below the prefix."""

    def __init__(self, application):
        self._application = application

    def start_request(self, server_conn, request_conn):
        return _BelowPrefix(self._application.start_request(server_conn, request_conn))

    def on_close(self, server_conn):
        self._application.on_close(server_conn)


class OwnPort:
    """Listens where the settings say, if they do; started, changed and stopped from any thread.

    ``loop`` is Tornado's, ``app`` OctoPrint's Flask application, ``routes`` what the plugin has
    Tornado serve itself. Who may do what is looked up there as on OctoPrint's own port.
    ``sockets()`` are the clients' that are open, on whatever port.
    """

    def __init__(self, loop, app, routes, *, sockets):
        self._loop = loop
        self._app = app
        self._routes = routes
        self._sockets = sockets
        self._application = None
        self._server = None
        self._executor = None
        self._wanted = None
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.port")

    def look(self, is_wanted, address, port):
        """Listen there from now on, or nowhere."""
        self._loop.add_callback(self._look, (address, port) if is_wanted else None)

    def _look(self, wanted):
        if wanted == self._wanted:
            return
        self._close()
        self._wanted = wanted
        if wanted is not None and not self._listen(*wanted):
            # it may be free when the settings are next saved
            self._wanted = None

    def _close(self):
        if self._server is not None:
            self._server.stop()
            self._executor.shutdown(wait=False)
            self._loop.add_callback(self._server.close_all_connections)
            self._server = None
            for socket in self._sockets():
                if socket.application is self._application:
                    socket.close(GOING_AWAY, "This port is closed")

    def _listen(self, address, port):
        """Return whether it listens there."""
        if not isinstance(port, int) or not 0 < port <= HIGHEST_PORT:
            self._logger.error(
                "There is no port %s: Moonraker's clients get none of their own.", port
            )
            return False
        self._executor = ThreadPoolExecutor(thread_name_prefix="rrfmodel.port")
        self._application = self._make_application()
        server = CustomHTTPServer(_Connections(self._application), **_options())
        try:
            server.listen(port, address=address)
        except (OSError, UnicodeError) as error:
            self._executor.shutdown(wait=False)
            self._logger.error(
                "Moonraker's clients get no port of their own: %s on port %s can't be listened"
                " on (%s). Choose another in the settings of RepRapFirmware.",
                address,
                port,
                error,
            )
            return False
        self._server = server
        self._logger.info("Moonraker's clients have %s on port %s to themselves", address, port)
        return True

    def _make_application(self):
        below = rf"{PREFIX}/(?:server|printer|machine|access)(?:/.*)?"
        suffixes = {
            name: settings().get(["server", "uploads", f"{name}Suffix"])
            for name in ("name", "path")
        }
        fallback = WsgiInputContainer(
            self._app.wsgi_app, executor=self._executor, headers=HEADERS, removed_headers=["Server"]
        )
        uploads = {
            "fallback": fallback,
            "file_prefix": "octoprint-file-upload-",
            "file_suffix": ".tmp",
            "suffixes": suffixes,
        }
        own = [(PREFIX + route, handler, options) for route, handler, options in self._routes]
        handlers = [*own, (below, UploadStorageFallbackHandler, uploads), (r".*", NotHere)]
        transforms = [
            GlobalHeaderTransform.for_headers(
                "RrfModelHeaderTransform", headers=HEADERS, removed_headers=["Server"]
            )
        ]
        return Application(handlers, transforms=transforms)


def _options():
    """Return what OctoPrint's own server is made with."""
    largest = settings().getInt(["server", "uploads", "maxSize"])
    return {
        "max_body_sizes": [("POST", UPLOAD, largest)],
        "default_max_body_size": settings().getInt(["server", "maxSize"]),
        "xheaders": True,
        "trusted_downstream": usable_trusted_proxies_from_settings(settings()),
    }
