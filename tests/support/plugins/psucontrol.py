"""Stands in for PSUControl, which is on no package index: what it does with its sub-plugins.

A plugin registers itself; the one of the setting ``plugins.psucontrol.plugin`` is then asked for
the state and told to switch, by ``/api/plugin/psucontrol`` as in PSUControl itself.
"""

import flask
import octoprint.plugin

__plugin_name__ = "PSUControl"
__plugin_pythoncompat__ = ">=3.9,<4"


class PSUControl(octoprint.plugin.SettingsPlugin, octoprint.plugin.SimpleApiPlugin):
    def __init__(self):
        self._sub_plugins = {}

    def get_settings_defaults(self):
        return {"plugin": ""}

    def register_plugin(self, implementation):
        for name, known in self._plugin_manager.plugin_implementations.items():
            if known == implementation:
                self._sub_plugins[name] = implementation

    def is_api_protected(self):
        return True

    def on_api_get(self, request):
        return flask.jsonify(isPSUOn=self._chosen().get_psu_state())

    def get_api_commands(self):
        return {"turnPSUOn": [], "turnPSUOff": []}

    def on_api_command(self, command, data):
        chosen = self._chosen()
        switch = chosen.turn_psu_on if command == "turnPSUOn" else chosen.turn_psu_off
        try:
            switch()
        except Exception:
            self._logger.exception("Error while executing callback")

    def _chosen(self):
        return self._sub_plugins[self._settings.get(["plugin"])]


def __plugin_load__():
    global __plugin_implementation__, __plugin_helpers__
    __plugin_implementation__ = PSUControl()
    __plugin_helpers__ = {"register_plugin": __plugin_implementation__.register_plugin}
