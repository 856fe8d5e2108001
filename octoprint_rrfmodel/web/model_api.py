"""The HTTP endpoints that answer from what is known; none of them waits for the printer."""

import json
from pathlib import Path

import flask
from flask_babel import gettext
from octoprint.access.permissions import Permissions

from ..rrf.metrics import CONTENT_TYPE, exposition
from ..rrf.model import m409
from ..rrf.wire.request import FLAGS_LENGTH, KEY_LENGTH

DESCRIPTION = Path(__file__).with_name("openapi.json")
"""The OpenAPI description of all endpoints."""


def answer(data, status=200):
    """Return data as compact JSON; Flask's own way may spread it over lines."""
    text = json.dumps(data, separators=(",", ":"))
    return flask.Response(text, status=status, mimetype="application/json")


def refusal(status, text):
    """Return an answer that says, in one sentence, what a person can do about it."""
    return answer({"error": text}, status)


def may_read():
    """Return whether the user of this request may read the model."""
    return Permissions.PLUGIN_RRFMODEL_READ.can()


class ModelApi:
    """Answers requests from the cached model and the plugin's state.

    ``model()`` is the snapshot, ``status()`` the state.
    """

    def __init__(self, model, status):
        self._model = model
        self._status = status

    def get_status(self):
        """Return the plugin's state."""
        if not may_read():
            return refusal(403, gettext("You may not read the machine's model."))
        return answer(self._status())

    def get_model(self, arguments):
        """Return what M409 would answer to the key and flags asked for."""
        if not may_read():
            return refusal(403, gettext("You may not read the machine's model."))
        model = self._model()
        if not model:
            return refusal(503, self.why_empty())
        key = arguments.get("key", "")
        flags = arguments.get("flags", "")
        return answer(m409.answer(model, key, flags))

    def get_metrics(self):
        """Return the model and the plugin's state in Prometheus' text format."""
        if not may_read():
            return refusal(403, gettext("You may not read the machine's model."))
        text = exposition(self._model(), self._status())
        return flask.Response(text, content_type=CONTENT_TYPE)

    def get_openapi(self):
        """Return the description of all this in OpenAPI's form."""
        if not may_read():
            return refusal(403, gettext("You may not read the machine's model."))
        description = json.loads(DESCRIPTION.read_text(encoding="utf-8"))
        description["info"]["version"] = self._status()["version"]
        return answer(description)

    def why_empty(self):
        """Return why no model is known."""
        status = self._status()
        if not status["connected"]:
            return gettext("No printer is connected, so no model is known. Connect it first.")
        if not status["is_rrf"]:
            return gettext("The connected printer has not said that it runs RepRapFirmware.")
        return gettext("The printer has not told its model yet. Try again in a few seconds.")


def refusal_to_send(key, flags):
    """Return why a key and flags can't be sent to the printer, ``None`` where they can."""
    if len(key) > KEY_LENGTH:
        return gettext("The key is longer than the 100 characters that the firmware takes.")
    if len(flags) > FLAGS_LENGTH:
        return gettext("The flags are longer than the 20 characters that the firmware takes.")
    if not (key + flags).isprintable() or not (key + flags).isascii():
        return gettext("Key and flags may hold only printable ASCII characters.")
    if ";" in key + flags:
        return gettext("Key and flags may hold no semicolon: G-code takes it for a comment.")
    return None
