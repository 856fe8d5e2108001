"""What was said on the line lately: no polls of the plugin's, no file's lines, no secrets."""

import collections
import itertools
import re
import threading
import time

from ...host.tags import COMMAND_TAG, SCRIPT_TAG, STATUS_TAG
from ...link.terminal import RECEIVED, PollTrace
from ...rrf.wire.masking import masked

MOST_LINES = 1000

AUTOMATIC = frozenset(("trigger:comm.poll_temperature", "trigger:comm.poll_sd_status", STATUS_TAG))
"""Tags of what is asked again and again, and by nobody."""

TEMPERATURES = re.compile(r"(ok )?T\d*:")
"""A report of temperatures, which nobody asked for unless by M105."""

CARD_POLLED = re.compile(r"(?:Not SD printing|SD printing byte)")
"""What is said to OctoPrint's M27, which it asks by its own clock."""

PLAIN = frozenset(("Recv: ok", "<<< ok", "Recv: wait", "<<< wait", "Recv: ", "<<< ", "<<<"))
"""Lines that say nothing beyond that a command was taken."""

ASKED = frozenset((COMMAND_TAG, SCRIPT_TAG))
"""Tags of what a person asked for by the plugin's own means."""

OK = ("Recv: ok", "<<< ok")
"""How a line begins behind which nothing is said about a command any more."""

SENT_LINE = ("Send", ">>> ")
"""How a line begins that went out; with a G code in it, as most in a print, it is no poll."""


MOONRAKERS = ("message", "time", "type")
"""The members of a line that Moonraker knows."""


class GcodeStore:
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
        self._is_asked = False
        self._is_polled = False
        self._lock = threading.Lock()
        self._number = 0
        self._lines = collections.deque(maxlen=MOST_LINES)

    def sent(self, command, tags):
        """Note a command that went out and is no line of a file."""
        is_anybodys = AUTOMATIC.isdisjoint(tags)
        self._wants_temperatures = is_anybodys and command == "M105"
        self._is_asked = not ASKED.isdisjoint(tags)
        self._is_polled = not is_anybodys
        if is_anybodys:
            self._note(masked(command), "command")

    def on_printer_add_log(self, data):
        """Take a line of OctoPrint's log (``host.printer_news.PrinterNews``)."""
        # first what nearly all lines of a print are, two for each line of the file
        is_plain = data in PLAIN or (data[:4] in SENT_LINE and " G" in data)
        if is_plain and not (self._is_asked or self._trace.is_open):
            return
        if not self._link.is_rrf:
            return
        if self._is_asked and data.startswith(OK):
            self._is_asked = False
        if is_plain and not self._trace.is_open:
            return
        if self._trace.hides(data) or data in PLAIN:
            return
        received = RECEIVED.match(data)
        if received is None:
            return
        if self._is_polled and CARD_POLLED.match(received["text"]):
            return
        is_report = TEMPERATURES.match(received["text"])
        if not is_report or self._wants_temperatures:
            self._wants_temperatures = self._wants_temperatures and not is_report
            text = masked(received["text"])
            self._note(text, "response")
            self._responded(text)

    def latest(self, count):
        """Return the latest ``count`` lines, oldest first."""
        lines = self.since(0)
        if count < len(lines):
            lines = lines[len(lines) - count :]
        return [{name: line[name] for name in MOONRAKERS} for line in lines]

    @property
    def newest(self):
        """Number of the newest line, 0 before the first."""
        return self._number

    def since(self, number):
        """Return the lines behind one with that number, oldest first: with their numbers, and
        whether a person asked for them."""
        with self._lock:
            # each has the number behind that of the one before
            count = min(self._number - number, len(self._lines))
            latest = itertools.islice(reversed(self._lines), max(0, count))
            return list(latest)[::-1]

    def _note(self, message, kind):
        # commands and responses come by threads of their own
        with self._lock:
            self._number += 1
            self._lines.append(
                {
                    "number": self._number,
                    "message": message,
                    "time": time.time(),
                    "type": kind,
                    "asked": self._is_asked,
                }
            )
