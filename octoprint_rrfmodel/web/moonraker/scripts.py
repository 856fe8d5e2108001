"""G-code that a client sends as text: taken apart, looked at, sent line by line."""

from flask_babel import gettext

from ...host.answers import RequestRefused
from ...host.tags import SCRIPT_TAG

MOST_LINES = 50

LONGEST_LINE = 200
"""Characters of a line; the firmware's buffer holds 256 bytes (3.5 GCodes.h, MaxGCodeLength)."""


def lines_of(script):
    """Return the lines of a script without blanks around them; or raise ``RequestRefused``."""
    if not isinstance(script, str):
        raise RequestRefused(400, gettext("A script is a text with G-code, one command a line."))
    lines = [line.strip() for line in script.replace("\r\n", "\n").split("\n")]
    lines = [line for line in lines if line]
    if not lines:
        raise RequestRefused(400, gettext("The script holds no G-code."))
    if len(lines) > MOST_LINES:
        raise RequestRefused(
            400, gettext("The script has more than 50 lines. Upload it as a file.")
        )
    for line in lines:
        if not line.isprintable():
            raise RequestRefused(400, gettext("A line of the script holds a control character."))
        if len(line.encode("utf-8")) > LONGEST_LINE:
            raise RequestRefused(400, gettext("A line of the script is longer than 200 bytes."))
        # OctoPrint takes a semicolon for the beginning of a comment, even between quotes
        if line.partition(";")[0].count('"') % 2:
            raise RequestRefused(
                400,
                gettext("A line of the script has a quote without its partner, or a ; in quotes."),
            )
    return lines


class GcodeScripts:
    """Sends scripts to a connected RepRapFirmware; never waits, so that any thread may call it.

    ``is_connected()`` says whether RepRapFirmware is at the line's other end, ``link`` leads there.
    ``rate`` counts all commands that others give.
    """

    def __init__(self, is_connected, link, rate):
        self._is_connected = is_connected
        self._link = link
        self._rate = rate

    def run(self, script):
        """Queue the lines of a script; raise ``RequestRefused``."""
        lines = lines_of(script)
        self._check()
        if not self._rate.allows(len(lines)):
            raise RequestRefused(409, gettext("Too many commands at once. Try again in a second."))
        self._link.send_later(lines, {SCRIPT_TAG})

    def emergency_stop(self):
        """Stop the machine at once, past all queues; raise ``RequestRefused``."""
        self._check()
        self._link.stop_now({SCRIPT_TAG})

    def _check(self):
        if not self._is_connected():
            raise RequestRefused(409, gettext("No printer with RepRapFirmware is connected."))
