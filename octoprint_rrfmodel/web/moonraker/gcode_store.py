"""What was said on the line lately: no polls of the plugin's, no file's lines, no secrets."""

import collections
import re
import time

from octoprint.printer import PrinterCallback

from ...host.tags import STATUS_TAG
from ...link.terminal import RECEIVED, PollTrace
from ...rrf.wire.masking import masked

MOST_LINES = 1000

AUTOMATIC = frozenset(("trigger:comm.poll_temperature", "trigger:comm.poll_sd_status", STATUS_TAG))
"""Tags of what is asked again and again, and by nobody."""

TEMPERATURES = re.compile(r"(ok )?T\d*:")
"""A report of temperatures, which nobody asked for unless by M105."""

PLAIN = ("Recv: ok", "<<< ok", "Recv: wait", "<<< wait", "Recv: ", "<<< ", "<<<")
"""Lines that say nothing beyond that a command was taken."""

SENT_LINE = ("Send", ">>> ")
"""How a line begins that went out; with a G code in it, as most in a print, it is no poll."""


class GcodeStore(PrinterCallback):
    """Keeps the latest commands and responses, in Moonraker's form.

    ``link`` says whether there is anything to keep, and whether the plugin sent a command;
    ``responded(text)`` is called with each response, on the thread of OctoPrint's that
    hears it.
    """

    def __init__(self, link, responded):
        self._link = link
        self._trace = PollTrace(link.has_polled)
        self._responded = responded
        self._wants_temperatures = False
        self._lines = collections.deque(maxlen=MOST_LINES)

    def sent(self, command, tags):
        """Note a command that went out and is no line of a file."""
        is_asked = AUTOMATIC.isdisjoint(tags)
        self._wants_temperatures = is_asked and command == "M105"
        if is_asked:
            self._note(masked(command), "command")

    def on_printer_add_log(self, data):
        """Take a line of OctoPrint's log (OctoPrint's callback)."""
        if not self._link.is_rrf:
            return
        if not self._trace.is_open and (data in PLAIN or (" G" in data and data[:4] in SENT_LINE)):
            return
        if self._trace.hides(data) or data in PLAIN:
            return
        received = RECEIVED.match(data)
        if received is None:
            return
        is_report = TEMPERATURES.match(received["text"])
        if not is_report or self._wants_temperatures:
            self._wants_temperatures = self._wants_temperatures and not is_report
            text = masked(received["text"])
            self._note(text, "response")
            self._responded(text)

    def latest(self, count):
        """Return the latest ``count`` lines, oldest first."""
        lines = list(self._lines)
        return lines[len(lines) - count :] if count < len(lines) else lines

    def _note(self, message, kind):
        self._lines.append({"message": message, "time": time.time(), "type": kind})
