"""Who looks at which part of the model, and until when."""

from __future__ import annotations

import re
from typing import Callable

from ..model.columns import EACH
from .freshness import is_below

_INDEX = re.compile(r"\[[^\]]*\]")
"""One element of a list: parts are asked for of all elements at once."""

LOOKS_SECONDS = 30.0
"""Time that a look lasts; who goes on looking says so again."""


class Interest:
    """Kept by those who show the model, read by those who ask for it; any thread may do either."""

    def __init__(self, clock: Callable[[], float]) -> None:
        self._clock = clock
        self._until: dict[str, float] = {}

    def look(self, *paths: str, seconds: float = LOOKS_SECONDS) -> None:
        """Note that somebody looks at parts of the model from now on, "" for all of it."""
        until = self._clock() + seconds
        paths = tuple(_INDEX.sub(EACH, path) for path in paths)
        # another dictionary each time, so that a reader has one that doesn't change
        known = {path: at for path, at in self._until.items() if at > self._clock()}
        self._until = {**known, **{path: max(until, known.get(path, 0.0)) for path in paths}}

    @property
    def looks_at_all(self) -> bool:
        """Whether somebody looks at the whole model."""
        return self._until.get("", 0.0) > self._clock()

    def looks_at(self, path: str) -> bool:
        """Return whether somebody looks at a part, at something in it, or at what it is in."""
        now = self._clock()
        return any(
            at > now and (is_below(path, looked) or is_below(looked, path))
            for looked, at in self._until.items()
        )
