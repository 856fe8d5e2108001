"""The file that OctoPrint is about to print, looked through once for what would not get through."""

import json
import logging
import os

from octoprint.events import Events
from octoprint.filemanager import FileDestinations

from ..host.warning_texts import warning_text
from ..host.warnings import warning
from ..link.worker import Worker
from ..rrf.gcode.file_check import CHUNK, check, in_words

KEPT = "checked_files.json"
"""In the plugin's data folder: path to size, time and findings."""

MOST_KEPT = 500
"""Files of which it is known; those that were checked longest ago go."""

VERSION = 1
"""Of the table: another one may find more."""


class FileCheck:
    """Checks the selected file on a thread of its own and keeps what it has found.

    ``host`` is OctoPrint, ``link`` the line, ``tell(code, detail)`` reaches the pages. OctoPrint's
    events come on its thread, ``warnings`` may be called by any.
    """

    def __init__(self, host, link, tell):
        self._host = host
        self._link = link
        self._tell = tell
        self._worker = Worker("rrfmodel.file_check")
        self._worker.attach({"check": self._check})
        self._kept = None
        self._selected = None
        self._findings = {}
        self._told = None
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.file_check")

    def start(self):
        """Begin to work."""
        self._worker.start()

    def stop(self):
        """End the thread."""
        self._worker.stop()

    ##~~ OctoPrint's events

    def on_event(self, event, payload):
        """Look at the file that is selected now, and once more when it begins: it may be new."""
        if event == Events.FILE_DESELECTED:
            self._select(None)
        elif event in (Events.FILE_SELECTED, Events.PRINT_STARTED):
            is_own = payload.get("origin") == FileDestinations.LOCAL
            self._select(payload.get("path") if is_own else None)

    def _select(self, path):
        self._selected = path
        if path is None:
            self._findings, self._told = {}, None
        elif self._link.is_rrf:
            self._worker.notify("check", path)

    ##~~ a listener

    def identified(self):
        """Look at the file that was selected before there was a machine that it concerns."""
        path = self._selected
        if path is not None:
            self._worker.notify("check", path)

    ##~~ any thread

    def warnings(self):
        """Return what is wrong with the selected file, in the form of the public contract."""
        if not self._link.is_rrf:
            return []
        return [warning(code, _values(lines)) for code, lines in self._findings.items()]

    ##~~ its own thread

    def _check(self, path):
        try:
            findings = self._findings_of(path)
        except OSError as error:
            self._logger.warning("Could not check %s: %s", path, error)
            findings = {}
        if path == self._selected:
            self._findings = findings
            self._say()

    def _say(self):
        findings = self._findings
        told = self._selected, repr(findings)
        if not findings or not self._link.is_rrf or told == self._told:
            return
        self._told = told
        sentences = (warning_text(code, _values(lines)) for code, lines in findings.items())
        self._tell("file_checked", " ".join(sentences))

    def _findings_of(self, path):
        """Return what was found in a file, now or when it was checked as it is now."""
        on_disk = self._host.path_on_disk(path)
        state = os.stat(on_disk)
        mark = [VERSION, state.st_size, state.st_mtime_ns]
        kept = self._known()
        if path in kept and kept[path]["mark"] == mark:
            return kept[path]["found"]
        with open(on_disk, "rb") as file:
            found = check(iter(lambda: file.read(CHUNK), b""))
        kept.pop(path, None)
        kept[path] = {"mark": mark, "found": found}
        for oldest in list(kept)[:-MOST_KEPT]:
            del kept[oldest]
        self._keep(kept)
        return found

    def _known(self):
        if self._kept is None:
            try:
                with open(self._file(), encoding="utf-8") as file:
                    self._kept = dict(json.load(file))
            except (OSError, ValueError):
                self._kept = {}
        return self._kept

    def _keep(self, kept):
        try:
            with open(self._file(), "w", encoding="utf-8") as file:
                json.dump(kept, file)
        except OSError as error:
            self._logger.warning("Could not keep what was found: %s", error)

    def _file(self):
        return os.path.join(self._host.folder(), KEPT)


def _values(lines):
    return {"lines": in_words(lines)}
