"""The model as it is known, and nothing else: who asks for it or shows it isn't known here."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, cast

from .merge import Changes, patched, replaced

_UNKNOWN = object()


class ModelStore:
    """Keeps the latest snapshot of the object model.

    One thread applies; any number read ``model`` without a lock, since a snapshot is never
    changed: each change makes a new one that shares what stayed.
    """

    def __init__(self) -> None:
        self.model: Mapping[str, Any] = {}
        """The snapshot; empty while nothing is known. Not to be changed by anybody."""
        self.revision = 0
        """Grows by one with each reply that changed something; never falls."""

    def merged(self, updates: Iterable[tuple[str, Any]]) -> tuple[Mapping[str, Any], Any]:
        """Return the model with values put in, and what would change; nothing is kept of it.

        Each comes with its path, as ``replace`` takes it, or with an empty one, as ``patch``.
        """
        trial = ModelStore()
        trial.model = self.model
        changes: dict[str, Any] = {}
        for path, value in updates:
            changes.update(trial.replace(path, value) if path else trial.patch(value))
        return trial.model, changes

    def keep(self, model: Mapping[str, Any]) -> None:
        """Take what ``merged`` has made."""
        if model is not self.model:
            self.model = model
            self.revision += 1

    def patch(self, members: Mapping[str, Any]) -> dict[str, Any]:
        """Lay members of a live reply over the model; return what changed, by top-level key."""
        return self._take(patched(self.model, members))

    def replace(self, path: str, value: Any) -> dict[str, Any]:
        """Put a complete reply in the place of ``path``; return what changed.

        ``path`` is one or more names with ``.`` between, such as ``heat`` or ``move.axes``.
        Raises ``NestedTooDeep``; the model is then as it was.
        """
        names = path.split(".")
        known: Any = self.model
        for name in names:
            known = known.get(name, _UNKNOWN) if isinstance(known, Mapping) else _UNKNOWN
        value, changes = replaced(known, value)
        if changes is None:
            return {}
        for name in reversed(names):
            changes = {name: changes}
        return self._take((_put(self.model, names, value), changes))

    def forget(self) -> None:
        """Know nothing: after a disconnect or a reset of the board."""
        if self.model:
            self.model = {}
            self.revision += 1

    def _take(self, merged: tuple[Any, Changes | None]) -> dict[str, Any]:
        value, changes = merged
        if changes is None:
            return {}
        self.model = value
        self.revision += 1
        return cast("dict[str, Any]", changes)


def _put(tree: Any, names: list[str], value: Any) -> dict[str, Any]:
    """Return ``tree`` with ``value`` at the path of ``names``; all beside the path is shared."""
    known = tree if isinstance(tree, Mapping) else {}
    first, rest = names[0], names[1:]
    return {**known, first: _put(known.get(first), rest, value) if rest else value}
