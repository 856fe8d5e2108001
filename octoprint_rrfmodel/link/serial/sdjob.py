"""The print from the board's card: both sides' idea of it kept the same.

``cancel`` runs with whoever queues a command, ``situation`` and ``allow_opening`` on OctoPrint's
receiving thread, ``news`` on the worker.
"""

from ...host.version import IS_2
from ...rrf.card.wording import CANCEL, DONE, KNOWN, RESUMED, WITHHELD, Situation
from ...rrf.gcode.operations import Lines
from ...rrf.views.job import WITHOUT_JOB, CardJob, card_job
from .origin import PrintOrigin

PREFIX = "" if IS_2 else "/"
"""In front of names in OctoPrint's list of the card's files."""

END_JOB = "M400 M0"
"""Runs cancel.g, on one line: alone M0 is a command that OctoPrint keeps back, and for M400 it is
ready to wait."""

CANCEL_SECONDS = 60.0
"""Time after which a print that didn't pause is no longer waited for."""

END_SECONDS = 2.0
"""Time in which the firmware says how a print has ended, and that it has; it is one breath."""

ASTRAY_SECONDS = 5.0
"""How long the board has to print another file than OctoPrint shows: a job is there before the
model has its name."""


class SdJob:
    """Ends the board's job when OctoPrint's ends, and shows what is done to it at the machine.

    ``model()`` is the snapshot and ``is_current()`` whether it is newer than all that was sent.
    ``send(lines, tags)`` gives lines to OctoPrint's queue.
    """

    def __init__(self, model, is_current, send, *, clock):
        self._model = model
        self._is_current = is_current
        self._send = send
        self._clock = clock
        self._origin = PrintOrigin(model, is_current)
        self.forget()

    def forget(self):
        """Know of no job: another connection."""
        self._origin.forget()
        self._adopted = None
        self._cancelled_at = None
        self._asks_again = False
        self._withheld_at = None
        self._astray_at = None
        self._settled = CardJob()
        self._status = None
        """The last current ``state.status``."""

    def begins(self, comm):
        """Note that OctoPrint itself tells the board to begin."""
        self._origin.begins(comm)

    def is_foreign(self, comm):
        """Return whether the print that OctoPrint shows isn't its own, or was ended elsewhere."""
        return self._origin.is_foreign(comm)

    def is_others(self, comm, index):
        """Return whether the board has a job that OctoPrint has nothing to do with."""
        return self._origin.is_others(comm, lambda path: _is_selected(comm, index, path))

    def is_over(self, comm):
        """Return whether the print that OctoPrint shows has ended, which it is only yet to say."""
        return comm.isFinishing() or (comm.isCancelling() and self._origin.is_ended(comm))

    def cancel(self, gcode, comm=None):
        """Return what goes out in the place of a command by which OctoPrint cancels.

        On Marlin these stop reading the file. RepRapFirmware wants a job to be paused, then M0,
        which runs cancel.g. Without ``comm`` it isn't OctoPrint's idea, and is done.
        """
        is_ended = comm is not None and self._origin.is_ended(comm)
        if gcode == "M26" or (gcode == "M25" and is_ended):
            # M26 would set where the next print begins; and what has ended needs no end
            return Lines()
        if gcode != "M25":
            return None
        if comm is not None:
            self._origin.cancels(comm)
        self._cancelled_at = self._clock()
        self._asks_again = True
        if self._is_current() and card_job(self._model()).is_paused:
            return Lines((END_JOB,))
        # a pause may be put off, behind a tool change for example: M0 is then refused, and comes
        # again when the model says paused
        return Lines(("M25", END_JOB))

    @staticmethod
    def allow_opening(comm):
        """Let OctoPrint take a name as its own list has it, and take it more than once."""
        if comm._sdFileToSelect:
            # without the slash 1.11 doesn't find the file in its list
            comm._sdFileToSelect = PREFIX + comm._sdFileToSelect.lstrip("/")
        if IS_2 and not comm.isPrinting():
            # set when a print starts, and never taken back in 2.0 (serial_comm.py:3227)
            comm._ignore_select = False

    def situation(self, comm, index, opened, knows_file, is_telling):
        """Return what the words of a reply depend on.

        ``opened`` is alias and size of the file that was asked for. ``knows_file`` says whether
        the model tells which file is printed, ``is_telling`` whether OctoPrint hasn't heard all
        of the last news yet.
        """
        job = card_job(self._model())
        # a position that grows is a print of the selected file to OctoPrint unless it has one, and
        # a new one if it has paused; the status is there before the name of the file, so that only
        # the last news that were current count
        settled = self._settled
        is_other = knows_file and not (
            settled.is_active and _is_selected(comm, index, settled.path)
        )
        # between "File opened" and "File selected" OctoPrint already counts the new file's
        # progress, and would begin with the old file's name
        is_unknown = is_other or is_telling
        hides = (
            self._cancelled_at is not None or comm.isPaused() or (is_unknown and not comm.isBusy())
        )
        return Situation(
            opened,
            names_file=bool(comm._sdFileToSelect),
            shows_print=comm.isSdPrinting(),
            shows_pause=comm.isPaused() and comm.isSdFileSelected(),
            hides_print=hides,
            cancels=comm.isCancelling(),
            job=job,
        )

    def reworded(self, comm, worded):
        """Note what OctoPrint is told of a print's end; return lines that it hears behind that."""
        if worded == WITHHELD:
            self._withheld_at = self._clock()
            return ()
        if worded == KNOWN:
            # what comes from here on is another job, of the same file perhaps, and nobody's to end
            self._asks_again = False
            self._cancelled_at = None
        if worded not in (CANCEL, DONE, RESUMED):
            return ()
        self._withheld_at = None
        if worded == CANCEL:
            self._origin.ended_there(comm)
        return (DONE,) if worded == RESUMED else ()

    def look(self, comm):
        """Take in what the model says of the job, if that is newer than all that was sent."""
        if not self._is_current():
            self._settled = CardJob()
            self._status = None
            return
        self._settled = card_job(self._model())
        self._status = (self._model().get("state") or {}).get("status")
        self._origin.looks(comm, self._settled, self._status)

    def news(self, comm, index):
        """Follow the board; return lines that tell OctoPrint of what it can't know."""
        job = self._settled
        if self._withheld_at is not None and self._clock() - self._withheld_at > END_SECONDS:
            # nobody has said how it ended
            self._withheld_at = None
            return (DONE,) if comm.isSdPrinting() and not _is_between(comm) else ()
        if self._status is None:
            return ()
        cancelled_at = self._cancelled_at
        if cancelled_at is not None:
            self._finish_cancelling(job, cancelled_at)
        elif job.is_active:
            return self._follow(comm, index, job)
        else:
            self._adopted = None
            return self._tell_end(comm)
        return ()

    def _tell_end(self, comm):
        """Return what ends a paused print of OctoPrint's that was ended at the machine.

        One that goes on OctoPrint ends by itself, when it hears often enough that nothing is
        printed; while it is paused it doesn't count that.
        """
        is_over = self._status in WITHOUT_JOB
        return self._end(comm) if is_over and comm.isPaused() and comm.isSdFileSelected() else ()

    def _end(self, comm):
        """Return what ends OctoPrint's print, and lets nothing of that reach the board."""
        if self._origin.is_ended(comm):
            return ()
        self._origin.ended_there(comm)
        return (CANCEL,)

    def _finish_cancelling(self, job, cancelled_at):
        if not job.is_active or self._clock() - cancelled_at > CANCEL_SECONDS:
            self._cancelled_at = None
        elif job.is_paused and self._asks_again:
            self._asks_again = False
            self._send([END_JOB], set())

    def _follow(self, comm, index, job):
        if self._is_astray(comm, index, job):
            return self._end(comm)
        if comm.isSdFileSelected() and comm.isPaused():
            return (RESUMED,) if job.status == "processing" else ()
        if comm.isSdPrinting():
            is_steady = not _is_between(comm)
            return ("// action:paused",) if job.is_paused and is_steady else ()
        if comm.isBusy() or not comm.isOperational() or comm._sdFileToSelect:
            return ()
        return self._adopt(comm, index, job)

    def _is_astray(self, comm, index, job):
        """Return whether OctoPrint shows a print while the board has a job of another file."""
        shows = comm.isSdFileSelected() and comm.isBusy() and not _is_between(comm)
        if not (shows and index and job.path) or _is_selected(comm, index, job.path):
            self._astray_at = None
            return False
        if self._astray_at is None:
            self._astray_at = self._clock()
        return self._clock() - self._astray_at > ASTRAY_SECONDS

    def _adopt(self, comm, index, job):
        """Return what selects the file of a job that was started at the machine.

        OctoPrint then asks for its progress and takes a position that grows for a print.
        """
        alias = index.alias_of(job.path) if index else None
        if alias is None or self._adopted == job.path or not is_listed(comm, alias):
            return ()
        self._adopted = job.path
        if _is_selected(comm, index, job.path):
            return ()
        self.allow_opening(comm)
        # a plain list has no sizes
        size = index.file_of(alias).size or job.size
        return (f"File opened: {PREFIX}{alias} Size: {size}", "File selected")


def is_listed(comm, alias):
    """Return whether OctoPrint's own list has a file.

    2.0 looks for the file that it is told of in that list, and gives the connection up where it
    isn't there (connector.py:724).
    """
    return PREFIX + alias in comm._sdFiles and comm.isSdReady()


def _is_between(comm):
    """Return whether OctoPrint's print is on its way from one state to another."""
    return (
        comm.isStarting()
        or comm.isPausing()
        or comm.isResuming()
        or comm.isCancelling()
        or comm.isFinishing()
    )


def _is_selected(comm, index, path):
    """Return whether a file of the card is the one that OctoPrint would print."""
    alias = index.alias_of(path) if index else None
    if alias is None or not comm.isSdFileSelected():
        return False
    return comm._currentFile.getFilename() == PREFIX + alias
