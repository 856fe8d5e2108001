"""OctoPrint's patience, fed while a command is awaited that may take long.

RepRapFirmware says nothing at all during most of them, for as long as they take
(``rrf.gcode.duration``), and OctoPrint hangs up on a silent printer after three minutes with its
default settings. It calls the received hook with an empty text when reading has timed out, and
takes what it gets in return for what the printer has said.
"""

from ...rrf.gcode.blocking import MOVES

STILL_BUSY = "echo:busy: rrfmodel"
"""What printers with a busy protocol say; OctoPrint begins all its timeouts anew and reads on."""

MINUTE = 60.0

LONGEST_MOVE_SECONDS = 15 * MINUTE
"""How long a single move may take, which the next one waits for."""

LEAVING_SECONDS = 1.0
"""Time that a command has from the hook to where OctoPrint waits for its ok."""


class Patience:
    """Answers for a board that is silent because it is busy; on OctoPrint's receiving thread.

    ``minutes()`` is how long a board may be silent and count as busy, 0 for as long as it likes.
    ``is_held()`` says whether the board waits for a person, who may take any time.
    """

    def __init__(self, link, minutes, is_held):
        self._link = link
        self._minutes = minutes
        self._is_held = is_held

    def feed(self, comm):
        """Return what OctoPrint is to hear in the place of nothing."""
        link = self._link
        # a move that waits for room reports nothing where reports go to another channel
        may_wait = link.own.report_elsewhere and link.awaited in MOVES
        if not (link.awaits_long or may_wait) or link.awaited is None:
            return ""
        if comm._clear_to_send.is_set() and link.silent_for() > LEAVING_SECONDS:
            # dropped on its way out, after the plugin's hook: nothing is awaited
            comm._long_running_command = False
            link.acknowledged()
            return ""
        limit = self._minutes() * MINUTE if link.awaits_long else LONGEST_MOVE_SECONDS
        if limit and link.silent_for() > limit and not self._is_held():
            # OctoPrint's own patience decides from here on; the board is asked first (``lost_ok``)
            link.given_up_on = link.awaited_since
            return ""
        return STILL_BUSY
