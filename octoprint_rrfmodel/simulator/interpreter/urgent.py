"""Commands that are acted on before they get into their channel's queue.

At HTTP's input every version looks for M112 and a bare M122, 3.6.3 and later for M108 too, and at
USB as well: they don't wait for the command that runs, as long as the input has room (release notes
of 3.6.3; the rules of that scanner are those seen in the firmware's HTTP input).
"""

from __future__ import annotations

import re

from ..device.emergency import Emergency
from ..line.channel import Channel
from ..line.outcome import as_reply
from .decoder import Decoder
from .table import GCodes

_STOP = re.compile(r"[Mm]112(?:[\s;].*)?$", re.DOTALL)
_CANCEL_WAIT = re.compile(r"[Mm]108(?:[\s;].*)?$", re.DOTALL)
_DIAGNOSTICS = re.compile(r"[Mm]122$")
HIDING = ("M", "M1", "M11", "M12")
"""Lines behind which the scanner takes the next one for their continuation."""


class Urgent:
    """Acts on urgent lines of one channel; those that empty the input have no ``ok``."""

    def __init__(
        self,
        *,
        gcodes: GCodes,
        decoder: Decoder,
        emergency: Emergency,
        channel: Channel,
        cancels_waits: bool = True,
    ):
        self._gcodes = gcodes
        self._decoder = decoder
        self._emergency = emergency
        self._channel = channel
        self._cancels_waits = cancels_waits
        self._line_before = ""

    def takes(self, line: str, has_room: bool) -> bool:
        """Return whether that line has been acted on, and is not to be queued."""
        before, self._line_before = self._line_before, line
        if not has_room or before.upper() in HIDING:
            return False
        if _STOP.match(line):
            self._channel.abandon()
            self._emergency.stop()
            return True
        if _DIAGNOSTICS.match(line):
            self._channel.lines.clear()
            self._run(line)
            return True
        if self._cancels_waits and _CANCEL_WAIT.match(line):
            # nothing of the input is deleted, so it is also run in its turn
            self._run(line)
        return False

    def _run(self, line: str) -> None:
        for command in self._decoder.commands(self._channel, line):
            reply = as_reply(self._gcodes.execute(self._channel, command))
            if reply.text:
                self._channel.write(reply.text + "\n")
