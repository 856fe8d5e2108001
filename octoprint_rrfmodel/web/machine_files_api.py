"""``/plugin/rrfmodel/machine_files`` and ``machine_file``: the machine's own files, to be changed.

Answered on Tornado's loop; the board is waited for on threads of their own.
"""

import asyncio
import json
from concurrent.futures import Future

import tornado.web
from flask_babel import gettext
from octoprint.access.permissions import Permissions
from octoprint.server.util import csrfRequestHandler
from octoprint.server.util.flask import permission_validator
from octoprint.server.util.tornado import access_validation_factory

from ..host.answers import RequestRefused
from ..host.own_thread import on_a_thread_of_its_own
from .live_api import LiveModelHandler

WAIT_SECONDS = 60.0
"""Twice a file is read and twice it is written, each with an end in sight."""


class _OfMachine(LiveModelHandler):
    """Lets in who may change settings; ``files`` are those in use."""

    def initialize(self, questions, app, files):
        """Take what Tornado hands over from the route."""
        super().initialize(questions, app)
        self._files = files

    def prepare(self):
        """Look at OctoPrint's token against foreign pages, then at the permission."""
        try:
            access_validation_factory(self._app, _validator)(self.request)
        except tornado.web.HTTPError as error:
            texts = {
                400: gettext("The CSRF token is missing."),
                403: gettext("You may not do that. Ask an administrator."),
            }
            self._refuse(error.status_code, texts.get(error.status_code, str(error)))

    async def _carried_out(self, name, *arguments):
        """Write the answer of one of the files' methods."""
        future = Future()
        future.set_running_or_notify_cancel()
        call = getattr(self._files, name)
        on_a_thread_of_its_own(_carry_out, future, call, arguments, name="rrfmodel.machine_files")
        question = asyncio.wait_for(asyncio.wrap_future(future), WAIT_SECONDS)
        answer = await self._answer_of(question)
        if answer is not None:
            self.write(answer if isinstance(answer, dict) else {"entries": answer})


class MachineFilesHandler(_OfMachine):
    """Lists a folder."""

    async def get(self):
        """Answer with the entries."""
        await self._carried_out("entries", self._argument("path"))


class MachineFileHandler(_OfMachine):
    """Reads and writes a file."""

    async def get(self):
        """Answer with its text and stamp."""
        await self._carried_out("read", self._argument("path"))

    async def put(self):
        """Write it, after a copy of what was there."""
        try:
            told = json.loads(self.request.body)
        except ValueError:
            told = None
        told = told if isinstance(told, dict) else {}
        path, stamp = told.get("path"), told.get("stamp")
        is_whole = isinstance(path, str) and (stamp is None or isinstance(stamp, str))
        if not is_whole or "text" not in told:
            self._refuse(
                400, gettext("Give path and text, and stamp if need be, as texts in JSON.")
            )
            return
        await self._carried_out("write", path, told["text"], stamp)


def _validator(request):
    csrfRequestHandler()
    permission_validator(request, Permissions.SETTINGS)


def _carry_out(future, call, arguments):
    try:
        future.set_result(call(*arguments))
    except RequestRefused as refused:
        future.set_exception(refused)
    except Exception as error:
        future.set_exception(RuntimeError(type(error).__name__))
        raise
