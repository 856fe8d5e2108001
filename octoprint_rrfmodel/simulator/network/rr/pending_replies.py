"""Replies until every session has had its chance to fetch them (RRF 3.5 HttpResponder.cpp:1525).

Nobody is told apart: they are kept until as many fetches as there are sessions have come, whoever
made them (seen in firmware).
"""

from __future__ import annotations

from typing import Callable

from ...model.om import BUFFER_SIZE
from ...model.tree import ObjectModel
from ...text.letters import utf8
from .http_sessions import LIFE_SECONDS, HttpSessions

MOST_BUFFERS = 20
"""Buffers that replies may hold; further pieces are counted and lost."""


class PendingReplies:
    """What ``rr_reply`` has to say; ``clock`` gives seconds of real time."""

    def __init__(self, model: ObjectModel, sessions: HttpSessions, clock: Callable[[], float]):
        self._model = model
        self._sessions = sessions
        self._clock = clock
        self._pieces: list[str] = []
        self._fetches = 0
        self._newest_at = 0.0
        sessions.ended = self._session_ended

    def keep(self, text: str) -> bool:
        """Take a piece and count it; return whether there is anybody who may fetch it."""
        if not len(self._sessions):
            return False
        if self.buffers < MOST_BUFFERS:
            self._pieces.append(text)
        self._fetches = 0
        self._newest_at = self._clock()
        self._model.bump("reply")
        return True

    def overhear(self, text: str) -> None:
        """Take what is said to everybody."""
        self.keep(text)

    def fetch(self) -> str:
        """Return all that is pending."""
        self.expire()
        text = "".join(self._pieces)
        if self._pieces:
            self._fetches += 1
            self._forget_fetched()
        return text

    def expire(self) -> None:
        """Forget what nobody has fetched for the life of a session."""
        if self._pieces and self._clock() - self._newest_at >= LIFE_SECONDS:
            self.forget()

    def _session_ended(self) -> None:
        if self._pieces:
            self._forget_fetched()

    def _forget_fetched(self) -> None:
        if self._fetches >= len(self._sessions):
            self.forget()

    def forget(self) -> None:
        self._pieces.clear()

    @property
    def buffers(self) -> int:
        """Output buffers that are pinned by what is pending."""
        self.expire()
        return -(-len(utf8("".join(self._pieces))) // BUFFER_SIZE)
