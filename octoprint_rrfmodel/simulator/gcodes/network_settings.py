"""How the network is used: M551, M586."""

from __future__ import annotations

from ..device.network_access import NetworkAccess
from ..interpreter.table import Row, Rows
from ..line.channel import Channel
from ..line.outcome import Outcome
from ..text.command import Command


class NetworkSettings:
    """Sets the password, and which foreign pages may ask."""

    def __init__(self, access: NetworkAccess):
        self._access = access

    def rows(self) -> Rows:
        return {"M551": Row(self._password), "M586": Row(self._protocols)}

    def _password(self, channel: Channel, command: Command) -> Outcome:
        """M551."""
        if "P" in command:
            self._access.password = command.string("P") or ""
        return None

    def _protocols(self, channel: Channel, command: Command) -> Outcome:
        """M586: C is the site of foreign pages; protocols are on whatever is asked for."""
        if "C" in command:
            self._access.allow_site(command.string("C") or "")
        return None
