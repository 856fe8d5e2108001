"""The job from the card that OctoPrint shows as its own, controlled as OctoPrint does it."""

CARD_JOB = {
    "pause": ("pause_print", lambda comm: comm.isPrinting()),
    "resume": ("resume_print", lambda comm: comm.isPaused()),
    "cancel": ("cancel_print", lambda comm: comm.isPrinting() or comm.isPaused()),
}
"""What is done to a job, to the method of OctoPrint's printer that does it to a print from the
card, and whether it does anything in the connection's state."""


def control_card_job(action, comm, printer, card):
    """Do something to a job that OctoPrint shows; return whether it was that job.

    ``comm`` is OctoPrint's connection, ``None`` without one, ``card`` the ``SdCard``.
    """
    method, does_it = CARD_JOB[action]
    # what it shows as its own print must not end behind its back: it would cancel whatever is
    # printed by then
    if comm is None or not comm.isSdFileSelected() or not does_it(comm):
        return False
    # and what it still has to say of one that is over is nothing to do with the next
    if card.is_over(comm):
        return False
    getattr(printer, method)()
    return True
