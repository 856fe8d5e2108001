"""What an answer adds to the model, and what came of it."""

from __future__ import annotations

from typing import Any, NamedTuple


class Update(NamedTuple):
    """A value to put into the store; an empty path patches the whole model."""

    path: str
    value: Any


class Taken(NamedTuple):
    """What a reply did."""

    changes: dict[str, Any]
    """What changed, by top-level key; see ``merge.Changes``."""
    reset: bool
    """Whether it showed that the board had been reset; the model then begins anew."""
    is_doubted: bool = False
    """Whether it tells of something bad for the first time: it doesn't count, ask again at once."""


class Warmed(NamedTuple):
    """What a report of temperatures did; all else of the model is as old as before."""

    changes: dict[str, Any]
    """As in ``Taken``."""
    heaters: frozenset[int]
    """Indices of those that it told of."""
