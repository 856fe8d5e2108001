"""Finds out whether an ``ok`` that doesn't come was lost, before OctoPrint waits for half a minute.

Some errors have none (a line that is too long, a variable that is there already), and what isn't
read from USB for two seconds is gone. While a move waits for room the firmware reports every two
seconds (3.5 GCodes.cpp:4865), so that silence behind a plain line means loss. Then the board is
asked something, past OctoPrint's queue: the question's own ``ok`` is the one that OctoPrint waits
for. If the other one comes after all it comes first, and ``extra_ok`` takes it out. So a question
too many does no harm, whatever the board is busy with.

Behind a command that may take long nothing tells a loss from the command itself. There the board
is asked when patience is over (``patience``): OctoPrint would hang up next.
"""

from typing import NamedTuple

from ...rrf.gcode.blocking import BLOCKING
from ...rrf.gcode.doing import OTHER, what_of

SILENT_SECONDS = 4.0

TICK_SECONDS = 0.5


class Question(NamedTuple):
    """What the board can be asked at any time."""

    gcode: str
    answer: tuple[str, ...]
    """How a line begins that only this question brings."""


QUESTIONS = (
    Question("M105", ("ok T", "ok B", "ok C")),
    Question("M114", ("X:",)),
    Question("M115", ("FIRMWARE_NAME",)),
)
"""One after the other, so that each answer tells which question it belongs to."""

NEVER_ACKNOWLEDGED = frozenset(("M112", "M997", "M999"))
"""Commands that end the connection."""


class LostOk:
    """Asks where it has been silent for too long; ``tick`` is the worker's."""

    def __init__(self, link, clock):
        self._link = link
        self._clock = clock
        self._since = None
        self._asked = 0
        self._asked_at = 0.0

    def tick(self):
        """Ask what is due; return the seconds until there may be something to do again."""
        link, now = self._link, self._clock()
        comm, awaited, since = link.connection, link.awaited, link.awaited_since
        if comm is None or awaited is None:
            return TICK_SECONDS
        if since != self._since:
            self._since, self._asked, self._asked_at = since, 0, 0.0
        is_silent = now - max(since, link.heard_at, self._asked_at) >= SILENT_SECONDS
        if link.awaits_long:
            may_be_lost = link.given_up_on == since and awaited not in NEVER_ACKNOWLEDGED
        else:
            may_be_lost = _is_plain(awaited, link.awaited_command)
        if is_silent and may_be_lost and _waits(comm):
            self._ask(comm, awaited, now)
        return TICK_SECONDS

    def _ask(self, comm, awaited, now):
        questions = [each for each in QUESTIONS if each.gcode != awaited]
        if not _has_heat(comm):
            # it would be answered by nothing but an ok
            questions = [each for each in questions if each.gcode != "M105"]
        if self._asked >= len(questions):
            return
        question = questions[self._asked]
        self._asked += 1
        self._asked_at = now
        # first, for the answer may be quick
        self._link.extra_ok.asks(question.answer)
        comm._do_send(question.gcode, gcode=question.gcode)


def _is_plain(gcode, command):
    """Return whether a command is one that is through at once, or when there is room for it."""
    is_long = gcode in BLOCKING or gcode in NEVER_ACKNOWLEDGED
    return not is_long and what_of(command) == OTHER


def _waits(comm):
    """Return whether OctoPrint sends nothing before an ``ok`` comes."""
    is_uploading = comm.isStreaming() or comm._manualStreaming
    # not blocked(), which waits for a lock that OctoPrint takes for good when it hangs up
    return comm.isOperational() and not is_uploading and not comm._clear_to_send.is_set()


def _has_heat(comm):
    """Return whether the board has answered a status request with temperatures."""
    shown = comm.last_temperature
    return bool(shown.tools) or shown.bed[0] is not None
