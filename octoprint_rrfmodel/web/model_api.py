"""The HTTP endpoints that answer from what is known; none of them waits for the printer."""

import json
from pathlib import Path

import flask
from flask_babel import gettext

from ..host.answers import answer, may_read, refusal
from ..link.questions import why_empty
from ..rrf.metrics import CONTENT_TYPE, exposition
from ..rrf.model import m409

DESCRIPTION = Path(__file__).with_name("openapi.json")
"""The OpenAPI description of all endpoints."""


class ModelApi:
    """Answers requests from the cached model and the plugin's state.

    ``model()`` is the snapshot, ``status()`` the state, ``link`` the line to the board.
    ``audience`` is told who looks.
    """

    def __init__(self, model, status, link, *, audience):
        self._audience = audience
        self._link = link
        self._model = model
        self._status = status

    def get_status(self, arguments=None):
        """Return the plugin's state; a page tells in ``view`` what it shows."""
        if not may_read():
            return refusal(403, gettext("You may not read the machine's model."))
        view = (arguments or {}).get("view")
        if view is not None:
            self._audience.sees(view)
        return answer(self._status())

    def get_model(self, arguments):
        """Return what M409 would answer to the key and flags asked for."""
        if not may_read():
            return refusal(403, gettext("You may not read the machine's model."))
        model = self._model()
        if not model:
            return refusal(503, why_empty(self._link))
        key = arguments.get("key", "")
        flags = arguments.get("flags", "")
        self._audience.reads(key)
        return answer(m409.answer(model, key, flags))

    def get_metrics(self):
        """Return the model and the plugin's state in Prometheus' text format."""
        if not may_read():
            return refusal(403, gettext("You may not read the machine's model."))
        self._audience.scrapes()
        text = exposition(self._model(), self._status())
        return flask.Response(text, content_type=CONTENT_TYPE)

    def get_openapi(self):
        """Return the description of all this in OpenAPI's form."""
        if not may_read():
            return refusal(403, gettext("You may not read the machine's model."))
        description = json.loads(DESCRIPTION.read_text(encoding="utf-8"))
        description["info"]["version"] = self._status()["version"]
        return answer(description)
