"""The job that OctoPrint streams, as printer objects and others show it."""

from octoprint.events import Events
from octoprint.filemanager import FileDestinations

from ..rrf.klipper import HostJob

OUTCOMES = {
    Events.PRINT_DONE: "complete",
    Events.PRINT_CANCELLED: "cancelled",
    Events.PRINT_FAILED: "error",
}


class StreamedJob:
    """Follows OctoPrint's own job; OctoPrint calls from its threads, ``job()`` may be asked by any.

    What is attached is called when there is news.
    """

    def __init__(self):
        self._changed = None
        self._data = None
        self._last = None
        self._is_on = False
        self._file = "", None

    def attach(self, changed):
        """Have ``changed()`` called when there is news."""
        self._changed = changed

    def on_printer_send_current_data(self, data):
        """Take what OctoPrint tells its pages about the job (``PrinterNews``)."""
        self._data = data
        self._changed()

    def on_event(self, event, payload):
        """Note where a job begins and how it ends."""
        if event == Events.PRINT_STARTED:
            self._is_on = payload.get("origin") == FileDestinations.LOCAL
            # what OctoPrint tells its pages comes half a second later
            self._file = payload.get("path") or "", payload.get("size")
            self._last = None
        elif event in OUTCOMES and self._is_on:
            if event == Events.PRINT_FAILED and payload.get("reason") == "cancelled":
                return  # told once more as cancelled
            self._last = self._job(OUTCOMES[event])
            self._is_on = False
        else:
            return
        self._changed()

    def job(self):
        """Return the job as ``HostJob``; ``None`` before the first."""
        if not self._is_on:
            return self._last
        flags = (self._data or {}).get("state", {}).get("flags", {})
        is_paused = flags.get("paused") or flags.get("pausing")
        return self._job("paused" if is_paused else "printing")

    def _job(self, state):
        name, size = self._file
        progress = (self._data or {}).get("progress") or {}
        position = size if state == "complete" and size else progress.get("filepos")
        return HostJob(
            name=name,
            size=size,
            position=position or 0,
            print_time=progress.get("printTime"),
            state=state,
        )
