"""The layers of a print that OctoPrint sends: by its file's comments and by how far it was sent.

The board isn't told of them. What has been sent is a few moves ahead of what is printed.
"""

import logging
import threading
import time

from octoprint.events import Events
from octoprint.filemanager import FileDestinations

from ..rrf.gcode.layer_marks import CHUNK, LayerMarks, layer_marks
from ..rrf.views.layers import MOST_LAYERS, Layer

ENDS = (Events.PRINT_DONE, Events.PRINT_CANCELLED, Events.PRINT_FAILED)


class StreamedLayers:
    """Follows OctoPrint's own print; any thread may ask.

    ``path_on_disk(path)`` is where a file is kept, ``job()`` is OctoPrint's print
    (``host.streamed_job``), ``link`` the line to the board, ``later(path)`` has ``scan`` called by
    a thread that may wait for it. No file is read that a printer of another firmware is sent.
    """

    def __init__(self, path_on_disk, job, link, *, later, now=time.time):
        self._path_on_disk = path_on_disk
        self._job = job
        self._link = link
        self._later = later
        self._now = now
        self._lock = threading.Lock()
        self._marks = LayerMarks()
        self._path = None
        self._done = []
        self._layer, self._since = 0, None
        self.began_at = None
        """When the print was begun; ``None`` before the first one."""
        self._logger = logging.getLogger("octoprint.plugins.rrfmodel.streamed_layers")

    def on_event(self, event, payload):
        """Note where a print begins that OctoPrint sends, and where it ends."""
        if event == Events.PRINT_STARTED:
            is_sent = payload.get("origin") == FileDestinations.LOCAL and self._link.is_rrf
            with self._lock:
                self._path = payload.get("path") if is_sent else None
                if is_sent:
                    self._marks, self._done = LayerMarks(), []
                    self._layer, self._since = 0, None
                    self.began_at = self._now()
            if self._path:
                self._later(self._path)
        elif event in ENDS:
            self.tick()
            with self._lock:
                self._path = None

    def scan(self, path):
        """Find the layers of a file, which takes a second for each hundred megabytes."""
        try:
            with open(self._path_on_disk(path), "rb") as file:
                marks = layer_marks(iter(lambda: file.read(CHUNK), b""))
        except OSError as error:
            self._logger.warning("Could not look for layers in %s: %s", path, error)
            return
        with self._lock:
            if path == self._path:
                self._marks = marks

    def tick(self):
        """Look how far the file was sent."""
        job = self._job()
        with self._lock:
            if self._path is None or job is None or job.name != self._path:
                return
            layer = self._marks.layer_at(job.position) if self._marks.count else 0
            spent = job.print_time
            if spent is None or layer == self._layer:
                return
            # how long one took that was seen only in part nobody knows
            if self._since is not None and layer > self._layer:
                self._finish(layer, spent - self._since)
            self._since = spent if self._layer or layer == 1 else None
            self._layer = layer

    def _finish(self, layer, seconds):
        count = layer - self._layer
        for number in range(self._layer, layer):
            height = self._marks.height_of(number)
            self._done.append(Layer(number, max(0.0, seconds) / count, height, None, self._now()))
        del self._done[:-MOST_LAYERS]

    def since(self, time):
        """Return the layers whose end was seen later than a time."""
        with self._lock:
            return [layer for layer in self._done if layer.at > time]

    def told(self):
        """Return where the print is, ``None`` without one or where its file tells no layers."""
        with self._lock:
            if self._path is None or not self._marks.count:
                return None
            return {
                "layer": self._layer,
                "layers": self._marks.count,
                "height": self._marks.height_of(self._layer),
            }
