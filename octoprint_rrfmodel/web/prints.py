"""What is kept of prints, whoever runs them: the last jobs, and the layers of one that is sent."""

from functools import partial

from ..host.kept_json import KeptJson
from ..link.worker import Worker
from .jobs_api import JobHistory
from .streamed_layers import StreamedLayers


class Prints:
    """Makes both, and the thread that may wait for the disk.

    ``host`` is OctoPrint, ``model()`` the snapshot, ``link`` the line to the board, ``sent()`` the
    print that OctoPrint sends.
    """

    def __init__(self, host, model, link, *, sent):
        self._disk = Worker("rrfmodel.jobs")
        later = self._disk.notify
        kept = KeptJson(host.folder, "jobs.json")
        self.jobs = JobHistory(model, link, kept, later=partial(later, "jobs"))
        self.layers = StreamedLayers(host.path_on_disk, sent, link, later=partial(later, "layers"))
        self.told = {"jobs": self.jobs.changes}
        """What the plugin's state tells of them, by member."""
        self._disk.attach({"jobs": self.jobs.keep, "layers": self.layers.scan})

    def start(self):
        """Take what was kept, and begin to work."""
        self.jobs.load()
        self._disk.start()

    def stop(self):
        """End the thread behind what is still to be written."""
        self._disk.stop()

    def on_event(self, event, payload):
        """Take what OctoPrint says of its prints."""
        self.jobs.on_event(event, payload)
        self.layers.on_event(event, payload)
