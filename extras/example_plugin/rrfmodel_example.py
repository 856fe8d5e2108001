"""An OctoPrint plugin that builds on RepRapFirmware Model: a lamp for heaters with a fault.

It uses each of the helpers, the hook and an event. Copy this file into the folder ``plugins`` of
OctoPrint's base folder, restart, and look at ``/api/plugin/rrfmodel_example``.
"""

import flask
import octoprint.plugin
from octoprint.access.permissions import Permissions

__plugin_name__ = "RepRapFirmware Model Example"
__plugin_pythoncompat__ = ">=3.9,<4"

HEATERS = "heat.heaters"
FAULT_EVENT = "plugin_rrfmodel_heater_fault"


class RrfModelExample(
    octoprint.plugin.StartupPlugin,
    octoprint.plugin.ShutdownPlugin,
    octoprint.plugin.EventHandlerPlugin,
    octoprint.plugin.SimpleApiPlugin,
):
    """Lights a lamp, which is a line in OctoPrint's log, while a heater is faulty."""

    def __init__(self):
        self._rrf = {}
        self._unsubscribe = None
        self._is_lit = False
        self._faults_told = []
        self._keys_seen = set()
        self._answers = {}

    ##~~ StartupPlugin, ShutdownPlugin

    def on_after_startup(self):
        # helpers of other plugins are there once all plugins have been loaded
        helpers = self._plugin_manager.get_helpers("rrfmodel")
        if not helpers:
            self._logger.warning("RepRapFirmware Model isn't there, so there is nothing to watch")
            return
        self._rrf = helpers
        self._unsubscribe = helpers["subscribe"](HEATERS, self._on_heaters)

    def on_shutdown(self):
        if self._unsubscribe:
            self._unsubscribe()

    ##~~ what RepRapFirmware Model calls

    def _on_heaters(self, path, new, old):
        """Look at the heaters after each change of one of them; ``None`` without a model."""
        is_faulty = any(heater and heater["state"] == "fault" for heater in new or ())
        if is_faulty != self._is_lit:
            self._is_lit = is_faulty
            self._logger.info("The lamp is %s", "on" if is_faulty else "off")

    def on_updated(self, changed, model):
        """Note which top-level keys change; ``model`` is the whole model after the change."""
        self._keys_seen |= changed

    ##~~ EventHandlerPlugin

    def on_event(self, event, payload):
        if event == FAULT_EVENT:
            self._faults_told.append(payload["heater"])

    ##~~ SimpleApiPlugin

    def is_api_protected(self):
        return True

    def on_api_get(self, request):
        if not self._rrf:
            # nor are there its permissions
            return flask.jsonify({"installed": False})
        if not Permissions.PLUGIN_RRFMODEL_READ.can():
            flask.abort(403)
        return flask.jsonify(
            {
                "installed": True,
                "ready": self._rrf["status"]()["ready"],
                "lamp": self._is_lit,
                "faults_told": self._faults_told,
                "keys_seen": sorted(self._keys_seen),
                "machine": self._rrf["get"]("network.name", default="unknown"),
                "temperatures": list(self._rrf["get"](f"{HEATERS}[].current", default=())),
                "bed": self._rrf["objects"](["heater_bed"])["heater_bed"],
                "answers": self._answers,
            }
        )

    def get_api_commands(self):
        return {"ask": ["key"], "reset": ["heater"]}

    def on_api_command(self, command, data):
        if not self._rrf:
            flask.abort(409, "RepRapFirmware Model isn't there.")
        if not Permissions.PLUGIN_RRFMODEL_CONTROL.can():
            flask.abort(403)
        try:
            if command == "ask":
                self._ask(str(data["key"]))
            else:
                self._rrf["command"]("reset_heater_fault", heater=data["heater"])
        except ValueError as error:
            # the sentence is made for people
            flask.abort(409, str(error))
        return None

    def _ask(self, key):
        """Ask the printer itself; its answer is in the next GET, since nothing waits here."""

        def keep(future):
            error = future.exception()
            self._answers[key] = str(error) if error else future.result()

        self._rrf["query"](key).add_done_callback(keep)


def __plugin_load__():
    global __plugin_implementation__, __plugin_hooks__
    __plugin_implementation__ = RrfModelExample()
    __plugin_hooks__ = {
        "octoprint.plugin.rrfmodel.updated": __plugin_implementation__.on_updated,
    }
