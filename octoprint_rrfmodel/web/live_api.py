"""``GET /plugin/rrfmodel/model/live``: the printer itself is asked, on Tornado's loop."""

import asyncio

import tornado.web
from flask_babel import gettext
from octoprint.access.permissions import Permissions
from octoprint.server.util.flask import permission_validator
from octoprint.server.util.tornado import access_validation_factory

from ..link.poll_slot import TooManyQueries
from .model_api import refusal_to_send

WAIT_SECONDS = 10.0

ATTEMPTS = 3
"""Times that a question about the card is asked: an answer may be lost, or there be no room."""

PAUSE_SECONDS = 0.3


class Refused(Exception):
    """A request that gets no answer; says the status and the sentence."""


class LiveQuestions:
    """Hands questions to the poller, as long as the printer can be asked.

    ``why_empty()`` says why no model is known.
    """

    def __init__(self, poller, bridge, follower, why_empty):
        self._bridge = bridge
        self._follower = follower
        self._poller = poller
        self._why_empty = why_empty

    def ask(self, key, flags):
        """Return a future of the printer's own answer; raise ``TooManyQueries`` when full."""
        return self._poller.query(key, flags)

    async def ask_about_the_card(self, request):
        """Return the answer, asked for again where the board gave none; 409 beside a print."""
        for attempt in range(1, ATTEMPTS + 1):
            # one may have begun meanwhile; whatever else is in the way goes by
            reason = self.refusal_for_a_print()
            if reason:
                raise Refused(409, reason)
            try:
                return await asyncio.wrap_future(self._poller.query_for(request))
            except RuntimeError:
                if attempt == ATTEMPTS:
                    raise
            await asyncio.sleep(PAUSE_SECONDS)

    def connections(self):
        """Return a number for the connection that is there now."""
        return self._poller.connections

    def changes_of_the_card(self):
        """Return what is another after each change of the card, as far as the board counts them.

        And for another board, or the same one after a reset, which begin to count anew.
        """
        counted = self._follower.store.model.get("seqs", {}).get("volChanges")
        return str((self._poller.connections, self._follower.resets, counted))

    def refusal_of_the_card(self):
        """Return why nothing can be asked about the card now, ``None`` where it can."""
        if self._bridge.is_rrf and self._follower.protocol == "M408":
            return gettext("Over USB the card can be read from RepRapFirmware 3.1 on.")
        return self.refusal_for_a_print() or self.refusal()

    def refusal_for_a_print(self):
        """Return why a print keeps the card from being asked about, ``None`` where none does."""
        if self._bridge.is_streaming_a_print():
            # reading a card takes its time, and the print's lines would wait
            return gettext("OctoPrint prints. Look at the machine's card afterwards.")
        return None

    def refusal(self):
        """Return why the printer can't be asked now, ``None`` where it can."""
        if not self._bridge.is_rrf:
            return self._why_empty()
        if self._follower.protocol == "M408":
            return gettext("This firmware has no M409 and can't be asked for a key.")
        if self._poller.blocked():
            return gettext("The printer is busy and can't be asked now. Try again later.")
        return None


class LiveModelHandler(tornado.web.RequestHandler):
    """Asks the printer for a key and returns what it answered; never holds a Flask thread.

    ``questions`` are ``LiveQuestions``, ``app`` is OctoPrint's Flask application, which knows
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
        except Refused as error:
            self._refuse(*error.args)
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
