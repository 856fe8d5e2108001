"""M408: status as it was told before the object model (RRF 3.5 RepRap.cpp:1613-1856)."""

from __future__ import annotations

from typing import Callable

from ...device.live_members import LiveMembers
from ...interpreter.table import Row, Rows
from ...line.channel import Channel
from ...line.outcome import Outcome
from ...text.command import Command
from ...text.serial_line import Kind, Reply
from .m408 import text_of
from .m408_values import Values


class OldStatus:
    """Answers M408; ``values`` gives what is told in it."""

    def __init__(self, live: LiveMembers, values: Callable[[], Values]):
        self._live = live
        self._values = values

    def rows(self) -> Rows:
        return {"M408": Row(self._old_status, until=(3, 7))}

    def _old_status(self, channel: Channel, command: Command) -> Outcome:
        """M408: S0 and S1 for old panels, S2 to S4 as rr_status, S5 as rr_config."""
        kind = command.integer("S", 0) or 0
        if kind == 0:
            channel.status_request = "M408"
        text = self.text(kind)
        # S0 and S1 bring a line break of their own on top (RRF 3.5 RepRap.cpp:1854)
        return Reply(text + ("\n\n" if kind in (0, 1) else "\n"), Kind.LONG)

    def text(self, kind: int) -> str:
        """Return the JSON text of that type."""
        self._live.refresh()
        return text_of(self._values(), kind)
