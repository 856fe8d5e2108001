"""What to ask of a board that has no ``M409``. Decides; sends nothing and knows no clock."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..wire.m408 import M408Model
from ..wire.reply import StatusReply
from ..wire.request import Request, StatusRequest
from .poll import Update
from .too_large import TooLarge

FORMS = (2, 3, 5, 4, 1, 0)
"""The forms, the most telling first; 3.6 has the last two alone, 3.7 none."""

SETTINGS_EVERY = 10
"""Status replies between two that tell names, tools and limits."""

PATIENCE = 2
"""Failures of one form in a row before it counts as one that the firmware hasn't."""

PRINTING = frozenset(("processing", "simulating", "pausing", "paused", "resuming"))


class StatusPlan:
    """The order of ``M408`` requests: each form once, then the best of those that answer."""

    def __init__(self) -> None:
        self.restart()

    def restart(self) -> None:
        """Begin anew, as with a board that was reset."""
        self._model = M408Model()
        self.too_large = TooLarge()
        self._form: int | None = None
        self._taken: int | None = None
        self._untried = list(FORMS)
        self._again: list[int] = []
        self._answered: set[int] = set()
        self._asked = 0
        self._failures = 0
        self._printing = False

    @property
    def ready(self) -> bool:
        """Whether each form was tried and at least one answers."""
        return not self._untried and bool(self._answered)

    @property
    def behind(self) -> bool:
        """Whether forms are left to ask once."""
        return bool(self._untried or self._again)

    @property
    def exhausted(self) -> bool:
        """Whether each form was tried and none answers."""
        return not self._untried and not self._answered

    @property
    def is_amid(self) -> bool:
        """False: no form is a part of another."""
        return False

    @property
    def live_keys(self) -> tuple[str, ...]:
        """None: a form tells live values as a whole."""
        return ()

    @property
    def short_of_buffers(self) -> int:
        """0: M408 waits for buffers and never says that it has none."""
        return 0

    def next_request(self) -> Request:
        """Return what to ask now; the same again until it was answered or given up."""
        if self._form is None:
            self._form = self._choose()
        return StatusRequest(self._form)

    def _choose(self) -> int:
        if self.behind:
            return (self._untried or self._again)[0]
        settings = 3 if 3 in self._answered else 1
        status = 4 if self._printing else 2
        if status not in self._answered:
            status = 2 if 2 in self._answered else 0
        if self._asked % SETTINGS_EVERY == 0 and settings in self._answered:
            return settings
        return status

    def take(self, reply: StatusReply) -> list[Update]:
        """Take the answer to ``next_request``; return the model's keys as they now are."""
        form, self._form = self._form, None
        self._taken = form
        self._failures = 0
        self._asked += 1
        waiting = self._untried or self._again
        if waiting and form in (None, waiting[0]):
            self._answered.add(waiting.pop(0))
        model = self._model.take(reply.fields)
        return [Update(key, value) for key, value in model.items()]

    def failed(self) -> None:
        """Note that ``next_request`` brought nothing that could be used."""
        form, self._form = self._form, None
        self._failures += 1
        waiting = self._untried or self._again
        if self._failures >= PATIENCE and waiting and form in (None, waiting[0]):
            waiting.pop(0)
            self._failures = 0

    def no_buffers(self) -> list[Update]:
        """As ``failed``."""
        self.failed()
        return []

    def again(self, updates: list[Update]) -> None:
        """Note that what was just taken doesn't count, and ask the same again."""
        self._model.undo()
        self._form = self._taken

    def observe(self, model: Mapping[str, Any]) -> None:
        """Look at the status after a change: a job has a form of its own."""
        state = model.get("state") or {}
        self._printing = state.get("status") in PRINTING

    def refetch(self, key: str = "") -> None:
        """Ask each form again that was answered: none of them is one key."""
        self._again = [form for form in FORMS if form in self._answered]
