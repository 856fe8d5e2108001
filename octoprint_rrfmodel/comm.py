"""OctoPrint's serial hooks: look at a line, hand over, return.

Every method but ``blocked`` and ``follow_tool`` runs on a thread of OctoPrint's that the print
waits for. None decodes, waits, or raises.
"""

from octoprint.events import Events
from octoprint.util.version import is_octoprint_compatible

from .rrf.blocking import BLOCKING
from .rrf.errors import is_halted, is_serious
from .rrf.line import VOLTAGE_WARNING, find_reply, without_warning

POLL_TAG = "trigger:rrfmodel.poll"
POLL_TYPE = "rrfmodel_poll"
STATUS_TAG = "trigger:rrfmodel.status"

SWALLOWED = "// rrfmodel"
"""Stands for a line that was ours: counts as a sign of life and is parsed no further."""

STATUS_REQUEST = "M105"

SHOWS_TOOL = is_octoprint_compatible(">=2.0.0rc1")
"""Whether OctoPrint shows a current tool, and wants to be told it like a position."""


class CommBridge:
    """Knows OctoPrint's connection as far as polling needs to, and takes the replies out.

    ``notify(name, *arguments)`` is called with ``reply`` (text), ``refused`` (line),
    ``poll_sent``, ``status_sent`` and ``identified``; it must only take note and return.
    ``temperatures()`` gives what the model says of heat, ``None`` while it says nothing, and
    whether that is fresh. ``fire(event, payload)`` is OctoPrint's event bus.
    """

    def __init__(self, notify, temperatures, fire, clock):
        self._notify = notify
        self._temperatures = temperatures
        self._fire = fire
        self._clock = clock
        self._comm = None
        self._is_rrf = False
        self._awaited = None
        self._tool_command_at = 0.0
        self._polled = set()
        self.expects_refusal = False
        """Whether to look for the text that says that a polling command isn't known."""

    @property
    def is_rrf(self):
        """Whether the printer of this connection told that it runs RepRapFirmware."""
        return self._is_rrf

    def forget(self):
        """Know no printer: the connection is gone or not yet made."""
        self._comm = None
        self._is_rrf = False
        self._awaited = None
        self._polled = set()
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
            self._is_rrf = True
            self._comm = comm
            self._notify("identified")

    ##~~ octoprint.comm.protocol.gcode.received

    def on_received(self, comm, line, *args, **kwargs):
        """Return the line without the board's JSON, which goes to the worker."""
        if comm is not self._comm:
            return line
        if '{"' not in line:
            if line.startswith(VOLTAGE_WARNING):
                # OctoPrint sees an ok only where a line starts with it, and waits half a minute
                line = without_warning(line)
            if line.startswith("ok"):
                self._awaited = None
            elif self.expects_refusal and ("M409" in line or "M408" in line):
                self._notify("refused", line)
            return line
        found = find_reply(line)
        if found is None:
            return line
        self._notify("reply", found.reply)
        if not found.rest:
            return SWALLOWED
        if found.rest.startswith("ok"):
            self._awaited = None
        return found.rest

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
        elif gcode not in BLOCKING:
            if tags and POLL_TAG in tags and gcode != STATUS_REQUEST:
                return [(cmd, POLL_TYPE), (STATUS_REQUEST,)]
            return None
        return [(STATUS_REQUEST, None, {STATUS_TAG}), (cmd, cmd_type)]

    ##~~ octoprint.comm.protocol.gcode.sending

    def on_sending(
        self, comm, phase, cmd, cmd_type, gcode, subcode=None, tags=None, *args, **kwargs
    ):
        """Note what the printer is about to be busy with."""
        if comm is not self._comm:
            return None
        if gcode is None and cmd.startswith("T"):
            gcode = "T"  # T-1 is none to OctoPrint, and blocks as the others do
        self._awaited = gcode
        if gcode in ("T", "M109"):
            self._tool_command_at = self._clock()
        elif tags and POLL_TAG in tags:
            if gcode == STATUS_REQUEST:
                self._notify("status_sent")
            else:
                self._polled.add(cmd)
                self._notify("poll_sent")
        return None

    ##~~ octoprint.comm.protocol.gcode.error

    def on_error(self, comm, message, *args, **kwargs):
        """Return True for an error that is no reason to stop: a command was refused, no more.

        A halted board answers the very first command so, before it can say what it is. A serious
        one ends a print; else there is nothing to end, the board has looked after itself, and
        only a connection shows what is wrong.
        """
        if is_halted(message):
            return not comm.isPrinting()
        return comm is self._comm and not (is_serious(message) and comm.isPrinting())

    ##~~ octoprint.comm.protocol.temperatures.received

    def on_temperatures(self, comm, parsed, *args, **kwargs):
        """Return the report with the model's tools, bed, chamber and sensors in it."""
        if comm is not self._comm:
            return parsed
        known, is_fresh = self._temperatures()
        if known is None:
            return parsed
        # a report has T for the current tool, and OctoPrint takes that for T0 where there is
        # none: only the model knows the numbers
        merged = {name: value for name, value in parsed.items() if not name.startswith("T")}
        current = comm.getCurrentTool()
        highest = max([current, *(int(n[1:]) for n in parsed if n[0] == "T" and n[1:].isdigit())])
        # OctoPrint takes a tool for a sensor if its number is higher than any in the report, and
        # takes them all for sensors if neither the current one nor T0 is there
        is_readable = current in known.tools or 0 in known.tools
        for number, value in known.tools.items():
            actual, target = value if is_fresh else parsed.get(f"T{number}", (None, None))
            if is_readable and number <= highest:
                merged[f"T{number}"] = (actual, target)
            else:
                comm.last_temperature.set_tool(number, actual=actual, target=target)
        if is_fresh:
            slots = {"B": known.bed, "C": known.chamber}
            merged.update({name: value for name, value in slots.items() if value})
            merged.update(known.others)
        return merged

    ##~~ what others ask

    def has_polled(self, command):
        """Return whether a command was one of the polls of this connection."""
        return command in self._polled

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

    def baudrate(self):
        """Return the line's rate in bits a second, 0 where it is unknown."""
        rate = self._comm.getConnection()[1] if self._comm is not None else 0
        return rate if isinstance(rate, int) else 0

    def follow_tool(self, number, asked_at):
        """Tell OctoPrint the current tool, where a macro or another panel changed it.

        ``asked_at`` is when the reply was asked for that says so: one older than OctoPrint's own
        last tool command says nothing about it. OctoPrint has no way to say "none".
        """
        comm = self._comm
        if comm is None or number < 0 or asked_at <= self._tool_command_at:
            return
        old = comm.getCurrentTool()
        if old == number or comm._toolBeforeHeatup is not None:
            return
        comm._toolBeforeChange = old
        comm._currentTool = number
        self._fire(Events.TOOL_CHANGE, {"old": old, "new": number})
        if SHOWS_TOOL:
            comm._callback.on_comm_position_update({"t": number})
