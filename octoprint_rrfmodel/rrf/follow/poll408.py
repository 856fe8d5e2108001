"""What to ask of a board that has no ``M409``. Decides; sends nothing and knows no clock."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ..card.listing import path_of
from ..wire.m408 import M408Model
from ..wire.reply import StatusReply
from ..wire.request import JobFileRequest, Request, StatusRequest
from .too_large import TooLarge
from .update import Update

FORMS = (2, 3, 5, 4, 1, 0)
"""The forms, the most telling first; 3.6 has the last two alone, 3.7 none."""

SETTINGS_EVERY = 10
"""Status replies between two that tell names, tools and limits."""

FILE_EVERY = 10
"""Status replies between two questions which file is printed: another may have taken its place
between two replies."""

PATIENCE = 2
"""Failures of one form in a row before it counts as one that the firmware hasn't, and of the
question about the file before it isn't asked again for that job."""

PRINTING = frozenset(("processing", "simulating", "pausing", "paused", "resuming"))


class StatusPlan:
    """The order of ``M408`` requests: each form once, then the best of those that answer."""

    def __init__(self) -> None:
        self.restart()

    def restart(self) -> None:
        """Begin anew, as with a board that was reset."""
        self._model = M408Model()
        self.too_large = TooLarge()
        self._request: Request | None = None
        self._taken: Request | None = None
        self._untried = list(FORMS)
        self._again: list[int] = []
        self._answered: set[int] = set()
        self._asked = 0
        self._failures = 0
        self._printing = False
        self._since_file = FILE_EVERY
        self._file_failures = 0
        self._has_file = False
        self._keys: set[str] = set()

    @property
    def ready(self) -> bool:
        """Whether each form was tried and at least one answers."""
        return not self._untried and bool(self._answered)

    @property
    def behind(self) -> bool:
        """Whether forms are left to ask once."""
        return bool(self._untried or self._again)

    @property
    def wanted(self) -> frozenset[str]:
        """None: a form tells live values and all others at once."""
        return frozenset()

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
        if self._request is None:
            self._request = self._choose()
        return self._request

    def _choose(self) -> Request:
        if self.behind:
            return StatusRequest((self._untried or self._again)[0])
        if self._printing and self._since_file >= FILE_EVERY and self._file_failures < PATIENCE:
            return JobFileRequest()
        settings = 3 if 3 in self._answered else 1
        status = 4 if self._printing else 2
        if status not in self._answered:
            status = 2 if 2 in self._answered else 0
        if self._asked % SETTINGS_EVERY == 0 and settings in self._answered:
            return StatusRequest(settings)
        return StatusRequest(status)

    def take(self, reply: StatusReply) -> list[Update]:
        """Take the answer to ``next_request``; return the model's keys as they now are."""
        request, self._request = self._request, None
        self._taken = request
        self._failures = 0
        if isinstance(request, JobFileRequest):
            self._since_file = self._file_failures = 0
            return self._updates(self._model.take_file(_with_path(reply.fields)))
        self._asked += 1
        self._since_file += 1
        waiting = self._untried or self._again
        if waiting and request in (None, StatusRequest(waiting[0])):
            self._answered.add(waiting.pop(0))
        return self._updates(self._model.take(reply.fields))

    def _updates(self, model: Mapping[str, Any]) -> list[Update]:
        """Return the keys as they are; one of which nothing is left is empty."""
        gone = self._keys.difference(model)
        self._keys |= model.keys()
        return [Update(key, {} if key in gone else model[key]) for key in (*model, *gone)]

    def failed(self) -> None:
        """Note that ``next_request`` brought nothing that could be used."""
        request, self._request = self._request, None
        if isinstance(request, JobFileRequest):
            self._since_file = 0
            self._file_failures += 1
            return
        self._failures += 1
        waiting = self._untried or self._again
        is_wanted = bool(waiting) and request in (None, StatusRequest(waiting[0]))
        if self._failures >= PATIENCE and is_wanted:
            waiting.pop(0)
            self._failures = 0

    def no_buffers(self) -> list[Update]:
        """As ``failed``."""
        self.failed()
        return []

    def again(self, updates: list[Update]) -> None:
        """Note that what was just taken doesn't count, and ask the same again."""
        self._model.undo()
        self._request = self._taken

    def observe(self, model: Mapping[str, Any]) -> None:
        """Look at the status after a change: a job has a form of its own."""
        state = model.get("state") or {}
        was_printing, self._printing = self._printing, state.get("status") in PRINTING
        begins = self._printing and not was_printing
        file = (model.get("job") or {}).get("file") or {}
        if begins:
            self._file_failures = 0
        if begins or (self._has_file and not file.get("fileName")):
            self._since_file = FILE_EVERY
        self._has_file = bool(file.get("fileName"))

    def refetch(self, key: str = "") -> None:
        """Ask each form again that was answered: none of them is one key."""
        self._again = [form for form in FORMS if form in self._answered]


def _with_path(fields: dict[str, Any]) -> dict[str, Any]:
    """Return an answer about a file with its whole path: some firmware repeats what was typed."""
    name = fields.get("fileName")
    return {**fields, "fileName": path_of(name)} if isinstance(name, str) and name else {}
