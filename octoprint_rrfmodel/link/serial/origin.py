"""Whose print OctoPrint shows: one that it began and that goes on, or one of the machine's.

Asked where a command is queued, noted there and on the worker.
"""

from ...rrf.views.job import WITHOUT_JOB, board_job

START_TAG = "trigger:comm.start_print"
"""OctoPrint's own, of the commands by which it begins a print from the card."""


class PrintOrigin:
    """Tells which prints OctoPrint may run something for.

    A print is known by the time at which OctoPrint began to show it: that is another one for each,
    and needs nobody who takes it back. ``model()`` is the snapshot and ``is_current()`` whether it
    is newer than all that was sent.
    """

    def __init__(self, model, is_current):
        self._model = model
        self._is_current = is_current
        self.forget()

    def forget(self):
        """Know of no print: another connection."""
        self._began = self._ended = self._seen = self._gone = self._cancelled = None

    def begins(self, comm):
        """Note that OctoPrint tells the board to begin the print that it shows."""
        self._began = _print_of(comm)

    def ended_there(self, comm):
        """Note that the print that OctoPrint shows was ended at the machine."""
        self._ended = _print_of(comm)

    def cancels(self, comm):
        """Note that OctoPrint tells the board to end the print that it shows."""
        self._cancelled = _print_of(comm)

    def looks(self, comm, job, status):
        """Note what current news say of the board's job."""
        shown = _print_of(comm)
        if job.is_active:
            self._seen = shown
        elif self._seen == shown and status in WITHOUT_JOB and status != "changingTool":
            # which a job may be in before 3.0 (2.05 RepRap.cpp, GetStatusCharacter)
            self._gone = shown

    def is_ended(self, comm):
        """Return whether the print that OctoPrint shows was ended at the machine."""
        shown = _print_of(comm)
        if shown is not None and self._ended == shown:
            return True
        # what OctoPrint ends itself is gone because of that
        if comm.isSdPrinting() and has_lost_it(comm) and self._cancelled != shown:
            # another job may begin before all that OctoPrint has to say is through
            self._ended = shown
            return True
        return False

    def is_gone(self, comm):
        """Return whether the board was seen without the job that OctoPrint shows, having had it."""
        shown = _print_of(comm)
        return shown is not None and self._gone == shown

    def is_others(self, comm, is_selected):
        """Return whether the board has a job that OctoPrint has nothing to do with.

        ``is_selected(path)`` says whether that is the file that OctoPrint would print.
        """
        job = board_job(self._model())
        if not job.is_active:
            return False
        if not comm.isSdFileSelected():
            return True
        if _begins_now(comm):
            # the last news may be of a job that is over
            return self._is_current()
        shown = _print_of(comm)
        if shown is None or self._began != shown or self.is_ended(comm):
            return True
        # by its status there is another run of the same file once the board was seen without
        return self.is_gone(comm) or (bool(job.path) and not is_selected(job.path))

    def is_foreign(self, comm):
        """Return whether the print that OctoPrint shows is none of its own, or no longer."""
        if not comm.isSdFileSelected() or _begins_now(comm):
            return False
        shown = _print_of(comm)
        return shown is None or self._began != shown or self.is_ended(comm)


def has_lost_it(comm):
    """Return whether OctoPrint has heard often enough that nothing is printed.

    It then ends the print by itself, and says so to the board as if it had been asked to.
    """
    return comm._consecutive_not_sd_printing > comm._consecutive_not_sd_printing_maximum


def _print_of(comm):
    """Return what one print of OctoPrint's is told from the next by, ``None`` without one."""
    file = comm._currentFile
    return None if file is None else file.getStartTime()


def _begins_now(comm):
    """Return whether OctoPrint is about to tell the board to begin.

    The script that comes before is queued first, and lies in front of it.
    """
    waiting = comm._job_queue
    with waiting.mutex:
        return any(START_TAG in entry[-1] for entry in waiting.queue)
