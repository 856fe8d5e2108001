"""``GET /plugin/rrfmodel/model/live``: the printer itself is asked, on Tornado's loop."""

import asyncio

import tornado.web
from flask_babel import gettext
from octoprint.access.permissions import Permissions
from octoprint.server.util.flask import permission_validator
from octoprint.server.util.tornado import access_validation_factory

from ..host.answers import RequestRefused
from ..link.poll_slot import TooManyQueries
from ..link.questions import refusal_to_send
from .access import WithoutKeys

WAIT_SECONDS = 10.0


class LiveModelHandler(WithoutKeys, tornado.web.RequestHandler):
    """Asks the printer for a key and returns what it answered; never holds a Flask thread.

    ``questions`` are ``Questions``, ``app`` is OctoPrint's Flask application, which knows
    users.
    """

    def initialize(self, questions, app):
        """Take what Tornado hands over from the route."""
        self._questions = questions
        self._app = app

    def prepare(self):
        """Let in who has READ: OctoPrint checks nothing for such routes."""
        may_read = access_validation_factory(
            self._app, permission_validator, Permissions.PLUGIN_RRFMODEL_READ
        )
        try:
            may_read(self.request)
        except tornado.web.HTTPError as error:
            self._refuse(error.status_code, "You may not read the machine's model.")

    async def get(self):
        """Answer in the firmware's envelope; 409 while polls are held back, 504 after 10 s."""
        key, flags = self._argument("key"), self._argument("flags")
        reason = refusal_to_send(key, flags)
        if reason:
            self._refuse(400, reason)
            return
        reason = self._questions.refusal()
        if reason:
            self._refuse(409, reason)
            return
        reply = await self._answer_of(self._model_reply(key, flags))
        if reply is not None:
            answer = {"key": reply.key, "flags": reply.flags or flags, "result": reply.result}
            if isinstance(reply.result, list):
                answer["next"] = reply.next
            self.write(answer)

    async def _model_reply(self, key, flags):
        future = asyncio.wrap_future(self._questions.ask(key, flags))
        return await asyncio.wait_for(future, WAIT_SECONDS)

    async def _answer_of(self, question):
        """Return what comes of a question, ``None`` after telling why nothing does."""
        try:
            return await question
        except TooManyQueries:
            self._refuse(503, gettext("Four questions wait for the printer. Try again soon."))
        except RequestRefused as error:
            self._refuse(error.status, str(error))
        except asyncio.TimeoutError:
            self._refuse(504, gettext("The printer did not answer in time."))
        except RuntimeError as error:
            self._refuse(504, gettext("The printer gave no answer: %(error)s.", error=error))
        return None

    def _argument(self, name):
        """Return an argument as it came; Tornado's own way takes control characters out."""
        values = self.request.query_arguments.get(name)
        return values[-1].decode("utf-8", errors="replace") if values else ""

    def _refuse(self, status, text):
        self.set_status(status)
        self.finish({"error": text})
