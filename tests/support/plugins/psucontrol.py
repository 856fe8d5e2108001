"""Stands in for PSUControl, which is on no package index: what it does to machine and sub-plugins.

A plugin registers itself; the one of the setting ``plugins.psucontrol.plugin`` is then asked for
the state and told to switch, by ``/api/plugin/psucontrol`` as in PSUControl itself. It looks at
what is queued: with ``pseudo`` M80 and M81 switch and never reach a board, and ``idle`` seconds
after the last command that isn't M105 the supply is switched off.
"""

import threading

import flask
import octoprint.plugin
from octoprint.util import RepeatedTimer

__plugin_name__ = "PSUControl"
__plugin_pythoncompat__ = ">=3.9,<4"

IGNORED = ("M105",)
"""Its default of what is nobody at work."""

SENSE_SECONDS = 0.5
"""Five in PSUControl itself."""


class PSUControl(
    octoprint.plugin.SettingsPlugin,
    octoprint.plugin.SimpleApiPlugin,
    octoprint.plugin.StartupPlugin,
):
    def __init__(self):
        self._sub_plugins = {}
        self._is_on = False
        self._idle_timer = None
        self._calls = []

    def get_settings_defaults(self):
        return {"plugin": "", "pseudo": False, "idle": 0.0}

    def on_after_startup(self):
        RepeatedTimer(SENSE_SECONDS, self._sense).start()

    def register_plugin(self, implementation):
        for name, known in self._plugin_manager.plugin_implementations.items():
            if known == implementation:
                self._sub_plugins[name] = implementation

    def on_queuing(self, comm, phase, cmd, cmd_type, gcode, *args, **kwargs):
        name = gcode or cmd.split(" ", 1)[0]
        is_pseudo = self._settings.get_boolean(["pseudo"]) and name in ("M80", "M81")
        if is_pseudo:
            self._switch(name == "M80")
        if self._is_on and name not in IGNORED:
            self._wait_for_idleness()
        return (None,) if is_pseudo else None

    def is_api_protected(self):
        return True

    def on_api_get(self, request):
        return flask.jsonify(isPSUOn=self._chosen().get_psu_state(), calls=self._calls)

    def get_api_commands(self):
        return {"turnPSUOn": [], "turnPSUOff": []}

    def on_api_command(self, command, data):
        self._switch(command == "turnPSUOn")

    def turn_psu_on(self):
        self._switch(True)

    def turn_psu_off(self):
        self._switch(False)

    def get_psu_state(self):
        return self._is_on

    def _switch(self, on):
        self._calls.append(on)
        try:
            self._chosen().turn_psu_on() if on else self._chosen().turn_psu_off()
        except Exception:
            self._logger.exception("Error while executing callback")

    def _sense(self):
        was_on, self._is_on = self._is_on, bool(self._sub_plugins) and self._chosen_state()
        if self._is_on and not was_on:
            self._wait_for_idleness()
        elif was_on and not self._is_on:
            self._stop_waiting()

    def _wait_for_idleness(self):
        self._stop_waiting()
        seconds = self._settings.get_float(["idle"])
        if seconds:
            self._idle_timer = threading.Timer(seconds, self._switch_off_when_idle)
            self._idle_timer.daemon = True
            self._idle_timer.start()

    def _stop_waiting(self):
        if self._idle_timer is not None:
            self._idle_timer.cancel()

    def _switch_off_when_idle(self):
        if not (self._printer.is_printing() or self._printer.is_paused()):
            self._switch(False)

    def _chosen_state(self):
        return self._chosen().get_psu_state()

    def _chosen(self):
        return self._sub_plugins[self._settings.get(["plugin"])]


def __plugin_load__():
    global __plugin_implementation__, __plugin_helpers__, __plugin_hooks__
    __plugin_implementation__ = PSUControl()
    __plugin_helpers__ = {
        name: getattr(__plugin_implementation__, name)
        for name in ("register_plugin", "turn_psu_on", "turn_psu_off", "get_psu_state")
    }
    __plugin_hooks__ = {
        "octoprint.comm.protocol.gcode.queuing": __plugin_implementation__.on_queuing
    }
