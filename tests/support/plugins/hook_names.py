"""A plugin that tells whose hooks a connection calls: ``/api/plugin/hook_names``."""

import flask
import octoprint.plugin

__plugin_name__ = "Names of hooks"
__plugin_pythoncompat__ = ">=3.9,<4"


class HookNames(octoprint.plugin.SimpleApiPlugin):
    def __init__(self):
        self._comm = None

    def on_received(self, comm, line, *args, **kwargs):
        self._comm = comm
        return line

    def is_api_protected(self):
        return True

    def on_api_get(self, request):
        comm = self._comm
        named = {"received": comm._received_message_hooks, **comm._gcode_hooks}
        return flask.jsonify({phase: sorted(hooks) for phase, hooks in named.items()})


__plugin_implementation__ = HookNames()
__plugin_hooks__ = {
    "octoprint.comm.protocol.gcode.received": __plugin_implementation__.on_received,
}
"""OctoPrint has no other way to a connection that is the same in both versions."""
