"""The paths below ``/plugin/rrfmodel`` that Flask serves; each answer checks the permission."""

import flask
from octoprint.plugin import BlueprintPlugin

from .meanings_api import get_meanings


class Endpoints(BlueprintPlugin):
    """Hands each request to the part that answers it.

    The class that inherits it has ``_api`` (``ModelApi``), ``_history`` (``MachineHistory``),
    ``_console`` (``console_api.Console``), ``_jobs`` (``JobHistory``),
    ``_setup`` (``host.setup.Setup``) and ``_moonraker`` (``MoonrakerApi``).
    """

    def is_blueprint_protected(self):
        return False  # READ may be granted to guests; each endpoint checks it

    def is_blueprint_csrf_protected(self):
        return True

    @BlueprintPlugin.route("/status", methods=["GET"])
    def get_status(self):
        return self._api.get_status(flask.request.args)

    @BlueprintPlugin.route("/model", methods=["GET"])
    def get_model(self):
        return self._api.get_model(flask.request.args)

    @BlueprintPlugin.route("/history", methods=["GET"])
    def get_history(self):
        return self._history.get_history(flask.request.args)

    @BlueprintPlugin.route("/jobs", methods=["GET"])
    def get_jobs(self):
        return self._jobs.get_jobs()

    @BlueprintPlugin.route("/console", methods=["GET"])
    def get_console(self):
        return self._console.get_console(flask.request.args)

    @BlueprintPlugin.route("/meanings", methods=["GET"])
    def get_meanings(self):
        return get_meanings()

    @BlueprintPlugin.route("/setup", methods=["GET"])
    def get_setup(self):
        return self._setup.get_setup()

    @BlueprintPlugin.route("/metrics", methods=["GET"])
    def get_metrics(self):
        return self._api.get_metrics()

    @BlueprintPlugin.route("/openapi.json", methods=["GET"])
    def get_openapi(self):
        return self._api.get_openapi()

    @BlueprintPlugin.route("/<path:path>", methods=["GET", "POST", "DELETE"])
    def respond_as_moonraker(self, path):
        return self._moonraker.respond(path)
