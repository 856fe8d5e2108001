"""OctoPrint's hooks about what comes in: look at a line, hand over, return.

They run on OctoPrint's receiving thread, which the print waits for. None of them decodes, waits,
or raises.
"""

from ...host.tags import SWALLOWED
from ...rrf.card.wording import BEGINNINGS, LIST_BEGINS
from ...rrf.wire.errors import is_halted, is_serious
from ...rrf.wire.heard import TELLING, heard
from ...rrf.wire.line import VOLTAGE_WARNING, find_reply, without_warning
from ...rrf.wire.report import is_report
from .fitting import leave_alone
from .own_requests import POLL

REPORTS = frozenset("TBC")
"""First letters of a temperature report that comes by itself."""

OK = "ok"

OKS = frozenset((OK, "ok\n", "ok\r\n"))
"""Acknowledgements without anything behind them."""

PLAIN_OK = max(map(len, OKS))

NOISE = "\0\ufffd"
"""A byte of noise, and what OctoPrint makes of one that is no text: it doesn't find the ok that one
of them stands in."""

WITHOUT_NOISE = str.maketrans("", "", NOISE)

NOISY = ("o", *NOISE)
"""How a line may begin that is an ok but for some noise."""

ATTENDED = TELLING | REPORTS | set(NOISE) | {begins[0] for begins in (*BEGINNINGS, LIST_BEGINS)}
"""First letters of lines that are looked at; most lines begin otherwise and cost little."""


class ReceivedLines:
    """Takes the board's JSON out of what OctoPrint hears, and finds out whose board it is.

    ``notify(name, *arguments)`` is called with ``reply`` (text, number), ``refused`` and
    ``report`` (line), ``identified``, ``halted`` and ``heard`` (what); it must only take note and
    return.
    ``card.reword(line)`` gives a line in words that OctoPrint knows, ``card.fill()`` one in the
    place of a line that was the plugin's alone. ``guards(error)`` says whether a serious error
    only pauses the print. ``patience.feed(comm)`` gives what OctoPrint is to hear of silence.
    ``refusals.look(comm, line)`` sees what the firmware says of commands.
    """

    def __init__(self, link, card, notify, *, guards, patience, refusals):
        self._link = link
        self._card = card
        self._notify = notify
        self._guards = guards
        self._patience = patience
        self._refusals = refusals

    ##~~ octoprint.comm.protocol.firmware.info

    def on_firmware_info(self, comm, firmware_name, data, *args, **kwargs):
        """Find out whether this is RepRapFirmware; until then no line is touched.

        1.11 calls this for every line with a NAME in it, 2.0 once, and either may give no name:
        a connection that was known to be RepRapFirmware stays so.
        """
        link = self._link
        link.reported = dict(data or {})
        if comm is link.connection:
            return
        link.forget()
        if "reprapfirmware" in (firmware_name or "").lower():
            link.is_known_now(comm)
            self._notify("identified")
        else:
            leave_alone(comm)

    ##~~ octoprint.comm.protocol.gcode.received

    def on_received(self, comm, line, *args, **kwargs):
        """Return the line without the board's JSON, which goes to the worker."""
        link = self._link
        if comm is not link.connection:
            return line
        if line in OKS and link.awaits_a_move and link.extra_ok.awaits is None:
            # nearly every answer in a print; each call less counts
            link.awaits_a_move = False
            link.awaited = None
            return line
        if line:
            # a call less for each line
            link.heard_at = link.clock()
        if '{"' not in line:
            first = line[:1]
            if first == "o" and link.extra_ok.awaits is None and line[1:2] == "k":
                if len(line) > PLAIN_OK and line[3:4] in REPORTS:
                    self._notify("report", line)
                if link.awaited is not None and line.startswith("ok"):
                    if link.own.awaited:
                        line = self._own_is_through(line)
                    link.acknowledged()
                return line
            if (
                first in ATTENDED
                or first == "o"
                or link.extra_ok.awaits is not None
                or link.expects_refusal
                or self._card.is_talking
            ):
                return self._text(comm, line)
            return line
        found = find_reply(line)
        if found is None or (found.is_of_a_file and not link.asks_of_a_file):
            return line
        self._notify("reply", found.reply, found.number)
        if not found.rest:
            return self._card.fill()
        if found.rest.startswith("ok"):
            if link.own.awaited:
                self._own_is_through(line)
            link.acknowledged()
        return found.rest

    def _own_is_through(self, line):
        """Note that a poll, or what stands behind one, is through; return what OctoPrint hears."""
        own, self._link.own.awaited = self._link.own.awaited, None
        if own == POLL:
            self._notify("poll_acknowledged")
            return line
        # OctoPrint asks for temperatures itself, and keeps each that it hears of
        return OK

    def _text(self, comm, line):
        """Return a line that holds no JSON and is no plain ok, as OctoPrint is to read it."""
        link = self._link
        first = line[:1]
        if first in NOISY:
            clean = line.translate(WITHOUT_NOISE)
            if clean != line and clean.startswith("ok"):
                return self.on_received(comm, clean)
        if first in TELLING:
            told = heard(line)
            if told == "box":
                link.box.opened()
            if told:
                self._notify("heard", told)
            if not line:
                return self._patience.feed(comm)
            if line.startswith(VOLTAGE_WARNING):
                # OctoPrint sees an ok only where a line starts with it, and waits half a minute
                line = without_warning(line)
        elif first in REPORTS and is_report(line):
            self._notify("report", line)
            if link.extra_ok.awaits is None and not self._card.is_talking:
                # nothing else is about a report
                return line
        if link.box.finds_out(comm, line):
            return SWALLOWED
        if link.extra_ok.awaits is not None and link.extra_ok.is_in(line):
            return SWALLOWED
        if line.startswith("ok"):
            if link.own.awaited:
                self._own_is_through(line)
            link.acknowledged()
            return line
        if link.expects_refusal and ("M409" in line or "M408" in line):
            self._notify("refused", line)
            return line
        reworded = self._card.reword(line)
        if reworded == line:
            self._refusals.look(comm, line)
        return reworded

    ##~~ octoprint.comm.protocol.gcode.error

    def on_error(self, comm, message, *args, **kwargs):
        """Return True for an error that is no reason to stop: a command was refused, no more.

        A halted board answers the very first command so, before it can say what it is. A serious
        one ends a print that isn't paused because of it; else there is nothing to end, and only
        a connection shows what is wrong.
        """
        if is_halted(message):
            ends = comm.isPrinting()
        elif comm is not self._link.connection:
            return False
        else:
            ends = is_serious(message) and comm.isPrinting() and not self._guards(message)
        if ends:
            # OctoPrint sends M112 and hangs up
            self._notify("halted")
        return not ends
