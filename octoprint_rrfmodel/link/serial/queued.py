"""OctoPrint's hook about what is about to be queued, on the thread of whoever queues it.

Looks at tags and a G-code, hands over, returns; none of it waits.
"""

from ...host.tags import FILE_TAG, POLL_TAG, POLL_TYPE, STATUS_TAG
from ...rrf.gcode.blocking import BLOCKING
from ...rrf.gcode.duration import takes_long
from ...rrf.gcode.plain_lines import HOSTS_OWN, name_of
from ...rrf.gcode.quotes import has_odd_quote
from ...rrf.gcode.stops import STOPS, plain_stop
from ...rrf.gcode.unsendable import GCODES as UNSENDABLE
from ...rrf.gcode.unsendable import PAUSES
from ...rrf.wire.gcode_words import apart
from .box_answer import ANSWER
from .emergency import EMERGENCY_STOP
from .fitting import begin_a_line
from .own_commands import from_queue
from .script_filter import OF_PRINTS
from .serial_link import STATUS_REQUEST

WATCHED = UNSENDABLE | STOPS
"""Commands that are looked at wherever they come from, a file included."""

ATTENDED = WATCHED | PAUSES | BLOCKING | {EMERGENCY_STOP, None}
"""What lines of a file are looked at for, apart from quotes and stars."""


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
        self._reports_elsewhere = False

    ##~~ octoprint.comm.protocol.gcode.queuing

    def on_queuing(
        self, comm, phase, cmd, cmd_type, gcode, subcode=None, tags=None, *args, **kwargs
    ):
        """Put an M105 behind each poll and in front of each command that blocks.

        Where polls go alone it stands in front of any command that may take long.

        A poll is an M105 itself until it leaves (``sent``): other plugins take any other command
        for somebody at work, and never switch off what is idle.

        The firmware's report during a blocking command goes where the last status request came
        from, and after M409 that is not this line (3.5 GCodes.cpp:4865). OctoPrint holds a lock
        while it queues the list, so that no other command gets in between.
        """
        if comm is not self._link.connection:
            return None
        is_of_a_file = bool(tags) and FILE_TAG in tags
        if is_of_a_file and gcode not in ATTENDED and "*" not in cmd and '"' not in cmd:
            # nearly every line of a print
            return self._as_it_is(cmd, cmd_type, gcode) if self._reports_elsewhere else None
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
            if gcode not in WATCHED and not ('"' in cmd and has_odd_quote(cmd)):
                return self._as_it_is(cmd, cmd_type, gcode)
        if gcode in STOPS:
            # as CNC programs write it OctoPrint takes it for no place to pause at
            cmd = plain_stop(cmd) or cmd
            gcode = cmd[:2]
        if gcode == EMERGENCY_STOP:
            self._stopping(comm)
            return None
        if gcode == ANSWER and self._link.box.is_wanted():
            self._link.box.give(comm, cmd)
            return (None,)
        if _is_watched(cmd, gcode, is_of_a_file):
            instead = self._instead(cmd, gcode, tags or ())
            if instead is not None:
                return self._queue(instead, cmd_type, gcode)
        elif tags and not is_of_a_file:
            if POLL_TAG in tags:
                return self._poll(cmd)
            translated = self._translate(cmd, gcode, tags)
            if translated is not None:
                return self._queue(translated, cmd_type, gcode)
            lines = from_queue(cmd, gcode, tags)
            if lines is not None:
                return [(line, cmd_type) for line in lines]
        return self._as_it_is(cmd, cmd_type, gcode)

    def _poll(self, cmd):
        is_alone = self._link.polls_alone
        self._link.own.is_alone = is_alone
        self._report_elsewhere(is_alone)
        return [(cmd, POLL_TYPE)] if is_alone else [(cmd, POLL_TYPE), (STATUS_REQUEST,)]

    def _report_elsewhere(self, whether):
        self._reports_elsewhere = self._link.own.report_elsewhere = whether

    def _as_it_is(self, cmd, cmd_type, gcode):
        """Return a command with what has to go out in front of it."""
        if self._reports_elsewhere and gcode == STATUS_REQUEST:
            self._report_elsewhere(False)
        if not self._needs_reports(cmd, gcode):
            return None
        return [(STATUS_REQUEST, None, {STATUS_TAG}), (cmd, cmd_type)]

    def _needs_reports(self, cmd, gcode):
        """Return whether a status request has to stand in front of a command."""
        if not self._reports_elsewhere:
            return gcode in BLOCKING
        if gcode in BLOCKING or takes_long(cmd, gcode):
            self._report_elsewhere(False)
            return True
        return False

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
        if translated.lines[0].startswith(ANSWER) and self._link.box.is_wanted():
            # an answer to OctoPrint's own prompt
            self._link.box.give(self._link.connection, translated.lines[0])
            return (None,)
        if translated.heater:
            last = translated.lines[-1]
            self._link.targets[last] = translated.heater, translated.target
        queued = [(part, cmd_type) for line in translated.lines for part in apart(line)]
        is_hosts_own = translated.lines[0].startswith(HOSTS_OWN)
        if not is_hosts_own and self._needs_reports(translated.lines[0], gcode):
            queued.insert(0, (STATUS_REQUEST, None, {STATUS_TAG}))
        return queued


def _is_watched(cmd, gcode, is_of_a_file):
    """Return whether a command is one that may not go out as it is."""
    if gcode in WATCHED or "*" in cmd:
        return True
    if '"' in cmd and has_odd_quote(cmd):
        return True
    return is_of_a_file and gcode in PAUSES
