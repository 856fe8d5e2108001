"""``GET /plugin/rrfmodel/server/files/ROOT/PATH``: files, and the pictures that are in them.

On Tornado's loop, which waits for no disk and for no board: Flask's answers are in memory whole.
"""

import asyncio
import mimetypes
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from urllib.parse import quote

import tornado.iostream
import tornado.web
from flask_babel import gettext
from octoprint.access.permissions import Permissions
from octoprint.server.util.flask import permission_validator
from octoprint.server.util.tornado import WsgiInputContainer, access_validation_factory

from ...host.answers import RequestRefused
from ...link.poll_slot import TooManyQueries
from ...rrf.card.listing import ROOT
from ...rrf.klipper.print_files import picture_wanted
from ..access import WithoutKeys
from .places import CARD, below

ROUTE = r"/server/files/(gcodes|printer)/(.+)"

NEEDED = ("PLUGIN_RRFMODEL_READ", "FILES_DOWNLOAD")
"""OctoPrint's names of the permissions."""

PIECE = 256 * 1024

SHOWN_SECONDS = 300
"""How long a client need not ask for a picture again."""


class DownloadHandler(WithoutKeys, tornado.web.RequestHandler):
    """Sends a file piece by piece.

    ``roots`` are ``Roots``, ``thumbnails`` the board's ``Thumbnails``, ``app`` is OctoPrint's Flask
    application, which knows users, ``redeem(token)`` gives whom a token stands for. ``executor``
    reads disks.
    """

    def initialize(self, roots, thumbnails, app, redeem, executor):
        """Take what Tornado hands over from the route."""
        self._roots = roots
        self._thumbnails = thumbnails
        self._app = app
        self._redeem = redeem
        self._executor = executor

    def prepare(self):
        """Let in who may have files; a deletion is Flask's, which looks at it by itself."""
        if self.request.method != "DELETE" and not self._may_download():
            self._refuse(403, gettext("You may not do that. Ask an administrator."))

    def _may_download(self):
        token = self.get_query_argument("token", None)
        if token is not None:
            caller = self._redeem(token)
            return caller is not None and all(map(caller.may, NEEDED))
        try:
            access_validation_factory(self._app, _validator)(self.request)
        except tornado.web.HTTPError:
            return False
        return True

    def write_error(self, status_code, **kwargs):
        """Tell what Tornado itself refuses, in the form of all errors here."""
        self.finish({"error": {"code": status_code, "message": f"{self._reason}."}})

    async def head(self, root, path):
        """Answer with the headers alone."""
        await self.get(root, path)

    async def get(self, root, path):
        """Answer with the file, or the picture that a path beside it stands for."""
        try:
            place = below(root, path) if picture_wanted(path) is None else None
            if place is None:
                await self._send_picture(root, picture_wanted(path))
            else:
                await self._send_file(place)
        except RequestRefused as refused:
            self._refuse(refused.status, str(refused))
        except (TooManyQueries, RuntimeError, asyncio.TimeoutError):
            self._refuse(504, gettext("The printer did not answer in time."))

    async def delete(self, root, path):
        """Leave it to the table of methods, which Flask serves."""
        await WsgiInputContainer(self._app.wsgi_app, executor=self._executor)(self.request, b"")
        self._finished = True

    async def _send_picture(self, root, wanted):
        place = below(root, wanted.file)
        if root == CARD:
            found = await self._thumbnails.of(f"{ROOT}/{place.path}")
        else:
            found = await self._off_loop(self._roots.own.picture, wanted._replace(file=place.path))
        if found is None:
            raise RequestRefused(404, gettext("This file has no picture that can be shown."))
        self.set_header("Content-Type", found.kind)
        self.set_header("X-Content-Type-Options", "nosniff")
        self.set_header("Cache-Control", f"private, max-age={SHOWN_SECONDS}")
        self.finish(found.data)

    async def _send_file(self, place):
        root = self._roots.of(place)
        found = await self._off_loop(root.find, place.path)
        if found is None or found.is_folder:
            raise RequestRefused(404, gettext("There is no such file."))
        self._describe(found)
        if self.request.method == "HEAD":
            self.finish()
            return
        file = await self._off_loop(root.open, found)
        try:
            while piece := await self._off_loop(file.read, PIECE):
                self.write(piece)
                await self.flush()
        except tornado.iostream.StreamClosedError:
            return
        finally:
            await self._off_loop(file.close)
        self.finish()

    def _describe(self, found):
        name = found.path.rpartition("/")[2]
        kind = mimetypes.guess_type(name)[0] or "application/octet-stream"
        self.set_header("Content-Type", "text/plain" if found.is_printable else kind)
        self.set_header("Content-Length", str(found.size))
        self.set_header("X-Content-Type-Options", "nosniff")
        self.set_header("Cache-Control", "private, no-cache")
        self.set_header("Content-Disposition", f"attachment; filename*=UTF-8''{quote(name)}")

    def _off_loop(self, function, *arguments):
        work = partial(function, *arguments)
        return asyncio.get_running_loop().run_in_executor(self._executor, work)

    def _refuse(self, status, text):
        if self._headers_written:
            # the client sees that it is not whole
            self.request.connection.stream.close()
            return
        self.clear()
        self.set_status(status)
        self.finish({"error": {"code": status, "message": text}})


def routes(roots, thumbnails, app, redeem):
    """Return what Tornado serves."""
    given = {
        "roots": roots,
        "thumbnails": thumbnails,
        "app": app,
        "redeem": redeem,
        "executor": ThreadPoolExecutor(4, "rrfmodel.files"),
    }
    return [(ROUTE, DownloadHandler, given)]


def _validator(request):
    for name in NEEDED:
        permission_validator(request, getattr(Permissions, name))
