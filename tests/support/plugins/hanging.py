"""A plugin whose code waits where OctoPrint calls it, as one that asks a dead server does.

``POST /api/plugin/hanging``: ``hang`` with ``where``, ``messages`` of the plugin ``rrfmodel`` or a
G-code in the queuing phase; ``release`` ends it. ``GET`` tells what hangs right now.
"""

import threading

import flask
import octoprint.plugin

__plugin_name__ = "Hanging"
__plugin_pythoncompat__ = ">=3.9,<4"

LONGEST_SECONDS = 120
"""Time after which nothing hangs any more, whatever a test has forgotten."""

MESSAGES = "messages"


class Hanging(octoprint.plugin.StartupPlugin, octoprint.plugin.SimpleApiPlugin):
    def __init__(self):
        self._where = None
        self._hangs = []
        self._released = threading.Event()

    def on_after_startup(self):
        self._plugin_manager.register_message_receiver(self.on_message)

    def _hang(self, where):
        if where == self._where:
            self._hangs.append(where)
            self._released.wait(LONGEST_SECONDS)
            self._hangs.remove(where)

    def on_message(self, plugin, data, permissions=None):
        if plugin == "rrfmodel":
            self._hang(MESSAGES)

    def on_queuing(self, comm, phase, cmd, cmd_type, gcode, *args, **kwargs):
        self._hang(gcode)

    def get_api_commands(self):
        return {"hang": ["where"], "release": []}

    def is_api_protected(self):
        return True

    def on_api_command(self, command, data):
        if command == "hang":
            self._released.clear()
            self._where = data["where"]
        else:
            self._where = None
            self._released.set()

    def on_api_get(self, request):
        return flask.jsonify(hangs=self._hangs)


def __plugin_load__():
    global __plugin_implementation__, __plugin_hooks__
    __plugin_implementation__ = hanging = Hanging()
    __plugin_hooks__ = {"octoprint.comm.protocol.gcode.queuing": hanging.on_queuing}
