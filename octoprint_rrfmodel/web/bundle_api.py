"""``GET /plugin/rrfmodel/bundle``: a support bundle, made off Tornado's loop."""

import asyncio
import datetime
import logging
from concurrent.futures import Future

import tornado.web
from flask_babel import gettext
from octoprint.access.permissions import Permissions
from octoprint.server.util.flask import permission_validator
from octoprint.server.util.tornado import access_validation_factory

from ..host.own_thread import on_a_thread_of_its_own
from .live_api import LiveModelHandler

NAME = "rrfmodel-bundle-%Y%m%d-%H%M%S.zip"


class BundleHandler(LiveModelHandler):
    """Answers who may change settings; ``archive()`` returns the bundle."""

    def initialize(self, questions, app, archive):
        """Take what Tornado hands over from the route."""
        super().initialize(questions, app)
        self._archive = archive

    def prepare(self):
        """Let in who may change settings."""
        may_set = access_validation_factory(self._app, permission_validator, Permissions.SETTINGS)
        try:
            may_set(self.request)
        except tornado.web.HTTPError as error:
            self._refuse(error.status_code, gettext("You may not see OctoPrint's settings."))

    async def get(self):
        """Answer with the file, which nobody is to keep on the way."""
        made = Future()
        on_a_thread_of_its_own(_make, made, self._archive, name="rrfmodel.bundle")
        try:
            archive = await asyncio.wrap_future(made)
        except Exception:
            self._refuse(500, gettext("The bundle could not be made. OctoPrint's log says why."))
            return
        name = datetime.datetime.now().strftime(NAME)
        self.set_header("Content-Type", "application/zip")
        self.set_header("Content-Disposition", f'attachment; filename="{name}"')
        self.set_header("Cache-Control", "no-store")
        self.finish(archive)


def _make(made, archive):
    try:
        made.set_result(archive())
    except Exception as error:
        logging.getLogger("octoprint.plugins.rrfmodel.bundle").exception("Could not make a bundle")
        made.set_exception(error)
