"""An emergency stop that doesn't wait for the hooks of other plugins."""

from ...host.own_thread import on_a_thread_of_its_own
from .fitting import begin_a_line

EMERGENCY_STOP = "M112"

HUNG_SECONDS = 0.5
"""Time that it may take OctoPrint to come to its own way of stopping: it writes, and hangs up."""

THREAD = "rrfmodel.stop"


def stop(link, tags, notify):
    """Have the board at the other end of ``link`` stopped, on a thread of its own.

    OctoPrint's way goes through the hooks of all plugins, and through a lock that one of them may
    hold. Where that takes long it is gone around: twice stopped is stopped.
    ``notify("halted", doing)`` only takes note.
    """
    on_a_thread_of_its_own(_stop, link, link.connection, tags, notify, name=THREAD)


def _stop(link, comm, tags, notify):
    # past all queues, as what OctoPrint streams is one
    stopping = on_a_thread_of_its_own(link.send, [EMERGENCY_STOP], tags, True, name=THREAD)
    stopping.join(HUNG_SECONDS)
    if stopping.is_alive() and comm is not None and not comm._connection_closing:
        notify("halted", link.doing())
        begin_a_line(comm)
        comm._trigger_emergency_stop()
