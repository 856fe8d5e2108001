"""Who may ask DSF: any number of sessions by key, and one for an address without one."""

from __future__ import annotations

import secrets
from typing import Callable

from ...device.network_access import NetworkAccess
from ...line.switches import Incident

LIFE_SECONDS = 8.0


class SbcSession:
    """One who may ask."""

    def __init__(self, key: str, address: str, used_at: float):
        self.key = key
        self.address = address
        self.used_at = used_at
        self.uses = 0
        """Requests and websockets that are open, for which it lives on."""


class SbcSessions:
    """The sessions; ``clock`` gives seconds of real time."""

    def __init__(self, access: NetworkAccess, clock: Callable[[], float]):
        self._access = access
        self._clock = clock
        self._by_key: dict[str, SbcSession] = {}
        self._by_address: dict[str, SbcSession] = {}

    def incidents(self) -> dict[str, Incident]:
        return {"net_stale_key": Incident(lambda argument: self.forget())}

    def forget(self) -> None:
        """Know nobody any more."""
        self._by_key.clear()
        self._by_address.clear()

    def log_in(self, password: str) -> SbcSession | None:
        """Return a new session with a key, ``None`` for a wrong password."""
        if not self._access.is_right(password):
            return None
        key = secrets.token_hex(16)
        self._by_key[key] = SbcSession(key, "", self._clock())
        return self._by_key[key]

    def log_in_address(self, address: str, password: str) -> bool:
        """Let an address ask without a key, as the emulated ``rr_connect`` does."""
        if not self._access.is_right(password):
            return False
        self._by_address[address] = SbcSession("", address, self._clock())
        return True

    def find(self, key: str | None, address: str) -> SbcSession | None:
        """Return who asks, ``None`` for a stranger."""
        self._expire()
        if key:
            found = self._by_key.get(key)
        else:
            found = self._by_address.get(address)
            if found is None and self.log_in_address(address, ""):
                found = self._by_address[address]
        if found is not None:
            found.used_at = self._clock()
        return found

    def log_out(self, session: SbcSession) -> None:
        self._by_key.pop(session.key, None)
        self._by_address.pop(session.address, None)

    def _expire(self) -> None:
        since = self._clock() - LIFE_SECONDS
        for sessions in (self._by_key, self._by_address):
            for name, session in list(sessions.items()):
                if not session.uses and session.used_at <= since:
                    del sessions[name]
