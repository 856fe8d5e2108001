"""What stands in OctoPrint's queues and has not gone out yet.

A person clicks home and jog in one breath: when the jog is decided about, the home may not even
have left. The queues are OctoPrint's own, and looking is better than counting: OctoPrint empties
them when a print is cancelled, and other plugins drop commands on their way.
"""

from ...rrf.gcode.blocking import may_change
from ...rrf.gcode.plain_lines import name_of


def is_change_waiting(comm):
    """Return whether a command that may home, heat or choose tools waits in a queue."""
    return any(may_change(name_of(command), command) for command in _waiting(comm))


def _waiting(comm):
    """Give the commands that are to be sent, then those that a print holds back.

    An entry is what the queue was given, a command and how to send it, with its type. A marker is
    no command; one alone stands at the end of a connection.
    """
    for queue in (comm._send_queue._send_queue, comm._command_queue):
        with queue.mutex:
            entries = list(queue.queue)
        for given, *_ in entries:
            if isinstance(given, tuple) and isinstance(given[0], str):
                yield given[0]
