"""Who may ask: eight slots of address and key, each free again after eight seconds (seen in
firmware).
"""

from __future__ import annotations

import random
import threading
from dataclasses import dataclass
from typing import Callable

from ...device.network_access import NetworkAccess
from ...firmware import Firmware
from ...line.switches import FaultSwitches, Incident

MOST_SESSIONS = 8
LIFE_SECONDS = 8.0
NO_KEY = 0
"""Key of a session that is known by its address alone."""
KEYS_SINCE = 2
"""``apiLevel`` from which on sessions have keys."""


@dataclass
class Session:
    """A slot that is taken."""

    address: str
    key: int
    used_at: float
    uploads: int = 0
    """Uploads that are under way."""


class HttpSessions:
    """The slots; ``clock`` gives seconds of real time, which clients live in."""

    def __init__(
        self,
        access: NetworkAccess,
        firmware: Firmware,
        *,
        faults: FaultSwitches,
        clock: Callable[[], float],
    ):
        self._access = access
        self._faults = faults
        self._clock = clock
        self.has_keys = firmware.api_level >= KEYS_SINCE
        self._open: list[Session] = []
        # each connection has a thread of its own here
        self._lock = threading.Lock()
        self.ended: Callable[[], None] = lambda: None
        """Called when a slot has been given back."""

    def incidents(self) -> dict[str, Incident]:
        return {"net_stale_key": Incident(lambda argument: self.forget())}

    def __len__(self) -> int:
        self.expire()
        return len(self._open)

    def expire(self) -> None:
        """Free what nobody has used for its time."""
        since = self._clock() - LIFE_SECONDS
        with self._lock:
            before = len(self._open)
            self._open = [session for session in self._open if session.used_at > since]
            freed = before - len(self._open)
        for _ in range(freed):
            self.ended()

    def forget(self) -> None:
        """Know nobody any more, as after a restart."""
        with self._lock:
            self._open.clear()
        self.ended()

    def find(self, address: str, key: int) -> Session | None:
        """Return the session that the key is of, which lives on; ``None`` for a stranger."""
        self.expire()
        for session in self._open:
            if session.address == address and (session.key == key or not self.has_keys):
                session.used_at = self._clock()
                return session
        return None

    def admit(self, address: str, key: int) -> Session | None:
        """Return the session, a new one without a key where the board has no password.

        A request with a stale key gets none, and takes a slot all the same (3.5 and later).
        """
        found = self.find(address, key)
        if found is None and not self._access.has_password:
            self._add(address, NO_KEY)
            found = self.find(address, key)
        return found

    def log_in(self, address: str, password: str, wants_key: bool) -> tuple[int, int]:
        """Return ``err`` and the key of a login, 0 without one."""
        if not self.has_keys and self.find(address, NO_KEY) is not None:
            return 0, NO_KEY
        if not self._access.is_right(password):
            return 1, NO_KEY
        key = random.randrange(1, 1 << 32) if wants_key and self.has_keys else NO_KEY
        self.expire()
        return (0, key) if self._add(address, key) else (2, NO_KEY)

    def _add(self, address: str, key: int) -> bool:
        with self._lock:
            if len(self._open) >= MOST_SESSIONS or self._faults.is_on("net_full"):
                return False
            self._open.append(Session(address, key, self._clock()))
            return True

    def log_out(self, session: Session) -> bool:
        """Give a slot back; not while it uploads."""
        with self._lock:
            if session.uploads or session not in self._open:
                return False
            self._open.remove(session)
        self.ended()
        return True
