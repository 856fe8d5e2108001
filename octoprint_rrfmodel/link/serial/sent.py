"""OctoPrint's hook about what is about to leave, on the thread that sends a print's lines."""

from ...host.tags import FILE_TAG, POLL_TAG, POLL_TYPE
from ...rrf.gcode.blocking import MOVES, TARGETING
from ...rrf.gcode.plain_lines import HOSTS_OWN, name_of
from ...rrf.wire.gcode_words import KEEPS_MODES
from .extra_ok import count_ok
from .own_requests import POLL, STATUS


class SentCommands:
    """Notes what the board is about to be busy with.

    ``notify(name, *arguments)`` is called with ``poll_sent`` (when, with which line
    number) and ``poll_acknowledged``; it must only take note and return.
    ``show_target(heater, target)`` shows the target that a translated command sets.
    ``sent(cmd, tags)`` is told of commands that are neither a file's nor the plugin's polls.
    ``is_shown()`` says whether OctoPrint knows each tool and target: what it asks by its own clock
    is enough for the temperatures then.
    """

    def __init__(self, link, notify, clock, *, show_target, sent, is_shown=bool):
        self._link = link
        self._notify = notify
        self._clock = clock
        self._show_target = show_target
        self._sent = sent
        self._is_shown = is_shown

    ##~~ octoprint.comm.protocol.gcode.sending

    def on_sending(
        self, comm, phase, cmd, cmd_type, gcode, subcode=None, tags=None, *args, **kwargs
    ):
        """Note what the printer is about to be busy with; a poll takes its own form here.

        Until now it was an M105, as other plugins are to take it (``queued``).
        """
        link = self._link
        if comm is not link.connection:
            return None
        if gcode in MOVES and tags and FILE_TAG in tags and link.awaits_move(cmd, gcode, tags):
            # nearly every line of a print
            return None
        poll = link.take_asked() if cmd_type == POLL_TYPE else None
        if poll is not None:
            cmd, gcode = poll, name_of(poll).partition(".")[0]
        if gcode is None:
            gcode = "" if cmd.startswith(HOSTS_OWN) else name_of(cmd)
            if not gcode:
                # OctoPrint's own, or nothing: no board answers it
                if tags and FILE_TAG not in tags:
                    self._sent(cmd, tags)
                return None
            count_ok(comm)
        if link.awaited is not None:
            link.extra_ok.given_up()
        link.awaits(cmd, gcode, tags or ())
        now = link.awaited_since
        link.asks_of_a_file = gcode == "M36" and poll is not None
        if gcode == KEEPS_MODES or link.extra_ok.awaits is not None:
            link.extra_ok.sending(cmd, gcode)
        if gcode in TARGETING:
            link.target_command_at = now
        if link.targets and cmd in link.targets:
            link.target_command_at = now
            self._show_target(*link.targets.pop(cmd))
        if gcode in ("T", "M109"):
            link.tool_command_at = now
        if poll is not None:
            link.own.awaited = POLL if link.own.is_alone else None
            link.polled.add(cmd)
            # the number that it gets if it gets one, in both versions of OctoPrint
            self._notify("poll_sent", now, getattr(comm, "_current_line", None))
            return cmd
        if tags and FILE_TAG not in tags:
            if POLL_TAG not in tags:
                self._sent(cmd, tags)
            elif cmd_type != POLL_TYPE:
                # it leaves when OctoPrint has the ok of the poll in front of it
                link.own.awaited = STATUS if self._is_shown() else None
                self._notify("poll_acknowledged")
        return None
