"""Uploads to the printer's card, refused before they begin.

The firmware acknowledges no line between M28 and M29 (3.5 GCodeInput.cpp:20-55), and OctoPrint
waits for an ok after each: it would send a line every half minute.
"""

import flask
from flask_babel import gettext
from octoprint.access.permissions import Permissions
from octoprint.filemanager import FileDestinations

from ...host.answers import refusal
from ...host.request_json import json_of

UPLOAD, COMMAND = "api.uploadGcodeFile", "api.gcodeFileCommand"
"""Flask's names of the endpoints that a file can get to the printer by."""


class UploadRefusal:
    """Refuses uploads while ``link`` leads to a board with RepRapFirmware."""

    def __init__(self, link):
        self._link = link

    def refuse(self):
        """Return an answer for an upload to the printer, ``None`` for every other request."""
        request = flask.request
        if request.method != "POST" or request.endpoint not in (UPLOAD, COMMAND):
            return None
        if not self._link.is_rrf or not Permissions.FILES_UPLOAD.can():
            return None
        if request.endpoint == UPLOAD:
            is_refused = request.view_args.get("target") == FileDestinations.SDCARD
        else:
            # in 2.0 a file is copied or moved to the printer, or sent by the old name for that
            data = json_of(request)
            data = data if isinstance(data, dict) else {}
            is_refused = (
                data.get("command") == "uploadSd" or data.get("storage") == FileDestinations.SDCARD
            )
        return refusal(409, self._text()) if is_refused else None

    def on_upload(self, printer, filename, path, started, succeeded, failed, *args, **kwargs):
        """Let an upload that another plugin begins fail at once (1.11's hook)."""
        if not self._link.is_rrf:
            return None
        failed(filename, filename, 0)
        return filename

    @staticmethod
    def _text():
        return gettext(
            "RepRapFirmware takes no uploads over its serial port. Upload the file in the"
            " board's own web interface, or print it from OctoPrint's storage."
        )
