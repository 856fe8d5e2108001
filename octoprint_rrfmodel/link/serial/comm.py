"""OctoPrint's serial hooks: look at a line, hand over, return.

The hooks run on a thread of OctoPrint's that the print waits for.
None of them decodes, waits, or raises.
"""

from ...host.tags import FILE_TAG, POLL_TAG, POLL_TYPE, STATUS_TAG
from ...rrf.card.wording import BEGINNINGS, LIST_BEGINS
from ...rrf.gcode.blocking import BLOCKING, SETTLING, TARGETING
from ...rrf.gcode.unsendable import GCODES as UNSENDABLE
from ...rrf.wire.errors import is_halted, is_serious
from ...rrf.wire.heard import TELLING, heard
from ...rrf.wire.line import VOLTAGE_WARNING, find_reply, without_warning
from .surplus import SurplusOk, count_ok
from .terminal import RecentPolls

ATTENDED = TELLING | {begins[0] for begins in (*BEGINNINGS, LIST_BEGINS)}
"""First letters of lines that are looked at; most lines begin otherwise and cost little."""


SWALLOWED = "// rrfmodel"
"""Stands for a line that was ours: counts as a sign of life and is parsed no further."""

STATUS_REQUEST = "M105"

EMERGENCY_STOP = "M112"

WATCHED = UNSENDABLE | {EMERGENCY_STOP}
"""Commands that are looked at wherever they come from."""


class CommBridge:
    """Knows OctoPrint's connection as far as polling needs to, and takes the replies out.

    ``notify(name, *arguments)`` is called with ``reply`` (text), ``refused`` (line),
    ``poll_sent`` (when), ``status_sent``, ``identified``, ``halted`` and ``heard`` (what);
    it must only take note and return. ``instead(cmd, gcode, tags)`` gives what to queue for
    a command that had better not be sent, ``None`` for others. ``guards(error)`` says whether a
    serious error only pauses the print.
    ``translate(cmd, gcode, tags)`` gives the lines to queue for a command that isn't a file's,
    ``None`` to leave it as it is. ``card.reword(line)`` gives a line in words that OctoPrint
    knows, ``card.fill()`` one in the place of a line that was the plugin's alone.
    ``show_target(heater, target)`` shows the target that a translated command sets.
    ``sent(cmd, tags)`` is told of commands that are neither a file's nor the plugin's polls.
    """

    def __init__(self, notify, translate, card, show_target, instead, guards, sent, clock):
        self._notify = notify
        self._translate = translate
        self._card = card
        self._show_target = show_target
        self._instead = instead
        self._guards = guards
        self._sent = sent
        self._clock = clock
        self._comm = None
        self._awaited = None
        self._asks_of_a_file = False
        self.tool_command_at = 0.0
        """When OctoPrint last sent a command that selects a tool."""
        self.target_command_at = 0.0
        """When OctoPrint last sent a command that gives a heater a target."""
        self._polled = RecentPolls()
        self._targets = {}
        self._surplus = SurplusOk()
        self.settled_at = 0.0
        """When the last command that blocks was through: older news of the machine may be wrong."""
        self.rewritten = 0
        """Commands of operations that went out otherwise than OctoPrint had them."""
        self.expects_refusal = False
        """Whether to look for the text that says that a polling command isn't known."""

    @property
    def connection(self):
        """OctoPrint's connection while a board with RepRapFirmware is at its other end."""
        return self._comm

    @property
    def is_rrf(self):
        """Whether the printer of this connection told that it runs RepRapFirmware."""
        return self._comm is not None

    def forget(self):
        """Know no printer: the connection is gone or not yet made."""
        self._comm = None
        self._awaited = None
        self._targets = {}
        self._surplus = SurplusOk()
        self.expects_refusal = False

    ##~~ octoprint.comm.protocol.firmware.info

    def on_firmware_info(self, comm, firmware_name, data, *args, **kwargs):
        """Find out whether this is RepRapFirmware; until then no line is touched.

        1.11 calls this for every line with a NAME in it, 2.0 once, and either may give no name:
        a connection that was known to be RepRapFirmware stays so.
        """
        if comm is self._comm:
            return
        self.forget()
        if "reprapfirmware" in (firmware_name or "").lower():
            self._comm = comm
            self._notify("identified")

    ##~~ octoprint.comm.protocol.gcode.received

    def on_received(self, comm, line, *args, **kwargs):
        """Return the line without the board's JSON, which goes to the worker."""
        if comm is not self._comm:
            return line
        if '{"' not in line:
            if line[:1] == "o" and self._surplus.awaits is None:
                if self._awaited is not None and line.startswith("ok"):
                    self._acknowledged()
                return line
            if (
                line[:1] in ATTENDED
                or self._surplus.awaits is not None
                or self.expects_refusal
                or self._card.is_talking
            ):
                return self._text(line)
            return line
        found = find_reply(line)
        if found is None or (found.is_of_a_file and not self._asks_of_a_file):
            return line
        self._notify("reply", found.reply)
        if not found.rest:
            return self._card.fill()
        if found.rest.startswith("ok"):
            self._acknowledged()
        return found.rest

    def _text(self, line):
        """Return a line that holds no JSON and is no plain ok, as OctoPrint is to read it."""
        if line[:1] in TELLING:
            told = heard(line)
            if told:
                self._notify("heard", told)
            if line.startswith(VOLTAGE_WARNING):
                # OctoPrint sees an ok only where a line starts with it, and waits half a minute
                line = without_warning(line)
        if self._surplus.awaits is not None and self._surplus.is_in(line):
            return SWALLOWED
        if line.startswith("ok"):
            self._acknowledged()
            return line
        if self.expects_refusal and ("M409" in line or "M408" in line):
            self._notify("refused", line)
            return line
        return self._card.reword(line)

    def _acknowledged(self):
        if self._awaited in SETTLING:
            self.settled_at = self._clock()
        self._awaited = None

    ##~~ octoprint.comm.protocol.gcode.queuing

    def on_queuing(
        self, comm, phase, cmd, cmd_type, gcode, subcode=None, tags=None, *args, **kwargs
    ):
        """Put an M105 behind each poll and in front of each command that blocks.

        The firmware's report during a blocking command goes where the last status request came
        from, and after M409 that is not this line (3.5 GCodes.cpp:4865). OctoPrint holds a lock
        while it queues the list, so that no other command gets in between.
        """
        if comm is not self._comm:
            return None
        if gcode is None:
            if not cmd.startswith("T"):
                return None
        elif gcode in WATCHED:
            instead = self._watched(cmd, gcode, tags or ())
            if instead is not None:
                return self._queue(instead, cmd_type, gcode)
        elif tags and FILE_TAG not in tags:
            if POLL_TAG in tags and gcode != STATUS_REQUEST:
                return [(cmd, POLL_TYPE), (STATUS_REQUEST,)]
            translated = self._translate(cmd, gcode, tags)
            if translated is not None:
                return self._queue(translated, cmd_type, gcode)
        if gcode is not None and gcode not in BLOCKING:
            return None
        return [(STATUS_REQUEST, None, {STATUS_TAG}), (cmd, cmd_type)]

    def _watched(self, cmd, gcode, tags):
        """Return what to queue instead; OctoPrint hangs up on an emergency stop."""
        if gcode == EMERGENCY_STOP:
            self._notify("halted")
            return None
        return self._instead(cmd, gcode, tags)

    def _queue(self, translated, cmd_type, gcode):
        """Return the lines of an operation in the hook's form."""
        if not translated.lines:
            return (None,)
        self.rewritten += 1
        if translated.heater:
            self._targets[translated.lines[-1]] = translated.heater, translated.target
        queued = [(line, cmd_type) for line in translated.lines]
        if gcode in BLOCKING:
            queued.insert(0, (STATUS_REQUEST, None, {STATUS_TAG}))
        return queued

    ##~~ octoprint.comm.protocol.gcode.sending

    def on_sending(
        self, comm, phase, cmd, cmd_type, gcode, subcode=None, tags=None, *args, **kwargs
    ):
        """Note what the printer is about to be busy with."""
        if comm is not self._comm:
            return None
        if gcode is None and cmd.startswith("T"):
            gcode = "T"  # T-1 is none to OctoPrint, and blocks as the others do
            count_ok(comm)
        self._awaited = gcode
        self._asks_of_a_file = gcode == "M36" and POLL_TAG in (tags or ())
        self._surplus.sending(cmd, gcode)
        if gcode in TARGETING or cmd in self._targets:
            self.target_command_at = self._clock()
        if cmd in self._targets:
            self._show_target(*self._targets.pop(cmd))
        if gcode in ("T", "M109"):
            self.tool_command_at = self._clock()
        if tags and FILE_TAG not in tags:
            if POLL_TAG not in tags:
                self._sent(cmd, tags)
            elif gcode == STATUS_REQUEST:
                self._notify("status_sent")
            else:
                self._polled.add(cmd)
                self._notify("poll_sent", self._clock())
        return None

    ##~~ octoprint.comm.protocol.gcode.error

    def on_error(self, comm, message, *args, **kwargs):
        """Return True for an error that is no reason to stop: a command was refused, no more.

        A halted board answers the very first command so, before it can say what it is. A serious
        one ends a print that isn't paused because of it; else there is nothing to end, and only
        a connection shows what is wrong.
        """
        if is_halted(message):
            ends = comm.isPrinting()
        elif comm is not self._comm:
            return False
        else:
            ends = is_serious(message) and comm.isPrinting() and not self._guards(message)
        if ends:
            # OctoPrint sends M112 and hangs up
            self._notify("halted")
        return not ends

    ##~~ what others ask

    def has_polled(self, command):
        """Return whether a command was a poll; also of earlier connections, for their log."""
        return command in self._polled

    def has_polled_at_all(self):
        """Return whether there is anything of the plugin's in OctoPrint's log."""
        return bool(self._polled)

    def blocked(self):
        """Return why no poll may go out, ``None`` where one may."""
        comm = self._comm
        if comm is None:
            return None
        if comm.isStreaming() or comm._manualStreaming:
            return "streaming"
        if self._awaited is None:
            # an unsolicited temperature lets OctoPrint think of heating; no ok would end that
            return None
        if comm._heating:
            return "heating"
        if comm._long_running_command or comm._dwelling_until or self._awaited in BLOCKING:
            return "long_command"
        return None

    def is_streaming_a_print(self):
        """Return whether OctoPrint sends a print's lines right now."""
        comm = self._comm
        return comm is not None and comm.isPrinting() and not comm.isSdFileSelected()

    def has_a_print(self):
        """Return whether OctoPrint prints, or has paused, a file of its own on this board."""
        comm = self._comm
        if comm is None or comm.isSdFileSelected():
            return False
        return comm.isPrinting() or comm.isPaused()

    def baudrate(self):
        """Return the line's rate in bits a second, 0 where it is unknown."""
        rate = self._comm.getConnection()[1] if self._comm is not None else 0
        return rate if isinstance(rate, int) else 0
