"""Which request goes where, and who may ask (DSF Startup.cs, SessionKeyAuthenticationHandler)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from ...firmware import Firmware
from ...line.switches import FaultSwitches
from ..rr.standalone import WebPages
from .machine_request import (
    NOT_FOUND,
    UNAUTHORIZED,
    MachineAnswer,
    MachineOutcome,
    MachineRequest,
    MachineRow,
    decoded,
    text_answer,
)
from .sbc_sessions import SbcSession, SbcSessions

PREFIX = "/machine/"
SESSIONS_SINCE = (3, 4)
TROUBLES = {
    "net_sbc_down": text_answer("Failed to connect to DCS: Connection refused", 503),
    "net_sbc_version": text_answer("Incompatible DCS version", 502),
}
"""Fault → what every request is answered with meanwhile."""


class MachineGroup(Protocol):
    """Requests that work on the same parts."""

    def rows(self) -> Sequence[MachineRow]:
        """Return the rows of the table that they are."""


class Routes:
    """The table of DSF's requests, for one version."""

    def __init__(
        self,
        firmware: Firmware,
        sessions: SbcSessions,
        *,
        faults: FaultSwitches,
        pages: WebPages,
    ):
        self._release = firmware.release
        self.sessions = sessions
        self._faults = faults
        self._pages = pages
        self._rows: list[MachineRow] = []

    def register(self, *groups: MachineGroup) -> None:
        """Add requests; the first that fits is taken."""
        for group in groups:
            self._rows += group.rows()

    @property
    def trouble(self) -> MachineAnswer | None:
        """What is answered as long as the control server can't be talked with."""
        return next((said for name, said in TROUBLES.items() if self._faults.is_on(name)), None)

    def session(self, key: str | None, address: str) -> SbcSession | None:
        """Return who asks; before 3.4 there is nobody who may not."""
        if self._release < SESSIONS_SINCE:
            return SbcSession("", address, 0.0)
        return self.sessions.find(key, address)

    def answer(self, request: MachineRequest) -> MachineOutcome:
        """Return what a request is answered with."""
        path = request.path[len(PREFIX) :] if request.path.startswith(PREFIX) else request.path[1:]
        for row in self._rows:
            rest = self._rest(row, request.method, path)
            if rest is None:
                continue
            if self.trouble is not None:
                return self.trouble
            key = request.headers.get("x-session-key")
            if not row.is_open and self.session(key, request.address) is None:
                return UNAUTHORIZED
            return row.function(request, decoded(rest))
        return self._page(request)

    def _rest(self, row: MachineRow, method: str, path: str) -> str | None:
        """Return the rest of the path where the row is the one, ``None`` where it isn't."""
        if row.method != method or self._release < row.since:
            return None
        if path.lower() == row.path:
            return None if row.takes_rest else ""
        name, slash, rest = path.partition("/")
        return rest if row.takes_rest and slash and name.lower() == row.path else None

    def _page(self, request: MachineRequest) -> MachineAnswer:
        """The web interface; there is a first page for nothing but itself."""
        if request.method != "GET" or request.path != "/":
            return NOT_FOUND
        page = self._pages.first()
        return MachineAnswer(200, page, "text/html") if page else NOT_FOUND
