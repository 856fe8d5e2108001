"""OctoPrint's hook about what is about to be queued, on the thread of whoever queues it.

Looks at tags and a G-code, hands over, returns; none of it waits.
"""

from ...host.tags import FILE_TAG, POLL_TAG, POLL_TYPE, STATUS_TAG
from ...rrf.gcode.blocking import BLOCKING
from ...rrf.gcode.plain_lines import HOSTS_OWN, name_of
from ...rrf.gcode.quotes import has_odd_quote
from ...rrf.gcode.stops import STOPS
from ...rrf.gcode.unsendable import GCODES as UNSENDABLE
from ...rrf.gcode.unsendable import PAUSES
from ...rrf.wire.gcode_words import apart
from .fitting import begin_a_line
from .own_commands import from_queue
from .script_filter import OF_PRINTS
from .serial_link import EMERGENCY_STOP, STATUS_REQUEST

WATCHED = UNSENDABLE | STOPS
"""Commands that are looked at wherever they come from, a file included."""


class QueuedCommands:
    """Gives each command the form in which it is to go out.

    ``notify("halted", doing)`` must only take note and return; ``doing`` is what the line waits
    for. ``instead(cmd, gcode, tags)`` gives what to queue for a command that had better not be
    sent. Each of ``translators`` is called ``(cmd, gcode, tags)`` and gives what to queue for a
    command that isn't a file's; ``None`` of any of them leaves it to the next, and in the end as
    it is. Of what OctoPrint runs for a print they are asked about each line, also about those that
    it takes for no command.
    """

    def __init__(self, link, notify, instead, *, translators):
        self._link = link
        self._notify = notify
        self._instead = instead
        self._translators = translators

    ##~~ octoprint.comm.protocol.gcode.queuing

    def on_queuing(
        self, comm, phase, cmd, cmd_type, gcode, subcode=None, tags=None, *args, **kwargs
    ):
        """Put an M105 behind each poll and in front of each command that blocks.

        A poll is an M105 itself until it leaves (``sent``): other plugins take any other command
        for somebody at work, and never switch off what is idle.

        The firmware's report during a blocking command goes where the last status request came
        from, and after M409 that is not this line (3.5 GCodes.cpp:4865). OctoPrint holds a lock
        while it queues the list, so that no other command gets in between.
        """
        if comm is not self._link.connection:
            return None
        if tags and not OF_PRINTS.isdisjoint(tags):
            translated = self._translate(cmd, gcode, tags)
            if translated is not None:
                return self._queue(translated, cmd_type, gcode)
        if gcode is None:
            if cmd.startswith(HOSTS_OWN):
                return None
            gcode = name_of(cmd)
            if not gcode:
                # means nothing to the board, and OctoPrint might wait for its ok
                return (None,)
            if gcode not in WATCHED and not has_odd_quote(cmd):
                return self._as_it_is(cmd, cmd_type, gcode)
        if gcode == EMERGENCY_STOP:
            self._stopping(comm)
            return None
        if _is_watched(cmd, gcode, tags):
            instead = self._instead(cmd, gcode, tags or ())
            if instead is not None:
                return self._queue(instead, cmd_type, gcode)
        elif tags and FILE_TAG not in tags:
            if POLL_TAG in tags:
                return [(cmd, POLL_TYPE), (STATUS_REQUEST,)]
            translated = self._translate(cmd, gcode, tags)
            if translated is not None:
                return self._queue(translated, cmd_type, gcode)
            lines = from_queue(cmd, gcode, tags)
            if lines is not None:
                return [(line, cmd_type) for line in lines]
        return self._as_it_is(cmd, cmd_type, gcode)

    def _as_it_is(self, cmd, cmd_type, gcode):
        """Return a command with what has to go out in front of it."""
        if gcode not in BLOCKING:
            return None
        return [(STATUS_REQUEST, None, {STATUS_TAG}), (cmd, cmd_type)]

    def _stopping(self, comm):
        """Have an emergency stop read at once; OctoPrint sends it by itself, and hangs up."""
        self._notify("halted", self._link.doing())
        begin_a_line(comm)

    def _translate(self, cmd, gcode, tags):
        for translate in self._translators:
            translated = translate(cmd, gcode, tags)
            if translated is not None:
                return translated
        return None

    def _queue(self, translated, cmd_type, gcode):
        """Return the lines of an operation in the hook's form."""
        if not translated.lines:
            return (None,)
        self._link.rewritten += 1
        if translated.heater:
            last = translated.lines[-1]
            self._link.targets[last] = translated.heater, translated.target
        queued = [(part, cmd_type) for line in translated.lines for part in apart(line)]
        if gcode in BLOCKING and not translated.lines[0].startswith(HOSTS_OWN):
            queued.insert(0, (STATUS_REQUEST, None, {STATUS_TAG}))
        return queued


def _is_watched(cmd, gcode, tags):
    """Return whether a command is one that may not go out as it is."""
    if gcode in WATCHED or "*" in cmd or has_odd_quote(cmd):
        return True
    return gcode in PAUSES and bool(tags) and FILE_TAG in tags
