"""Prints on a board of the network: begun, paused and ended by OctoPrint, run by the board."""

from octoprint.events import Events
from octoprint.printer import JobProgress
from octoprint.printer.job import PrintJob

from ...host.own_thread import on_a_thread_of_its_own
from ...rrf.views.job import card_job, progress
from ...rrf.views.job_steps import OPERATIONAL
from ...rrf.views.printing import printing
from .card import CardRefused
from .reasons import card_sentence

TRANSFERRING = "TRANSFERRING_FILE"

GCODES = "0:/gcodes/"

OF_OCTOPRINT = "OctoPrint"
"""Folder into which OctoPrint's own files go before the board prints them."""


class Jobs:
    """The part of the printer that has a job."""

    is_through = False
    """Whether the last job was read to its end."""

    def supports_job(self, job):
        return job.storage in ("local", "printer")

    def set_job(self, job, *args, **kwargs):
        if job is not None:
            kwargs["user"] = kwargs.get("user") or job.owner
        super().set_job(job, *args, **kwargs)

    def select_of_board(self, path):
        """Select what the board prints by itself."""
        self.is_through = False
        name = path[len(GCODES) :] if path.startswith(GCODES) else path.lstrip("/")
        job = self.create_job(name)
        if job is None:
            size = card_job(self.network.model()).size
            display = name.rpartition("/")[2]
            job = PrintJob(storage="printer", path=name, display=display, size=size)
        self.set_job(job)

    def start_print(self, pos=None, user=None, tags=None, params=None, *args, **kwargs):
        self.side.later(self._start, user)

    def pause_print(self, user=None, tags=None, params=None, *args, **kwargs):
        self.side.later(self._tell_job, "M25", user)

    def resume_print(self, user=None, tags=None, params=None, *args, **kwargs):
        self.side.later(self._tell_job, "M24", user)

    def cancel_print(self, user=None, tags=None, params=None, *args, **kwargs):
        self.side.later(self._cancel, user)

    @property
    def job_progress(self):
        job = self.current_job
        if job is None or not (self.is_printing() or self.is_through):
            return None
        model = self.network.model()
        elapsed = (model.get("job") or {}).get("duration") or 0.0
        read = 1.0 if self.is_through else progress(model) or 0.0
        return JobProgress(
            job=job,
            progress=read,
            pos=job.size if self.is_through else card_job(model).position,
            elapsed=elapsed,
            cleaned_elapsed=elapsed,
            left_estimate=0.0 if self.is_through else printing(model).seconds_left,
        )

    ##~~ on the thread that tells

    def _start(self, user):
        job = self.current_job
        if job is None or self.side.steps.state != OPERATIONAL:
            return
        if job.storage == "printer":
            self.side.begin_own(f"{GCODES}{job.path}", user)
            return
        self.side.steps.state = TRANSFERRING
        self.side.set_state(TRANSFERRING)
        on_a_thread_of_its_own(self._bring, job, user, name="rrfmodel.upload")

    def _bring(self, job, user):
        """Bring a file of OctoPrint's own to the board, on a thread of its own."""
        path = f"{GCODES}{OF_OCTOPRINT}/{job.path.rpartition('/')[2]}"
        try:
            self.network.card.upload(job.path_on_disk, path, goes_first=True)
        except CardRefused as refused:
            self.side.later(self._not_brought, card_sentence(refused))
        else:
            self.side.later(self._brought, path, user)

    def _brought(self, path, user):
        if self.side.steps.state == TRANSFERRING:
            self.side.begin_own(path, user)

    def _not_brought(self, why):
        if self.side.steps.state == TRANSFERRING:
            self.network.notify("refused_operation", "not_brought", why)
            self._give_up()

    def _give_up(self):
        self.side.steps.state = OPERATIONAL
        self._listener.on_printer_job_cancelled(suppress_script=True)
        self.side.set_state(OPERATIONAL)

    def _tell_job(self, line, user):
        if self.is_printing():
            self.side.user = user
            self.network.link.send([line], ())

    def _cancel(self, user):
        if self.side.steps.state == TRANSFERRING:
            self.network.card.stop_uploads()
            self._give_up()
            return
        if not self.is_printing():
            return
        self.side.user = user
        lines = self.network.link.end_job()
        self.side.steps.ends(self.network.clock())
        self.trigger(Events.PRINT_CANCELLING, user)
        self.side.set_state("CANCELLING")
        self.network.link.send(lines, ())
