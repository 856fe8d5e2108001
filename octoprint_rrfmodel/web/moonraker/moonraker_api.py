"""Printer objects over HTTP, in Moonraker's forms; answered from what is known."""

import flask
from flask_babel import gettext
from octoprint.access.permissions import Permissions

from ...host.answers import RequestRefused, answer, may_read
from ...host.request_json import json_of
from ...rrf import klipper
from .gcode_store import MOST_LINES

KEY_ARGUMENT = "apikey"
"""OctoPrint's own argument, which is no object."""


def failure(status, text):
    """Return an error as Moonraker gives it."""
    return answer({"error": {"code": status, "message": text}}, status)


class MoonrakerApi:
    """Answers requests in Moonraker's forms.

    ``objects`` gives the printer objects, ``scripts`` sends G-code, ``store`` has what was said,
    ``websocket_count()`` is the number of open sockets.
    """

    def __init__(self, objects, scripts, store, *, websocket_count):
        self._objects = objects
        self._scripts = scripts
        self._store = store
        self._websocket_count = websocket_count

    def get_list(self):
        """Return the names of the objects that there are."""
        return self._read(lambda: {"objects": self._objects.names()})

    def get_query(self, arguments):
        """Return the objects that the arguments name; a bare name means all of its fields."""
        wanted = {
            name: fields.split(",") if fields else None
            for name, fields in arguments.items()
            if name != KEY_ARGUMENT
        }
        return self._read(lambda: self._objects.query(klipper.wanted_of(wanted)))

    def post_query(self, data):
        """Return the objects that a body names."""
        objects = data.get("objects") if isinstance(data, dict) else None
        return self._read(lambda: self._objects.query(klipper.wanted_of(objects)))

    def get_server_info(self):
        """Return what ``server.info`` answers."""
        return self._read(lambda: self._objects.server_info(self._websocket_count()))

    def get_printer_info(self):
        """Return what ``printer.info`` answers."""
        return self._read(self._objects.printer_info)

    def get_gcode_store(self, arguments):
        """Return the latest commands and responses."""
        count = arguments.get("count", str(MOST_LINES))
        if not (count.isascii() and count.isdigit() and len(count) < 10):
            if not may_read():
                return failure(403, gettext("You may not read the machine's model."))
            return failure(400, gettext("The count is a whole number of lines."))
        return self._read(lambda: {"gcode_store": self._store.latest(int(count))})

    def post_script(self, arguments, data):
        """Queue the lines of a script."""
        if not Permissions.PLUGIN_RRFMODEL_CONTROL.can():
            return failure(403, gettext("You may not do that. Ask an administrator."))
        script = data.get("script") if isinstance(data, dict) else None
        try:
            self._scripts.run(arguments.get("script", script))
        except RequestRefused as error:
            return failure(error.status, str(error))
        return answer({"result": "ok"})

    def _read(self, result):
        if not may_read():
            return failure(403, gettext("You may not read the machine's model."))
        try:
            return answer({"result": result()})
        except ValueError as error:
            return failure(400, str(error))


def body():
    """Return the request's JSON, ``None`` where it is none."""
    return json_of(flask.request, force=True)
